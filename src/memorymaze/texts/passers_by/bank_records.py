"""The bank's records: answers, phrases for their slots, and the facts they tell."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Literal, get_args

from pydantic import ConfigDict, Field

from memorymaze.robot.api.asking import QuestionKind
from memorymaze.texts.passers_by.spoken_numbers import LENGTH_UNITS

StartSide = Literal["ahead", "left", "right", "back"]
End = Literal["ahead", "left", "right", "end"]
_Cue = Literal["next", "ordinal", "end", "thing", "crossing"]

WAY_CASES = ("0", "1", "2", "3", "4+")
"""The cases of ways that are told, by their turns."""
MANY_TURNS = len(WAY_CASES) - 1
REPLY_CASES: dict[tuple[str, str], frozenset[str]] = {
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
"""The cases of other replies, each with the slots that its answers may have."""
ALWAYS_GIVEN = frozenset({"destination", "thing", "place"})

OPPOSITES = {
    "left": "right",
    "right": "left",
    "half left": "half right",
    "half right": "half left",
}
_SIDED = ("side", "bend")
WORD_CASES: dict[tuple[str, str], tuple[tuple[str, ...], ...]] = {
    **{
        (slot, case): ()
        for slot in ("start", "set_off")
        for case in get_args(StartSide)
    },
    **{(slot, case): () for slot in _SIDED for case in OPPOSITES},
    **{("where", case): () for case in get_args(End)},
    **{("cue", case): () for case in ("next", "end", "crossing")},
    ("cue", "ordinal"): (("ordinal",),),
    ("cue", "thing"): (("thing",),),
    **{("turn", case): (_SIDED,) for case in ("next", "end", "crossing")},
    ("turn", "ordinal"): (_SIDED, ("ordinal",)),
    ("turn", "thing"): (_SIDED, ("thing",)),
    ("rest", "turn"): (("turn", *_SIDED), ("turn", "cue")),
    **{("length", unit): (("number",),) for unit in LENGTH_UNITS},
    ("length", "unmeasured"): (),
}
"""The cases of phrases, each with the slots that it needs, one of every group."""
SLOT = re.compile(r"\{(\w+?)(\d*)\}")


@dataclass(frozen=True, slots=True)
class TurnFact:
    """One turn of a way as somebody tells it."""

    side: str
    """`left`, `right`, `half left` or `half right`."""
    cue: _Cue
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

    start: StartSide
    """How one leaves, in the robot's frame: `ahead` is the way it faces."""
    turns: tuple[TurnFact, ...]
    end: End
    """Where the destination lies after the last turn; `end`: where the way ends."""
    destination: str
    metres: float
    """Length of the last stretch, from the last turn (or the start) to the destination."""


@dataclass(frozen=True, slots=True)
class Reply:
    """What somebody tells who tells no way."""

    case: str
    """One of `REPLY_CASES`, to a question of its kind."""
    slots: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Phrase:
    """Words with slots."""

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)

    case: str
    text: Annotated[str, Field(min_length=1)]
    source: Literal["llm"]

    @property
    def slots(self) -> frozenset[str]:
        """Return the names of its slots, with the numbers of turns."""
        return frozenset(name + number for name, number in SLOT.findall(self.text))


@dataclass(frozen=True, slots=True)
class BankAnswer(Phrase):
    """A whole answer, of one of `WAY_CASES` or `REPLY_CASES`."""

    id: str
    kind: QuestionKind
    manner: str
    """Whose voice it is."""

    @property
    def turns_told(self) -> int:
        """Return how many turns have slots of their own."""
        numbers = (number for _, number in SLOT.findall(self.text))
        return max((int(number) for number in numbers if number), default=0)


@dataclass(frozen=True, slots=True)
class CueWords(Phrase):
    """What a slot of answers, or of other phrases, is filled with."""

    slot: str
    manners: frozenset[str] = frozenset()
    """The voices that it fits; empty: all."""
    least: float = 0
    most: float = math.inf
    """The lengths that it is said of, in metres."""

    @property
    def is_for_all(self) -> bool:
        """Tell whether it fits every voice and every length."""
        return not self.manners and self.least == 0 and self.most == math.inf
