"""CARLA's client and its frame: left-handed, metres, degrees, y to the south."""

import math

from memorymaze.basics.extras import require_extra
from memorymaze.basics.geometry.pose import Pose, wrap_angle

try:
    import carla as carla
except ImportError:
    require_extra("carla", "carla", purpose="a robot in CARLA")
    raise


def transform_of(pose: Pose, z: float = 0.0) -> carla.Transform:
    """Return a pose in CARLA, at a height."""
    yaw = -math.degrees(pose.heading)
    return carla.Transform(carla.Location(pose.x, -pose.y, z), carla.Rotation(yaw=yaw))


def pose_of(transform: carla.Transform) -> Pose:
    """Return where something in CARLA stands in the site."""
    place, yaw = transform.location, transform.rotation.yaw
    return Pose(place.x, -place.y, wrap_angle(-math.radians(yaw)))
