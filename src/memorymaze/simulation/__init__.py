"""Simulated buildings and the robot in them: physics by MuJoCo, time, motion, collisions.

`scene` makes a physics model of a site, `robot` the guide robot that agents drive in it;
how it moves is in `motion`, what it perceives in `senses`, what an episode adds to the
plan in `obstacles`. No picture is drawn here (`pictures` does, through `cameras`), no
name is matched with a thing (`perception`), nothing is scored (`metrics`).
"""

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
