"""What each kind of building has: rooms, things and words, from `data/`."""

import tomllib
from functools import cache
from importlib.resources import files
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class _Model(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class RoomKind(_Model):
    """A kind of room that there are many of."""

    name: str
    """With `{number}` where it has one; with `{shop}` it takes one of the names."""
    use: str
    width: tuple[float, float]
    """Metres along the corridor."""
    depth: float
    """Metres."""
    door: str
    weight: float


class Special(_Model):
    """A room that a building has once, or a few times."""

    name: str
    use: str
    width: float
    depth: float
    door: str
    programs: tuple[str, ...]
    """Along which streets and halls it may lie."""
    count: int = 1
    destination: bool = False
    """Whether signs point to it and routes lead to it."""
    sign: str | None = None
    """Words of the restroom sign beside it."""
    beside: str | None = None
    """Name of the like room next to it."""


class Program(_Model):
    """What a street or hall is made of, and what is along it."""

    floor: str
    wall: str
    density: Annotated[float, Field(gt=0)]
    """Things per 10 m of wall."""
    rooms: tuple[RoomKind, ...]
    things: dict[str, float]
    """Weights of the kinds of things along its walls."""
    furniture: tuple[str, ...] = ()
    """Kinds of things that stand about in a hall."""
    ends: tuple[str, ...] = ("window",)
    """What closes dead ends: `stairs`, `exit` or `window`."""


class Vocabulary(_Model):
    """A kind of building in words."""

    titles: tuple[str, ...]
    floors: tuple[str, ...]
    ceilings: tuple[float, ...]
    programs: dict[str, Program]
    specials: tuple[Special, ...]
    texts: dict[str, tuple[str, ...]] = {}
    """Words on things, by category."""
    names: dict[str, tuple[str, ...]] = {}
    """Names that rooms take, each once."""
    number: str = "{floor}{zone}{count:02d}"
    """How rooms are numbered; `{letter}` is that of the zone."""


@cache
def vocabulary(kind: str) -> Vocabulary:
    """Return the words of a kind of building."""
    path = files("memorymaze.world.construction") / "data" / f"{kind}.toml"
    return Vocabulary.model_validate(tomllib.loads(path.read_text("utf-8")))
