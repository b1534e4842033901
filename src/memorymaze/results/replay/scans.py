"""What the robot's LiDAR would have measured in an episode, without noise."""

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

from memorymaze.results.replay.moments import Moment, Moments
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.senses.lidar import Lidar, LidarSettings


class Scans:
    """A LiDAR at the poses of a trace, with the things and people of the moment."""

    def __init__(self, scene: Scene, moments: Moments) -> None:
        """Mount a LiDAR."""
        self._scene = scene
        self._things = moments.things
        self._data = mujoco.MjData(scene.model)
        self._heights = {each.id: each.size[2] for each in scene.movables}
        settings = LidarSettings(noise=0.0, drop_out=0.0)
        self._height = settings.height
        self._lidar = Lidar(scene, self._data, settings)
        mujoco.mj_kinematics(scene.model, self._data)

    def points(self, moment: Moment) -> NDArray[np.float64]:
        """Return where the rays ended: metres in the robot's frame, (N, 3).

        x ahead, y to the left, z up from the floor.
        """
        for name, pose in {**self._things, **moment.people}.items():
            row = self._scene.mocap_ids[name]
            half = pose.heading / 2
            self._data.mocap_pos[row] = (pose.x, pose.y, self._heights[name] / 2)
            self._data.mocap_quat[row] = (math.cos(half), 0, 0, math.sin(half))
        mujoco.mj_kinematics(self._scene.model, self._data)
        points = self._lidar.scan(moment.pose, moment.time).points()
        return points + np.array([0.0, 0.0, self._height])
