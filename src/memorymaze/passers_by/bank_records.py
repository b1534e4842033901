"""The bank's records: answers, phrases for their slots, and the facts they tell."""

import math
import re
from dataclasses import dataclass
from typing import Annotated, Literal, get_args

from pydantic import ConfigDict, Field

from memorymaze.passers_by.spoken_numbers import LENGTH_UNITS
from memorymaze.robot.asking import QuestionKind

Start = Literal["ahead", "left", "right", "back"]
End = Literal["ahead", "left", "right", "end"]
Cue = Literal["next", "ordinal", "end", "thing", "crossing"]

MANY_TURNS = 4
"""An answer for this number of turns does for more as well."""
CASES: dict[tuple[QuestionKind, str], frozenset[str]] = {
    ("way_to", "unknown"): frozenset({"destination"}),
    **{
        ("where_is", case): frozenset({"thing", "metres", "near"})
        for case in ("ahead", "left", "right", "behind", "far")
    },
    ("where_is", "unknown"): frozenset({"thing"}),
    ("is_this", "yes"): frozenset({"place", "near"}),
    ("is_this", "no"): frozenset({"place", "near"}),
    ("is_this", "not_yet"): frozenset({"place", "where"}),
    ("is_this", "unsure"): frozenset({"place"}),
}
"""The cases of replies, each with the slots that its answers may have."""
ALWAYS_GIVEN = frozenset({"destination", "thing", "place"})

SIDES = ("left", "right", "half left", "half right")
OPPOSITES: dict[str, str] = dict(
    zip(SIDES, ("right", "left", "half right", "half left"), strict=True)
)
WORD_CASES: dict[str, tuple[str, ...]] = {
    "start": get_args(Start),
    "set_off": get_args(Start),
    "side": SIDES,
    "bend": SIDES,
    "cue": get_args(Cue),
    "turn": get_args(Cue),
    "where": get_args(End),
    "length": (*LENGTH_UNITS, "unmeasured"),
    "rest": ("turn",),
}
"""The slots that phrases fill, each with the cases that it has phrases for."""
SLOT = re.compile(r"\{(\w+?)(\d*)\}")


@dataclass(frozen=True, slots=True)
class TurnFact:
    """One turn of a way as somebody tells it."""

    side: str
    """`left`, `right`, `half left` or `half right`."""
    cue: Cue
    """What the turn is known by."""
    ordinal: int
    """Which opening it is, from 1; said with the cue `ordinal` only."""
    thing: str
    """With its article, such as `the drinks machine`; said with the cue `thing` only."""
    metres: float
    """Length of the stretch before the turn."""


@dataclass(frozen=True, slots=True)
class WayFacts:
    """A way as somebody tells it, from where robot and person stand."""

    start: Start
    """How one leaves, in the robot's frame: `ahead` is the way it faces."""
    turns: tuple[TurnFact, ...]
    end: End
    """Where the destination lies after the last turn; `end`: where the way ends."""
    destination: str
    metres: float
    """Length of the last stretch, from the last turn (or the start) to the destination."""


@dataclass(frozen=True, slots=True)
class Answer:
    """A whole answer with slots."""

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    id: str
    kind: QuestionKind
    manner: str
    """Whose voice it is."""
    text: Annotated[str, Field(min_length=1)]
    source: Literal["llm"]
    turns: Annotated[int, Field(ge=0, le=MANY_TURNS)] | None = None
    """Of a way told; `MANY_TURNS` for that many and more."""
    case: str | None = None
    """Of any other reply."""
    partial: bool = False
    """Whether it tells the first turns only and sends one to ask again."""

    @property
    def slots(self) -> frozenset[str]:
        """Return the names of its slots, with the numbers of turns."""
        return frozenset(name + number for name, number in SLOT.findall(self.text))

    @property
    def turns_told(self) -> int:
        """Return how many turns it has slots for."""
        return max(
            (int(number) for _, number in SLOT.findall(self.text) if number), default=0
        )

    @property
    def corrects_itself(self) -> bool:
        """Tell whether the wrong side of a turn is said before the one that is meant."""
        return any(slot.startswith("wrong") for slot in self.slots)


@dataclass(frozen=True, slots=True)
class CueWords:
    """A phrase for a slot of answers, or of other phrases."""

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    slot: str
    case: str
    text: Annotated[str, Field(min_length=1)]
    source: Literal["llm"]
    manners: frozenset[str] = frozenset()
    """The voices that it fits; empty: all."""
    least: float = 0
    most: float = math.inf
    """The lengths that it is said of, in metres."""

    @property
    def slots(self) -> frozenset[str]:
        """Return the names of its slots."""
        return frozenset(name + number for name, number in SLOT.findall(self.text))
