"""How a walkthrough moves: the robot's own drive along a route, at even steps of time."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.errors import MemoryMazeError
from memorymaze.geometry.pose import Pose, wrap_angle
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.settings import SimulationSettings
from memorymaze.sites.records import Route

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
