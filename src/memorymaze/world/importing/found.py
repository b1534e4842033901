"""Rooms, doors and things as importers find them, before they stand on a floor."""

from dataclasses import dataclass

from shapely import Polygon

from memorymaze.basics.geometry.points import XY


@dataclass(frozen=True, slots=True)
class FoundRoom:
    """A space that is not walked in."""

    source: str
    """Its id in the file."""
    polygon: Polygon
    name: str | None
    use: str | None
    """A word of plans; None where the file has none that is like one."""


@dataclass(frozen=True, slots=True)
class FoundDoor:
    """A door near a wall of the floor."""

    source: str
    place: XY
    """Its middle."""
    kind: str
    """Of the doors that made buildings have, such as `automatic`."""
    label: str | None = None
    width: float | None = None
    """Metres; None where the file does not say."""
    is_open: bool = False
    reach: float = 1.0
    """Metres to look for a wall."""


@dataclass(frozen=True, slots=True)
class FoundThing:
    """A thing that stands on the floor or hangs on a wall."""

    source: str
    place: XY
    category: str
    name: str | None = None
