"""Which thing looks how: from the words of a site plan to a model.

What is no known kind of thing gets a box with its name on it.
"""

import re
import zlib
from collections.abc import Callable
from functools import cache
from importlib import import_module

from memorymaze.pictures.furniture.models import furniture_for
from memorymaze.pictures.kinds_of_looks import Looks
from memorymaze.pictures.looks.assembly import Assembly, ObjectModel, Order
from memorymaze.pictures.looks.bins_and_barriers import placeholder
from memorymaze.pictures.looks.windows import is_window, window_model
from memorymaze.pictures.tables import read_table
from memorymaze.sites.records import Landmark, Mount
from memorymaze.sites.things import kind_of_thing

Builder = Callable[[Assembly, Order], None]
"""Puts a thing of a size, colour and text together."""
VARIANTS = 6
"""Things of one kind, size, colour and text come in at most so many looks."""
WITH_PICTURES = frozenset({
    "computer terminal", "digital sign", "exhibit panel", "information panel", "kiosk",
    "mural", "painting", "poster", "touch screen", "video wall",
})  # fmt: skip
"""Archetypes that show a picture, each thing another one."""


@cache
def archetypes() -> dict[str, str]:
    """Return the file of `looks` with the builder of each kind that has a look."""
    table = read_table("archetypes.json", dict[str, tuple[str, ...]])
    return {name: module for module, names in table.items() for name in names}


def archetype_of(category: str) -> str | None:
    """Return the archetype of a category of a site plan, a key of `archetypes`.

    None for a category that nothing is known of, which is shown as a box with its name.
    """
    kind = kind_of_thing(category)
    return None if kind is None else kind.look


def model_for_landmark(landmark: Landmark, looks: Looks = "own") -> ObjectModel:
    """Return how a landmark looks.

    Landmarks that differ in nothing one sees share one model.
    """
    if is_window(landmark):
        return window_model(landmark)
    number = zlib.crc32(landmark.id.encode())
    pictured = archetype_of(landmark.category) in WITH_PICTURES
    return model_of(
        landmark.category,
        landmark.size,
        colour_words=landmark.color,
        text=landmark.text,
        name=landmark.name,
        mount=landmark.mount,
        variant=number if pictured else number % VARIANTS,
        looks=looks,
    )


@cache
def model_of(
    category: str,
    size: tuple[float, float, float],
    *,
    colour_words: str | None = None,
    text: str | None = None,
    name: str | None = None,
    mount: Mount = "floor",
    variant: int = 0,
    looks: Looks = "own",
) -> ObjectModel:
    """Return how a thing looks that no plan has, such as a box left in the way.

    Size is length across the front, depth, height. Unknown words for colours give its
    usual colour; a proper name may say what it shows; the variant is one of several
    looks.
    """
    length, depth, height = size
    order = Order(
        category,
        length,
        depth,
        height,
        colour_words,
        text or None,
        name,
        mount,
        variant,
    )
    if looks == "models":
        archetype = archetype_of(category)
        piece = None if archetype is None else furniture_for(archetype, order)
        if piece is not None:
            return piece
    made = Assembly()
    _builder(order)(made, order)
    return made.model(length, depth, height)


def _builder(order: Order) -> Builder:
    archetype = archetype_of(order.category)
    if archetype is None:
        return placeholder
    if archetype == "sign" and order.mount == "ceiling":
        archetype = "hanging sign"
    elif archetype == "sign" and order.mount == "floor" and order.depth > 0.2:
        archetype = "A-frame"
    module = import_module(f"memorymaze.pictures.looks.{archetypes()[archetype]}")
    return getattr(module, re.sub(r"[ -]", "_", archetype.lower()))
