"""CARLA's sensors: what they send, awaited by frame, in the forms that robots get."""

import math
import threading
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import RobotBodyError
from memorymaze.robot.api.steps import LidarScan
from memorymaze.robot.carla.frames import carla

_Data = TypeVar("_Data", bound=carla.SensorData)

FRAME = 0.05
"""Seconds from one frame to the next."""
ANGLES = 360
"""Of a scan, evenly all round."""
NEAREST, FARTHEST = 0.2, 20.0
"""Metres; what is nearer is the body itself."""
SKY = 990.0
"""Metres; CARLA's depth pictures end at 1000."""
LIDAR = {
    "channels": "1",
    "upper_fov": "0",
    "lower_fov": "0",
    "range": f"{FARTHEST:g}",
    # All round in each frame, two rays for each angle; CARLA's default drops half of them.
    "rotation_frequency": f"{1 / FRAME:g}",
    "points_per_second": str(round(2 * ANGLES / FRAME)),
    "dropoff_general_rate": "0",
    "dropoff_intensity_limit": "0",
    "dropoff_zero_intensity": "0",
}


class SensorFeed(Generic[_Data]):
    """What one sensor sends; it comes from a thread of the client's, late or never."""

    def __init__(self, name: str) -> None:
        """Begin with nothing; messages begin with the name."""
        self._name = name
        self._latest: _Data | None = None
        self._newest = -1
        self._arrived = threading.Condition()

    def keep(self, data: _Data) -> None:
        """Take what the sensor measured."""
        with self._arrived:
            if data.frame > self._newest:
                self._latest, self._newest = data, data.frame
                self._arrived.notify_all()

    def came(self, frame: int, seconds: float) -> bool:
        """Wait for a frame, and return whether it or a later one came."""
        with self._arrived:
            return self._arrived.wait_for(lambda: self._newest >= frame, seconds)

    def at(self, frame: int, seconds: float) -> _Data:
        """Return what it measured in a frame, for which it is awaited for so long.

        Raises:
            RobotBodyError: It does not come, or a later one came instead.
        """
        self.came(frame, seconds)
        latest = self._latest
        if latest is None or latest.frame != frame:
            got = "none" if latest is None else f"frame {latest.frame} as the last"
            raise RobotBodyError(
                f"{self._name}: expected frame {frame} within {seconds:g} s, got {got}; "
                "give a longer carla_timeout, and let no other client tick the server"
            )
        return latest


def scan_of(measured: carla.LidarMeasurement, time: float) -> LidarScan:
    """Return a scan at even angles, for each the nearest ray in angle."""
    points = np.frombuffer(measured.raw_data, np.float32).reshape(-1, 4).astype(float)
    ahead, left = points[:, 0], -points[:, 1]
    reached = np.hypot(ahead, left)
    kept = (reached >= NEAREST) & (reached <= FARTHEST)
    step = 2 * math.pi / ANGLES
    places = (np.arctan2(left, ahead)[kept] + math.pi) / step
    nearest = np.rint(places)
    best_last = np.argsort(-np.abs(places - nearest), kind="stable")
    ranges = np.full(ANGLES, np.inf)
    ranges[nearest[best_last].astype(int) % ANGLES] = reached[kept][best_last]
    angles = np.arange(ANGLES, dtype=np.float64) * step - math.pi
    return LidarScan(ranges, angles, np.zeros(1), time)


def rgb_of(image: carla.Image) -> NDArray[np.uint8]:
    """Return colours, (height, width, 3)."""
    return np.ascontiguousarray(_bgra(image)[..., 2::-1])


def depth_of(image: carla.Image) -> NDArray[np.float32]:
    """Return metres along the optical axis, (height, width); inf for the sky."""
    steps = _bgra(image)[..., 2::-1] @ np.array([1.0, 256.0, 65536.0])
    metres = steps / (2**24 - 1) * 1000
    return np.where(metres < SKY, metres, np.inf).astype(np.float32)


def _bgra(image: carla.Image) -> NDArray[np.uint8]:
    pixels = np.frombuffer(image.raw_data, np.uint8)
    return pixels.reshape(image.height, image.width, 4)
