"""What things and people are: their kinds, sizes and colours."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import cycle, islice

PERSON = "person"
"""Category of everyone who walks about."""

PERSON_RADII = (0.27, 0.25, 0.30, 0.26, 0.28)
"""Metres; they take turns."""
PERSON_HEIGHTS = (1.72, 1.60, 1.84, 1.66, 1.78, 1.55, 1.70)
"""Metres; they take turns."""
CLOTHES = ("dark blue", "grey", "red", "black", "green", "beige", "white", "brown")


@dataclass(frozen=True, slots=True)
class ThingKind:
    """A kind of thing that is left standing in corridors."""

    category: str
    """Common English noun."""
    size: tuple[float, float, float]
    """Length along its front, depth, height; metres."""
    color: str
    in_the_middle: bool
    """Whether it is also left in the middle of wide ways, not only along walls."""
    text: str | None = None
    """Words written on it."""


THING_KINDS = {
    "cardboard_box": ThingKind("cardboard box", (0.5, 0.4, 0.45), "brown", False),
    "cart": ThingKind("cart", (0.9, 0.5, 1.0), "grey", False),
    "wet_floor_sign": ThingKind(
        "wet floor sign", (0.3, 0.35, 0.65), "yellow", True, "CAUTION WET FLOOR"
    ),
    "suitcase": ThingKind("suitcase", (0.48, 0.28, 0.7), "blue", False),
    "queue_barrier": ThingKind("queue barrier", (1.3, 0.3, 1.0), "black", True),
    "ladder": ThingKind("ladder", (0.5, 0.45, 1.6), "silver", False),
}
"""Kinds by the names that settings use."""


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


def things(count: int, kinds: Sequence[str]) -> list[Movable]:
    """Return so many things, the kinds taking turns."""
    return [
        Movable(
            id=f"{name}-{number}",
            category=THING_KINDS[name].category,
            color=THING_KINDS[name].color,
            size=THING_KINDS[name].size,
            text=THING_KINDS[name].text,
            in_the_middle=THING_KINDS[name].in_the_middle,
        )
        for number, name in enumerate(islice(cycle(kinds), count))
    ]


def people(count: int) -> list[Movable]:
    """Return so many people of different sizes."""
    return [
        Movable(
            id=f"{PERSON}-{number}",
            category=PERSON,
            color=CLOTHES[number % len(CLOTHES)],
            size=(
                2 * PERSON_RADII[number % len(PERSON_RADII)],
                2 * PERSON_RADII[number % len(PERSON_RADII)],
                PERSON_HEIGHTS[number % len(PERSON_HEIGHTS)],
            ),
        )
        for number in range(count)
    ]
