"""One clause: its chunks, a letter for the kind of each, and what it says as events."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from memorymaze.language.plans import Junction, Length, Side, Way
from memorymaze.language.reading.chunks import Chunk

EventKind = Literal[
    "turn",
    "length",
    "end",
    "junction",
    "thing",
    "side",
    "pass_ways",
    "way",
    "take",
    "refuse",
    "too_far",
    "wrong_way",
    "arrive",
    "at_once",
    "straight",
    "forced",
    "then",
    "recap",
    "restate",
    "along",
    "ahead",
    "wall",
    "sentence",
    "clause",
]
"""`way` is an opening that is named without saying whether to take it; `ahead` is what
lies along a way (`take the blue path`, `face the easel`), `wall` a side without a way,
`along` how far along the stretch the thing named last is."""

Relation = Literal[
    "at",
    "beside",
    "opposite",
    "between",
    "before",
    "after",
    "until",
    "past",
    "see",
    "seen",
    "from",
    "away",
    "into",
    "",
]
"""How a thing is bound to the clause: `before` and `after` as the words were said,
`seen` where it is said to be seen, `see` where it is only named, `between` where there
are two of it, one on either hand."""
AT_THE_TURN: frozenset[Relation] = frozenset({
    "at",
    "beside",
    "opposite",
    "before",
    "after",
})
"""How the thing is bound that says where a turn is."""


@dataclass(frozen=True, slots=True)
class ClauseEvent:
    """One piece of meaning; fields without a meaning for the kind stay empty."""

    kind: EventKind
    way: Way | None = None
    side: Side | None = None
    ordinal: int | None = None
    or_ordinal: int | None = None
    """Another one that is left open: `the second or third`."""
    count: int | None = None
    junction: Junction | None = None
    length: Length | None = None
    phrase: str = ""
    """Of a thing, or what an opening is called."""
    relation: Relation = ""
    ignored: bool = False
    """For `thing`: to be left alone."""
    of_goal: bool = False
    """Of `side` and `end`: of what is spoken of all the time: `it is on your left`."""
    back: bool = False
    """True when it was said after a turn in the same clause and belongs to it."""
    subject: bool = False
    """For `thing`: the clause is about it: `the toilets are …`."""
    nearest: bool = False
    """For an ordinal: said as `next`, counted from where the sentence has come to."""
    likely: bool = False
    """For `way`: true when it sounds like the one to take."""
    taken: bool = False
    """For `way`: said to be taken, only its side is still to come; for `refuse`: said of
    a way, not of anything."""
    doubt: float = 0.0
    forced: bool = False
    at_once: bool = False
    here: bool = False
    """For `turn` and `side`: said from where one stands."""
    aside: bool = False
    """For `turn`: said as `to the left` alone, which may be the side of something."""
    leaving: bool = False
    """For `turn` and `side`: said as where one goes off to: `to the left`, `there on the
    left`."""
    called: bool = False
    """For `thing`: its name alone, without a word of where it is: `The library.`"""
    joined: bool = False
    """For `turn`: the second of `right-left`."""
    emphatic: bool = False
    """For `turn`: a bare direction that starts a sentence; may repeat the last turn."""
    again: bool = False
    """For `turn`: said to be one more."""
    commanded: bool = False
    """For `turn`: said with a verb."""
    apposed: bool = False
    """For `turn`: said as `that is right`; may repeat a turn of the same sentence."""
    turns: bool = False
    """For `ahead`: one turns to it, unless one stands so already."""
    walks: bool = False
    """For `ahead` and `thing`: one walks there, not only faces it."""
    counted: bool = False
    """For `sentence`: the next sentence is an item of a counted list."""


_ADVERBS = "hiDarlp"
_STRONG_DOUBT = re.compile(r"maybe|perhaps|possibly|might|not\b")
_DOUBT = re.compile(r"i |i'm|i'd|probably|likely|presumably|apparently|remember")
DOUBT, STRONG_DOUBT = 0.4, 0.7
"""Of `I think`, and of `maybe`; `about 20 m` is no doubt."""
_OF_A_WAY = re.compile("[LS2dHOEuKPUVYMRI]")
"""Kinds that say where to go, or where not."""
_RECAP = re.compile(r"\b(?:both|like|i said)\b")


@dataclass(frozen=True)
class Clause:
    """A clause without its joint, and what was said before it."""

    said: Sequence[Chunk]
    """All its chunks."""
    before: Sequence[ClauseEvent]
    """Events of all clauses before."""

    @cached_property
    def chunks(self) -> list[Chunk]:
        """The chunks that the rules look at, adverbs left out."""
        return [chunk for chunk in self.said if chunk.kind not in _ADVERBS]

    @cached_property
    def kinds(self) -> str:
        """The kinds of `chunks`, one letter each."""
        return "".join(chunk.kind for chunk in self.chunks)

    @property
    def words(self) -> str:
        """What the chunks of `chunks` say."""
        return " ".join(chunk.text for chunk in self.chunks)

    def has(self, kind: str) -> bool:
        """Tell whether a chunk of a kind was said, adverbs included."""
        return any(chunk.kind == kind for chunk in self.said)

    @property
    def at_once_first(self) -> bool:
        """Whether its first turn is at once, not only its second: `right, soon left`."""
        said = "".join(chunk.kind for chunk in self.said)
        if len(re.findall("[LS2]", said)) + said.count("2") < 2:
            return "i" in said
        return re.match("[^LS2]*i[^2]*L", said) is not None

    @property
    def is_recap(self) -> bool:
        """Whether it may sum up what was said: `so right and left`."""
        return (
            self.has("r")
            or self.kinds == "Z2"
            or any(_RECAP.search(chunk.text) for chunk in self.said)
        )

    @property
    def is_of_the_speaker(self) -> bool:
        """Whether it tells of the speaker and no way: `I push my cart there`."""
        said = "".join(chunk.kind for chunk in self.said)
        if "p" not in said or re.search("[AwQ][^p]*Np", said):
            return False
        held = [chunk.text for chunk in self.chunks[:1]] in (["have"], ["get"])
        if (re.match("h*pX", said) or held) and not re.search("[LS2OT]", said):
            return True  # "I never see it", "I always get it wrong"
        return _OF_A_WAY.search(self.kinds) is None

    @property
    def is_first(self) -> bool:
        """Whether nothing was told of the way before it."""
        told = {"sentence", "clause", "then", "recap", "thing"}
        return all(event.kind in told for event in self.before)

    @property
    def has_verb(self) -> bool:
        """Whether it commands: `turn`, `go`, `bends`."""
        return re.search("[TGK]", self.kinds) is not None

    @property
    def doubt(self) -> float:
        """How much the speaker doubts, from 0 to 1."""
        said = [chunk.text for chunk in self.said if chunk.kind == "h"]
        if any(_STRONG_DOUBT.search(words) for words in said):
            return STRONG_DOUBT
        return DOUBT if any(_DOUBT.search(words) for words in said) else 0.0

    def kind_before(self, at: int) -> str:
        """Return the kind of the chunk before an index, "" at the beginning."""
        return self.kinds[at - 1] if at > 0 else ""

    def last_event(self) -> ClauseEvent | None:
        """Return what was said last before this clause."""
        return next((e for e in reversed(self.before) if e.kind != "clause"), None)


def side_of(chunk: Chunk) -> Side | None:
    """Return the side that a direction or `on the left` names."""
    if chunk.way is None:
        return "behind" if "clock" in chunk.text else None
    if chunk.way == "forward":
        return "ahead"
    return "left" if "left" in chunk.way else "right"


def is_aside(chunk: Chunk) -> bool:
    """Tell `on the left` from `to the left`."""
    return re.match(r"(?:on|at|in|from|along|of|with)\b", chunk.text) is not None


def towards_a_side(chunk: Chunk) -> bool:
    """Tell `to the left` from `on the left`."""
    return re.match(r"(?:to|towards?)\b", chunk.text) is not None
