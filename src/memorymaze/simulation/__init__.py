"""Simulated buildings and the robot in them: MuJoCo physics, time, motion, collisions."""

from memorymaze.simulation.physics_engine import ENGINE_VERSION
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene, SceneObject, build_scene
from memorymaze.simulation.settings import SimulationSettings
from memorymaze.simulation.trace import Collision, TraceEvent

__all__ = [
    "ENGINE_VERSION",
    "Collision",
    "Scene",
    "SceneObject",
    "SimulatedRobot",
    "SimulationSettings",
    "TraceEvent",
    "build_scene",
]
