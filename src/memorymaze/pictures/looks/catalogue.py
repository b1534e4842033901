"""Which thing looks how: from the words of a site plan to a model.

A category is looked up as it stands, then without what follows `of`, `with` or `for`
(`statue of a bear` is a statue), then without its first words (`antique corner sofa`).
What remains unknown gets a box with its name on it.
"""

import re
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module

from memorymaze.pictures.furniture.models import furniture_for
from memorymaze.pictures.kinds_of_looks import Looks
from memorymaze.pictures.looks.assembly import Assembly, ObjectModel, Order
from memorymaze.pictures.looks.bins_and_barriers import placeholder
from memorymaze.pictures.looks.windows import is_window, window_model
from memorymaze.pictures.tables import read_table
from memorymaze.sites.problems import SiteProblem
from memorymaze.sites.records import Landmark, Mount, Site

Builder = Callable[[Assembly, Order], None]
"""Puts a thing of a size, colour and text together."""
VARIANTS = 6
"""Things of one kind, size, colour and text come in at most so many looks."""
WITH_PICTURES = frozenset({
    "computer terminal", "digital sign", "exhibit panel", "information panel", "kiosk",
    "mural", "painting", "poster", "touch screen", "video wall",
})  # fmt: skip
"""Archetypes that show a picture, each thing another one."""


@dataclass(frozen=True, slots=True)
class Archetype:
    """A kind of thing with a look of its own."""

    module: str
    """Of `looks`, with a builder called as the archetype, such as `grand_piano`."""
    others: tuple[str, ...]
    """Further categories that look so."""

    def builder(self, name: str) -> Builder:
        """Return what builds it."""
        module = import_module(f"memorymaze.pictures.looks.{self.module}")
        return getattr(module, re.sub(r"[ -]", "_", name.lower()))


@cache
def archetypes() -> dict[str, Archetype]:
    """Return all archetypes by name; `archetypes.json` is read once."""
    table = read_table("archetypes.json", dict[str, dict[str, tuple[str, ...]]])
    return {
        name: Archetype(module, others)
        for module, group in table.items()
        for name, others in group.items()
    }


def archetype_of(category: str) -> str | None:
    """Return the archetype of a category of a site plan, a key of `archetypes`.

    None for a category that nothing is known of, which is shown as a box with its name.
    """
    names = _names()
    for phrase in _phrases(category):
        for form in (phrase, _singular(phrase)):
            if form in names:
                return names[form]
    return None


def problems_of_looks(site: Site) -> list[SiteProblem]:
    """Return a warning for each category of a plan that nothing looks like."""
    unknown = {
        thing.category: thing.id
        for thing in reversed(site.landmarks)
        if archetype_of(thing.category) is None
    }
    return [
        SiteProblem(
            feature,
            "known-look",
            f"expected a category that has a look, got {category!r}, shown as a box "
            "with its name; use a common noun such as bench, or end with one "
            "(reading bench)",
            "warning",
            site.source,
        )
        for category, feature in reversed(unknown.items())
    ]


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
    return archetypes()[archetype].builder(archetype)


@cache
def _names() -> dict[str, str]:
    """Return the archetype of each known category, in lower case."""
    return {
        category.lower(): archetype
        for archetype, kind in archetypes().items()
        for category in (archetype, *kind.others)
    }


def _phrases(category: str) -> list[str]:
    """Return a category, then what is left as words are taken away, best first."""
    words = re.sub(r"[_\s]+", " ", category).strip().lower().split()
    whole = [" ".join(words)] if words else []
    for word in ("of", "with", "for", "in", "on", "and"):
        if word in words[1:]:
            whole += _phrases(" ".join(words[: words.index(word, 1)]))
    return whole + [" ".join(words[start:]) for start in range(1, len(words))]


def _singular(phrase: str) -> str:
    if phrase.endswith("ches") or phrase.endswith("shes") or phrase.endswith("xes"):
        return phrase[:-2]
    if phrase.endswith("shelves"):
        return phrase[:-3] + "f"
    return phrase[:-1] if phrase.endswith("s") and not phrase.endswith("ss") else phrase
