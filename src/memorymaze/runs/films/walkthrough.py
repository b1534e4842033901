"""Walkthroughs: a slow drive along a route, and the file of its film."""

import math
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.basics.video_file import check_video_path, write_video
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.films.drawing import frames_from
from memorymaze.runs.films.settings import WalkthroughSettings
from memorymaze.world.sites.checking import check_drawn
from memorymaze.world.sites.records import Route

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
        SettingsError: The file cannot be there, or the extra `video` is missing.
        SitePlanError: A floor, a wall or a door has a word that has no look.
        RenderingError: This machine cannot draw; says what to install.
        MemoryMazeError: The route cannot be driven.
        OSError: The file cannot be written to its end.
    """
    settings = settings or WalkthroughSettings()
    check_video_path(path)
    if settings.looks != "mesh":
        check_drawn(scene.site)
    poses = list(tour_of(scene, route).poses(settings.fps, settings.speed))
    # Closed at once where the film is broken off, with the processes that draw.
    with closing(frames_from(scene.site, settings, poses)) as frames:
        write_video(
            path,
            frames,
            settings.pixels,
            settings.fps,
            title=f"Walkthrough of {scene.site.title}, {route.id} (simulated)",
            total=len(poses),
            progress=progress,
            told=told,
        )
    return len(poses)


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
