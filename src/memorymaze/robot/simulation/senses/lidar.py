"""The robot's LiDAR: laser scans of the physics scene, in one plane or 16 beams.

A scan sees everything that has a geom, except the robot itself: walls, door leaves,
landmarks, and in a 3D scan floor and ceiling. Glass is seen like any wall.
"""

import math

import numpy as np

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import mujoco
from memorymaze.robot.api.steps import LidarScan
from memorymaze.robot.simulation.motion.wheeled_base import ROBOT_GROUP
from memorymaze.robot.simulation.scene import FLOOR_GROUP, Scene
from memorymaze.robot.simulation.senses.lidar_settings import LidarSettings


class Lidar:
    """A LiDAR in one simulated building."""

    def __init__(
        self,
        scene: Scene,
        data: mujoco.MjData | None = None,
        settings: LidarSettings | None = None,
        rng: np.random.Generator | None = None,
    ) -> None:
        """Mount a LiDAR; noise and drop-outs need a random generator.

        It sees the geoms of a physics state, of None those of the empty building.
        """
        self.settings = settings or LidarSettings()
        """What it measures and how well."""
        if rng is None and (self.settings.noise > 0 or self.settings.drop_out > 0):
            raise SettingsError(
                "LiDAR with noise or drop-outs: expected a random generator, got None"
            )
        self._rng = rng
        self._model = scene.model
        if data is None:
            data = mujoco.MjData(scene.model)
            mujoco.mj_kinematics(scene.model, data)
        self._data = data
        count = self.settings.rays
        step = 2 * math.pi / count
        self._angles: FloatArray = np.arange(count, dtype=np.float64) * step - math.pi
        elevation = self.settings.elevation if self.settings.beams > 1 else 0.0
        self._elevations: FloatArray = np.linspace(
            -elevation, elevation, self.settings.beams, dtype=np.float64
        )
        for each in (self._angles, self._elevations):
            each.setflags(write=False)
        # Directions in the robot's frame: ahead, left and up, shape (beams * rays,).
        level = np.cos(self._elevations)[:, np.newaxis]
        self._ahead = (level * np.cos(self._angles)).ravel()
        self._left = (level * np.sin(self._angles)).ravel()
        self._directions = np.empty((count * self.settings.beams, 3))
        self._directions[:, 2] = np.repeat(np.sin(self._elevations), count)
        self._geoms = np.empty(len(self._directions), dtype=np.int32)
        self._groups = np.ones(6, dtype=np.uint8)
        self._groups[ROBOT_GROUP] = 0
        if not self._elevations.any():
            self._groups[FLOOR_GROUP] = 0  # never met

    def scan(self, pose: Pose, time: float = 0.0) -> LidarScan:
        """Measure once all around, in no time."""
        settings = self.settings
        cosine, sine = math.cos(pose.heading), math.sin(pose.heading)
        directions = self._directions
        np.multiply(self._ahead, cosine, out=directions[:, 0])
        directions[:, 0] -= self._left * sine
        np.multiply(self._ahead, sine, out=directions[:, 1])
        directions[:, 1] += self._left * cosine
        ranges = np.empty(len(directions))
        mujoco.mj_multiRay(
            self._model,
            self._data,
            np.array([pose.x, pose.y, settings.height]),
            directions.ravel(),
            self._groups,
            True,
            -1,
            self._geoms,
            ranges,
            None,
            len(directions),
            settings.farthest,
        )
        ranges[self._geoms < 0] = math.inf
        if self._rng is not None:
            if settings.noise > 0:
                ranges += self._rng.normal(0.0, settings.noise, len(ranges))
            if settings.drop_out > 0:
                ranges[self._rng.random(len(ranges)) < settings.drop_out] = math.inf
        ranges[(ranges < settings.nearest) | (ranges > settings.farthest)] = math.inf
        if settings.beams > 1:
            ranges = ranges.reshape(settings.beams, settings.rays)
        return LidarScan(ranges, self._angles, self._elevations, time)
