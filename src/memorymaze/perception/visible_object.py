"""What a camera view offers a detector; no world, no site, no answers inside."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

__all__ = ["CameraView", "ObjectDescription", "VisibleObject"]


@dataclass(frozen=True, slots=True)
class ObjectDescription:
    """How a person could name a thing they see."""

    category: str
    """Common English noun, such as `vending machine` or `door`."""
    color: str | None = None
    material: str | None = None
    """Such as `glass`, `wood`, `steel`."""
    name: str | None = None
    """Proper name people know it by."""
    text: str | None = None
    """Words written on it."""
    state: Literal["open", "closed"] | None = None
    """Of a door."""


@dataclass(frozen=True, slots=True)
class VisibleObject:
    """A thing of which the camera sees enough to recognise it."""

    description: ObjectDescription
    position: tuple[float, float]
    """Middle of the thing in the world, metres; for tracking only."""
    length: float
    """Its longer side on the floor, metres; for tracking only."""
    box: tuple[float, float, float, float]
    """Pixels (left, top, right, bottom) of the part in the picture."""
    distance: float
    """Metres from the camera to the nearest part seen."""
    bearing: float
    """Radians from straight ahead, left positive, of its middle."""
    visible_fraction: float
    """Share of the part inside the picture that nothing hides, 0 to 1."""


class CameraView(Protocol):
    """One look of the robot's camera."""

    def visible_objects(self, range_limit: float) -> Sequence[VisibleObject]:
        """Return the things seen whose nearest seen part is within `range_limit` metres."""
        ...
