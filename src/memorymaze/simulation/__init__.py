"""Simulated buildings and the robot in them: physics by MuJoCo, time, motion, collisions.

`scene` makes a physics model of a site, `body` the robot's body in it, and `robot` the guide
robot that agents drive: `steering` on that body, with the plan's knowledge of the floor. What
the body perceives is in `senses`, what an episode adds to the plan in `obstacles`. No picture
is drawn here (`pictures` does, through `cameras`), no name is matched with a thing
(`perception`), nothing is scored (`metrics`).
"""

from memorymaze.simulation.physics_engine import ENGINE_VERSION

# isort: split
# Only then what imports MuJoCo itself.
from memorymaze.simulation.body import Collision
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene, SceneObject, build_scene
from memorymaze.simulation.settings import SimulationSettings
from memorymaze.steering.calls import TraceEvent

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
