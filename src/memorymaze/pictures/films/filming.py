"""From a route to the file of its walkthrough."""

import math
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from memorymaze.errors import MemoryMazeError, SettingsError
from memorymaze.geometry.pose import Pose, wrap_angle
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.pictures.films.drawing import (
    Eye,
    drawn_by_processes,
    frames_of_shots,
    shots_of,
)
from memorymaze.pictures.films.video_file import (
    check_picture,
    check_ranges,
    check_target,
    write_video,
)
from memorymaze.pictures.kinds_of_looks import Looks
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.settings import SimulationSettings
from memorymaze.sites.records import Route

EYE_HEIGHT = 1.6
"""Metres over the floor: eyes of somebody who walks, or a camera held there."""
TOUR_SETTINGS = SimulationSettings(
    # Slow turns: a robot's own are too fast to look at.
    max_turn_rate=math.radians(45),
    max_turn_acceleration=math.radians(60),
    wheel_noise=0.0,
    sampling_period=0.05,
    time_budget=math.inf,
)
PAUSE = 1.0
"""Seconds that it stands at the start and at the goal."""


@dataclass(frozen=True, slots=True)
class WalkthroughSettings:
    """What a walkthrough looks like.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    size: tuple[int, int] | None = None
    """Width and height, pixels, even; None for 960 x 540, all round 1280 x 640."""
    panorama: bool = False
    """Whether it looks all round (equirectangular, for players of 360-degree videos)."""
    fps: float = 20.0
    """Frames per second."""
    speed: float = 1.0
    """Times as fast as the robot drives, which is up to 1 m/s."""
    height: float = EYE_HEIGHT
    """Of the eyes over the floor, metres."""
    horizontal_fov: float = math.pi / 2
    """Radians; of no meaning in a panorama."""
    multisamples: int = 4
    """Samples per pixel that smooth edges; of no meaning in a panorama."""
    looks: Looks | None = None
    """How things look: `own` or `models`; None for models where they were converted."""

    @property
    def width(self) -> int:
        """Pixels."""
        return self.size[0] if self.size else (1280 if self.panorama else 960)

    @property
    def height_in_pixels(self) -> int:
        """Pixels."""
        return self.size[1] if self.size else (640 if self.panorama else 540)

    @property
    def eye(self) -> Eye:
        """What looks."""
        return Eye(
            self.width,
            self.height_in_pixels,
            self.panorama,
            self.horizontal_fov,
            self.height,
            self.multisamples,
            self.looks,
        )

    def __post_init__(self) -> None:
        """Check every value."""
        width, height = self.width, self.height_in_pixels
        check_picture("walkthrough", (width, height), smallest=16)
        if self.panorama and width != 2 * height:
            raise SettingsError(
                "walkthrough: expected a panorama twice as wide as high, got "
                f"{width}x{height}"
            )
        check_ranges(
            self, "walkthrough", fps=(1, 120), speed=(0.1, 20), height=(0.2, 2.5)
        )


def film_walkthrough(
    scene: Scene,
    route: Route,
    path: str | Path,
    settings: WalkthroughSettings | None = None,
    *,
    progress: bool = False,
    told: Callable[[int, int], object] | None = None,
) -> int:
    """Write the video of a route; it is there in full or not at all.

    The same building, route and settings give the same frames on one machine.

    Args:
        scene: The building.
        route: Where from and where to.
        path: An mp4 file, which is replaced.
        settings: What it looks like; the defaults when None.
        progress: Whether to show a bar with the time left on stderr.
        told: Is told after each frame how many of how many are written; what it raises
            ends the film.

    Returns:
        How many frames it has.

    Raises:
        SettingsError: The file cannot be there, or the package for videos is missing.
        RenderingError: This machine cannot draw; says what to install.
        MemoryMazeError: The route cannot be driven.
        OSError: The file cannot be written to its end.
    """
    settings = settings or WalkthroughSettings()
    check_target(path, ".mp4", "video")
    tour = tour_of(scene, route)
    count = tour.frame_count(settings.fps, settings.speed)
    poses, shots = shots_of(
        tour.poses(settings.fps, settings.speed), panorama=settings.panorama
    )
    # Closed at once where the film is broken off, with the processes that draw.
    with closing(drawn_by_processes(scene.site, settings.eye, poses)) as pictures:
        write_video(
            path,
            _telling(frames_of_shots(shots, pictures), count, told),
            (settings.width, settings.height_in_pixels),
            settings.fps,
            title=f"Walkthrough of {scene.site.title}, {route.id} (simulated)",
            total=count,
            spherical=settings.panorama,
            progress=progress,
        )
    return count


def _telling(
    frames: Iterator[NDArray[np.uint8]],
    count: int,
    told: Callable[[int, int], object] | None,
) -> Iterator[NDArray[np.uint8]]:
    for number, frame in enumerate(frames, start=1):
        yield frame
        if told is not None:
            told(number, count)


@dataclass(frozen=True)
class Tour:
    """A drive from the start of a route to its goal."""

    trajectory: Trajectory

    @property
    def duration(self) -> float:
        """Seconds, with the pauses at both ends."""
        return self.trajectory.duration + 2 * PAUSE

    def frame_count(self, fps: float, speed: float = 1.0) -> int:
        """Return how many frames a film of it has.

        Args:
            fps: Frames per second of film.
            speed: Seconds of the drive per second of film.
        """
        return math.floor(self.duration / speed * fps) + 1

    def poses(self, fps: float, speed: float = 1.0) -> Iterator[Pose]:
        """Return where the camera is at each frame of a film.

        Args:
            fps: Frames per second of film.
            speed: Seconds of the drive per second of film.
        """
        times, xs, ys, headings = self._columns()
        for frame in range(self.frame_count(fps, speed)):
            now = frame * speed / fps - PAUSE
            yield Pose(
                float(np.interp(now, times, xs)),
                float(np.interp(now, times, ys)),
                wrap_angle(float(np.interp(now, times, headings))),
            )

    def _columns(self) -> NDArray[np.float64]:
        table = np.array(self.trajectory.poses, dtype=np.float64).T
        table[0] -= table[0, 0]
        table[3] = np.unwrap(table[3])
        return table


def tour_of(scene: Scene, route: Route) -> Tour:
    """Let the robot drive a route's line, slowly round its corners.

    Args:
        scene: The building; nothing moves in it but the robot.
        route: Where from and where to.

    Raises:
        MemoryMazeError: The route cannot be driven to its end.
    """
    robot = SimulatedRobot(scene, route.start, TOUR_SETTINGS)
    line = np.array(route.line.coords)[:, :2]
    result = robot.follow(line)
    if result.reason != "done":
        raise MemoryMazeError(
            f"walkthrough of {route.id}: expected a way that can be driven, got stopped "
            f"by {result.reason} after {result.distance:.1f} m of "
            f"{route.line.length:.1f} m; see `memorymaze sites check`"
        )
    return Tour(robot.trajectory())
