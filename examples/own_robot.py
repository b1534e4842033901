"""A body of forty lines behind `SensorsAndMotion`: a point between walls, in no simulator.

It shows what to write for a robot of your own; `GuideRobot` makes the rest of it: all that
agents call. Try it by itself, and in the runs of the benchmark:

    python examples/own_robot.py
    memorymaze evaluate --agent guide --robot examples/own_robot.py:in_site --limit 6
"""

import math

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

import memorymaze as mm
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.robot.api.sensors_and_motion import OdometryReading
from memorymaze.robot.api.steps import CameraPicture, LidarScan
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.guide_robot import GuideRobot

CORRIDOR = ((0, -1), (12, -1), (12, -8), (14, -8), (14, 1), (0, 1))
"""Corners of the floor: 14 m to the east, then right, 7 m to the south."""
WEST_END = Pose(1.0, 0.0, 0.0)
Walls = NDArray[np.float64]
"""Where each begins and ends, (walls, 2, 2), metres."""


def walls_of(*outlines: ArrayLike) -> Walls:
    """Return the walls between the corners of closed outlines."""
    rings = [np.array(each, dtype=float) for each in outlines]
    walls = [np.stack((each, np.roll(each, -1, axis=0)), axis=1) for each in rings]
    return np.concatenate(walls)


WALLS = walls_of(CORRIDOR)


class PointBody:
    """Implements `SensorsAndMotion`."""

    def __init__(self, walls: Walls = WALLS, pose: Pose = WEST_END) -> None:
        """Stand somewhere between walls."""
        self.pose, self.time, self.speed, self.walls = pose, 0.0, 0.0, walls
        self.angles = np.linspace(-math.pi, math.pi, 360, endpoint=False)

    def odometry(self) -> OdometryReading:
        """Return where it is: it knows without any error."""
        return OdometryReading(self.time, self.pose, self.speed)

    def drive(self, speed: float, turn_rate: float, seconds: float) -> None:
        """Go ahead and turn; what is nearer than its radius holds it."""
        x, y, heading = self.pose
        way = math.copysign(1, speed) * np.array([math.cos(heading), math.sin(heading)])
        room = float(self.distances(np.array([0 if speed >= 0 else math.pi]))[0]) - 0.25
        metres = max(0.0, min(abs(speed) * seconds, room))
        heading = wrap_angle(heading + turn_rate * seconds)
        self.pose = Pose(x + metres * way[0], y + metres * way[1], heading)
        self.time, self.speed = self.time + seconds, metres / seconds

    def lidar_scan(self) -> LidarScan:
        """Measure all round."""
        return LidarScan(
            self.distances(self.angles), self.angles, np.zeros(1), self.time
        )

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        """Draw bare walls, the nearer the brighter."""
        across = np.linspace(1, -1, width) * math.tan(horizontal_fov / 2)
        angles = np.arctan(across)
        depth = np.tile(self.distances(angles) * np.cos(angles), (height, 1))
        grey = np.clip(255 / (1 + depth), 0, 255).astype(np.uint8)
        return CameraPicture(np.stack([grey] * 3, axis=-1), depth.astype(np.float32))

    def distances(self, angles: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far it is to a wall along each angle, seen from the robot."""
        here, heading = np.array(self.pose[:2]), self.pose.heading
        ray = np.stack([np.cos(angles + heading), np.sin(angles + heading)])
        start = self.walls[:, 0] - here
        wall = self.walls[:, 1] - self.walls[:, 0]
        sine = np.outer(wall[:, 1], ray[0]) - np.outer(wall[:, 0], ray[1])
        with np.errstate(divide="ignore", invalid="ignore"):
            along = (start[:, :1] * wall[:, 1:] - start[:, 1:] * wall[:, :1]) / sine
            share = (
                np.outer(start[:, 0], ray[1]) - np.outer(start[:, 1], ray[0])
            ) / sine
        hit = (along > 0) & (share >= 0) & (share <= 1)
        return np.where(hit, along, np.inf).min(axis=0)


class PointBodyInSite(PointBody):
    """The same between the walls of a building, where it also knows its place."""

    def pose_in_site(self) -> Pose:
        """Return where it is on the plan, by which walks are measured."""
        return self.pose


def in_site(
    site: mm.Site, start: Pose, settings: SimulationSettings, rng: np.random.Generator
) -> PointBodyInSite:
    """Make the body of an episode: what `--robot examples/own_robot.py:in_site` calls."""
    rings = [
        np.array(ring.coords)[:-1]
        for part in shapely.get_parts(site.walkable_floor)
        for ring in (part.exterior, *part.interiors)
    ]
    return PointBodyInSite(walls_of(*rings), start)


def walk_round_the_corner(robot: mm.Robot) -> None:
    """Go to the corner, turn right and go on to the end."""
    while "right" not in robot.detect_turning_point():
        if robot.move_forward(0.5).reason != "done":
            break
    print("at the corner:", robot.detect_turning_point(), robot.turn("right").message)
    print("then", robot.move_forward(20))


if __name__ == "__main__":
    walk_round_the_corner(GuideRobot(PointBody()))
