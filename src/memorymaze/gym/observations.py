"""What an agent perceives: the instruction, pictures and scans; and its spaces.

The space of instructions also survives the shared memory of Gymnasium. `AsyncVectorEnv`
takes what `read_from_shared_memory` returns once, when it starts, and hands out copies of
it after every step. That is right for arrays, which are views, but texts would stay what
they were at the start; so texts are looked up anew in each copy.
"""

import math
import string
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, Literal, overload

import numpy as np
from gymnasium import spaces
from gymnasium.spaces import Text
from gymnasium.vector.utils import read_from_shared_memory

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.options import check_number
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.senses.lidar_settings import LidarSettings

Sensor = Literal["rgb", "depth", "lidar"]
SENSORS: tuple[Sensor, ...] = ("rgb", "depth", "lidar")
"""What an observation can hold beside the instruction."""


class InstructionSpace(Text):
    """Texts of some characters and up to some length."""


@dataclass(frozen=True)
class Senses:
    """Which sensors there are, and how fine they are.

    Raises:
        SettingsError: A sensor is not known, or a number has no meaning.
    """

    sensors: Sequence[Sensor] = ("rgb",)
    """Some of `rgb`, `depth` and `lidar`."""
    width: int = 224
    """Of pictures, pixels."""
    height: int = 224
    """Of pictures, pixels."""
    horizontal_fov: float = math.pi / 2
    """Of the camera, radians."""
    depth_range: float = 10.0
    """Metres; what is farther reads as this, the sky too."""

    def __post_init__(self) -> None:
        """Check what the cameras do not check."""
        if isinstance(self.sensors, str) or not set(self.sensors) <= set(SENSORS):
            raise SettingsError(
                f"sensors: expected some of {', '.join(SENSORS)} in a list, got "
                f"{self.sensors!r}"
            )
        for name in ("width", "height"):
            check_number(f"{name}, pixels", getattr(self, name), least=1, whole=True)
        if not 0 < self.horizontal_fov < math.pi:
            raise SettingsError(
                "horizontal_fov: expected radians between 0 and pi, got "
                f"{self.horizontal_fov!r}"
            )
        check_number("depth_range, metres", self.depth_range, above=0)

    def space(self, texts: Iterable[str]) -> spaces.Dict:
        """Return the observation space for these instructions."""
        every = list(texts)
        parts: dict[str, spaces.Space[Any]] = {
            "instruction": InstructionSpace(
                max(map(len, every)),
                charset=frozenset(string.printable).union(*every),
            )
        }
        size = (self.height, self.width)
        if "rgb" in self.sensors:
            parts["rgb"] = spaces.Box(0, 255, (*size, 3), np.uint8)
        if "depth" in self.sensors:
            parts["depth"] = spaces.Box(0.0, self.depth_range, size, np.float32)
        if "lidar" in self.sensors:
            lidar = LidarSettings()
            parts["lidar"] = spaces.Box(0.0, lidar.farthest, (lidar.rays,), np.float32)
        return spaces.Dict(parts)

    def observe(self, robot: SimulatedRobot, instruction: str) -> dict[str, Any]:
        """Return what is perceived from where the robot is."""
        seen: dict[str, Any] = {"instruction": instruction}
        if "rgb" in self.sensors or "depth" in self.sensors:
            view = robot.camera_view()
            frame = view.picture(self.width, self.height, self.horizontal_fov)
            if "rgb" in self.sensors:
                seen["rgb"] = frame.rgb
            if "depth" in self.sensors:
                seen["depth"] = np.minimum(frame.depth, np.float32(self.depth_range))
        if "lidar" in self.sensors:
            scan = robot.lidar_scan()
            farthest = LidarSettings().farthest
            seen["lidar"] = np.minimum(scan.ranges, farthest).astype(np.float32)
        return seen


class _LiveTexts(Sequence[str]):
    """The texts that are in the shared memory now; a copy is a tuple of them."""

    def __init__(self, space: InstructionSpace, memory: Any, count: int) -> None:
        """Look at the memory of so many environments."""
        self._space, self._memory, self._count = space, memory, count

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: int | slice) -> str | Sequence[str]:
        return self._now()[index]

    def __deepcopy__(self, memo: dict[int, Any]) -> tuple[str, ...]:
        return self._now()

    def _now(self) -> tuple[str, ...]:
        read: Any = read_from_shared_memory.dispatch(Text)
        return read(self._space, self._memory, self._count)


def _read_live(space: InstructionSpace, shared_memory: Any, n: int = 1) -> Any:
    return _LiveTexts(space, shared_memory, n)


read_from_shared_memory.register(InstructionSpace, _read_live)


SensorChoice = Sequence[Sensor] | Senses | Mapping[str, Any]


def senses_of(choice: SensorChoice) -> Senses:
    """Return the senses that a setting means: names of sensors, settings, or `Senses`."""
    if isinstance(choice, Senses):
        return choice
    if not isinstance(choice, Mapping):
        return Senses(choice)
    names = [each.name for each in fields(Senses)]
    if not set(choice) <= set(names):
        raise SettingsError(
            f"sensors: expected some of {', '.join(names)}, got {choice!r}"
        )
    return Senses(**choice)
