"""The things and people that a run adds to a building."""

from collections.abc import Sequence
from functools import cache
from itertools import cycle, islice

from memorymaze.world.sites.scene_objects import PERSON, Movable
from memorymaze.world.sites.things import ThingKind, thing_kinds

PERSON_RADII = (0.27, 0.25, 0.30, 0.26, 0.28)
"""Metres; they take turns."""
PERSON_HEIGHTS = (1.72, 1.60, 1.84, 1.66, 1.78, 1.55, 1.70)
"""Metres; they take turns."""
CLOTHES = ("dark blue", "grey", "red", "black", "green", "beige", "white", "brown")


@cache
def left_standing() -> dict[str, ThingKind]:
    """Return kinds of things left standing in corridors, by the names in settings."""
    return {
        kind.name.replace(" ", "_"): kind
        for kind in thing_kinds().values()
        if kind.left_standing
    }


def things(count: int, kinds: Sequence[str]) -> list[Movable]:
    """Return so many things, the kinds taking turns."""
    return [
        _left_standing(f"{name}-{number}", left_standing()[name])
        for number, name in enumerate(islice(cycle(kinds), count))
    ]


def _left_standing(identity: str, kind: ThingKind) -> Movable:
    return Movable(
        identity,
        kind.name,
        kind.colors[0],
        kind.size,
        next(iter(kind.texts), None),
        kind.left_standing == "anywhere",
    )


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
