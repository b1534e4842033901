"""What things and doors there are in buildings: the table `data/things.toml`.

A category of a plan is looked up as it stands, then without what follows `of`, `with` or
`for` (`statue of a bear` is a statue), then without its first words (`antique corner
sofa`).
"""

import re
import tomllib
from functools import cache
from importlib.resources import files
from typing import Literal, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from memorymaze.basics.input_files import mistakes
from memorymaze.world.sites.problems import SiteProblem
from memorymaze.world.sites.records import Mount, Site

TABLE = files("memorymaze.world.sites") / "data" / "things.toml"


class _Kind(BaseModel):
    """A kind by its name in the table."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str


_AnyKind = TypeVar("_AnyKind", bound=_Kind)


class DoorKind(_Kind):
    """A kind of door."""

    style: str
    colors: tuple[str, ...]
    width: float
    """Metres."""


class ThingKind(_Kind):
    """A kind of thing; its name is a common English noun, as categories of plans are."""

    like: str | None = None
    """Another kind that it looks like; None for one with a look of its own."""
    also: tuple[str, ...] = ()
    """Further names."""
    size: tuple[float, float, float]
    """Length across the front, depth, height; metres."""
    mount: Mount
    colors: tuple[str, ...] = ()
    """What made buildings choose from; none for what they do not have."""
    texts: tuple[str, ...] = ()
    """Words on it that made buildings choose from."""
    obstacle: bool = False
    """Of what hangs on a wall: whether it is in the way."""
    left_standing: Literal["at walls", "anywhere"] | None = None
    """Where it may be left in the way: along walls, or in the middle of wide ways too."""

    @property
    def look(self) -> str:
        """Name of the kind that it looks like."""
        return self.like or self.name

    @property
    def in_the_way(self) -> bool:
        """Whether a robot must not drive through it."""
        return self.obstacle or self.mount == "floor"


@cache
def thing_kinds() -> dict[str, ThingKind]:
    """Return all kinds of things by name, in the order of the table."""
    return read_things(TABLE.read_text("utf-8"))


@cache
def door_kinds() -> dict[str, DoorKind]:
    """Return all kinds of doors by name."""
    return _read(TABLE.read_text("utf-8"), "doors", DoorKind)


@cache
def kind_of_thing(category: str) -> ThingKind | None:
    """Return what kind of thing a category of a site plan means, None if none is known."""
    names = _names()
    for phrase in _phrases(category):
        for form in (phrase, _singular(phrase)):
            if form in names:
                return names[form]
    return None


def problems_of_categories(site: Site) -> list[SiteProblem]:
    """Return a warning for each category of a plan that is no known kind of thing."""
    unknown = {
        thing.category: thing.id
        for thing in reversed(site.landmarks)
        if kind_of_thing(thing.category) is None
    }
    return [
        SiteProblem(
            feature,
            "known-look",
            f"expected a category that has a look, got {category!r}, shown as a box "
            "with its name; use a common noun such as bench, or end with one "
            "(reading bench)",
            "warning",
        )
        for category, feature in reversed(unknown.items())
    ]


def read_things(text: str) -> dict[str, ThingKind]:
    """Return the kinds of things that a table tells of; ValueError names an entry."""
    kinds = _read(text, "things", ThingKind)
    known: dict[str, str] = {}
    for kind in kinds.values():
        if kind.look not in kinds or kinds[kind.look].like:
            raise ValueError(
                f"{TABLE.name}: things.{kind.name}.like: expected a kind with a look of "
                f"its own, got {kind.like!r}"
            )
        for name in _names_of(kind):
            if name in known:
                raise ValueError(
                    f"{TABLE.name}: things.{kind.name}: expected names of its own, got "
                    f"{name!r}, which is {known[name]}"
                )
            known[name] = kind.name
    return kinds


def _read(text: str, part: str, kind: type[_AnyKind]) -> dict[str, _AnyKind]:
    """Return the kinds of one part of the table by name."""
    kinds: dict[str, _AnyKind] = {}
    for name, row in tomllib.loads(text)[part].items():
        try:
            kinds[name] = kind.model_validate({**row, "name": name})
        except ValidationError as error:
            [(where, what), *_] = mistakes(error)
            raise ValueError(f"{TABLE.name}: {part}.{name}.{where}: {what}") from None
    return kinds


@cache
def _names() -> dict[str, ThingKind]:
    """Return the kind that each known name means, in lower case."""
    return {name: kind for kind in thing_kinds().values() for name in _names_of(kind)}


def _names_of(kind: ThingKind) -> list[str]:
    return [name.lower() for name in (kind.name, *kind.also)]


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
