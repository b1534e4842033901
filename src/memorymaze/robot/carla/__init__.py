"""A robot's body in the CARLA simulator: see docs/simulators.md.

Holds the body, its sensors, the world it is put into, and CARLA's frame.
"""

from memorymaze.robot.carla.body import CarlaBody
from memorymaze.robot.carla.settings import CarlaOptions

__all__ = ["CarlaBody", "CarlaOptions"]
