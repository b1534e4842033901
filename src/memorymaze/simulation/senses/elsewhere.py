"""The camera put elsewhere, while the robot and time stay where they are."""

import math

import mujoco

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.senses.visibility import RayCamera


def camera_elsewhere(scene: Scene, now: mujoco.MjData, pose: Pose) -> RayCamera:
    """Return what the camera would see from a pose, with people and things as now.

    Args:
        scene: The building.
        now: Physics state of an episode; stays as it is.
        pose: Of the robot whose camera it is.
    """
    data = mujoco.MjData(scene.model)
    half = pose.heading / 2
    data.qpos[:7] = (pose.x, pose.y, 0, math.cos(half), 0, 0, math.sin(half))
    data.mocap_pos[:] = now.mocap_pos
    data.mocap_quat[:] = now.mocap_quat
    mujoco.mj_kinematics(scene.model, data)
    mujoco.mj_camlight(scene.model, data)
    return RayCamera(scene, data)
