"""What one clause says, before it is put in its place on the route."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.routes.plan import Junction, Length, Side, Way

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
    "arrive",
    "at_once",
    "straight",
    "forced",
    "then",
    "recap",
    "restate",
    "ahead",
    "wall",
    "sentence",
    "clause",
]
"""`way` is an opening that is named without saying whether to take it; `ahead` is what
lies along a way (`take the blue path`, `face the easel`), `wall` a side without a way."""

Relation = Literal[
    "at",
    "beside",
    "before",
    "after",
    "until",
    "past",
    "see",
    "from",
    "away",
    "into",
    "",
]
"""How a thing is bound to the clause: `before` and `after` as the words were said."""


@dataclass(frozen=True, slots=True)
class Event:
    """One piece of meaning; fields without a meaning for the kind stay empty."""

    kind: EventKind
    way: Way | None = None
    side: Side | None = None
    ordinal: int | None = None
    count: int | None = None
    junction: Junction | None = None
    length: Length | None = None
    phrase: str = ""
    relation: Relation = ""
    ignored: bool = False
    """For `thing`: to be left alone."""
    of_goal: bool = False
    """For `side`: of what is spoken of all the time: `it is on your left`."""
    back: bool = False
    """True when it was said after a turn in the same clause and belongs to it."""
    subject: bool = False
    """For `thing`: the clause is about it: `the toilets are …`."""
    nearest: bool = False
    """For an ordinal: said as `next`, counted from where the sentence has come to."""
    likely: bool = False
    """For `way`: true when it sounds like the one to take."""
    taken: bool = False
    """For `way`: said to be taken, only its side is still to come."""
    doubt: float = 0.0
    forced: bool = False
    at_once: bool = False
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
    """For `ahead`: one walks that way, not only faces it."""
    counted: bool = False
    """For `sentence`: the next sentence is an item of a counted list."""
