"""What stands and walks in a building, and what a pixel or a touch can be of."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.world.sites.records import Door, Landmark

PERSON = "person"
"""Category of everyone who walks about."""


@dataclass(frozen=True, slots=True)
class Movable:
    """A thing or a person of a scene; where it is, is a matter of the episode."""

    id: str
    """Such as `cart-3` or `person-0`."""
    category: str
    """Common English noun."""
    color: str | None
    """Of a person: of the clothes."""
    size: tuple[float, float, float]
    """Length along its front, depth, height; metres. A person is round on the plan."""
    text: str | None = None
    """Words written on it."""
    in_the_middle: bool = False
    """Whether it may stand in the middle of wide ways."""

    @property
    def is_person(self) -> bool:
        """Whether it is a person and no thing."""
        return self.category == PERSON

    @property
    def radius(self) -> float:
        """Half its length, metres; of a person the radius."""
        return self.size[0] / 2


@dataclass(frozen=True, slots=True)
class SceneObject:
    """What a part of a building stands for."""

    kind: Literal[
        "floor", "ceiling", "wall", "door", "landmark", "thing", "person", "robot"
    ]
    record: Door | Landmark | Movable | None
    """Its record, of doors and landmarks from the site plan; None for other kinds."""
