"""What a route description says, as immutable records.

`Leg`s are the compound actions of MARCO (MacMahon, Stankiewicz and Kuipers, AAAI 2006):
a stretch of walking with all that is said about it, and the turn that ends it.
"""

from dataclasses import dataclass, field
from typing import Literal

Way = Literal[
    "left",
    "right",
    "slight_left",
    "slight_right",
    "forward",
    "forward_or_side",
    "facing",
    "around",
]
"""Where a described turn leads; `forward_or_side` when only "turn" was said, `facing`
when it was said what lies that way and not to which side it is."""

Side = Literal["left", "right", "ahead", "behind"]

Junction = Literal["t", "crossing", "corner"]
"""Kinds of junction that speakers name: a wall ahead, four ways, one way on."""

Place = Literal[
    "turn", "beside", "before_turn", "after_turn", "along", "passed", "target"
]
"""Where on a leg a thing is said to be.

`turn` at the place of the turn, `beside` next to it, `before_turn` met shortly before it, `after_turn` the
turn comes before the thing, `along` anywhere on the leg, `passed` before the turn is
reached, `target` what the turn leads to.
"""


@dataclass(frozen=True, slots=True)
class Length:
    """How far a leg is said to be."""

    metres: float
    unit: Literal["metres", "steps", "time", "vague", "segments"]
    """What the speaker counted in; it tells how far to trust the number."""
    count: float | None = None
    """Of `segments`: from one place where one can turn to the next."""


@dataclass(frozen=True, slots=True)
class Mention:
    """A thing that is said to be on the way."""

    phrase: str
    """The words for it, such as `red and blue vending machines`."""
    place: Place
    side: Side | None = None
    weak: bool = False
    """True for names of ways and rooms, which a camera may have nothing to show for."""
    nth: int | None = None
    """2 for `the second door`."""
    subject: bool = False
    """True when a clause says where it is: `the chapel is on your left`."""
    ignored: bool = False
    """True when it is to be left alone: on the way, but never the destination."""


@dataclass(frozen=True, slots=True)
class Passing:
    """Openings or junctions that are said to be left alone."""

    count: int | None
    """None when all there are."""
    side: Literal["left", "right"] | None


@dataclass(frozen=True, slots=True)
class Turn:
    """A change of direction."""

    way: Way
    ordinal: int | None = None
    """1 for the first possibility; -1 for the last; None when nothing was said."""
    at_end: bool = False
    """True when one cannot go straight on there."""
    junction: Junction | None = None
    immediate: bool = False
    """True when it follows the turn before at once (`a quick right-left`)."""
    forced: bool = False
    """True when the way is said to bend by itself."""
    doubt: float = 0.0
    """0 for a plain statement up to 1 for `maybe`, `I think`."""


@dataclass(frozen=True, slots=True)
class Outlook:
    """What one sees, or has around oneself, facing along a stretch before walking it."""

    ahead: tuple[str, ...] = ()
    """Floors of the way, and things that lie that way."""
    behind: tuple[str, ...] = ()
    """Things that lie the other way."""
    walls: tuple[Side, ...] = ()
    """Sides on which there is no way."""


@dataclass(frozen=True, slots=True)
class Leg:
    """A stretch of walking and the turn that ends it."""

    turn: Turn
    length: Length | None = None
    mentions: tuple[Mention, ...] = ()
    passings: tuple[Passing, ...] = ()
    too_far: tuple[str, ...] = ()
    """Things that one meets only after missing the turn."""
    outlook: Outlook = Outlook()
    goes: bool = True
    """False when nothing says that one walks before the turn."""


@dataclass(frozen=True, slots=True)
class Arrival:
    """The last stretch of walking and what ends it."""

    destinations: tuple[str, ...] = ()
    """Words for the destination, the most likely first."""
    side: Side | None = None
    nth: int | None = None
    """2 when it is the second of its kind."""
    length: Length | None = None
    at_end: bool = False
    mentions: tuple[Mention, ...] = ()
    passings: tuple[Passing, ...] = ()
    too_far: tuple[str, ...] = ()
    outlook: Outlook = Outlook()
    junction: Junction | None = None
    goes: bool = True
    """False when nothing says that one walks to it."""


@dataclass(frozen=True, slots=True)
class RoutePlan:
    """A whole description, in the order of the walk."""

    legs: tuple[Leg, ...] = ()
    arrival: Arrival = field(default_factory=Arrival)
    skipped: tuple[str, ...] = ()
    """Clauses from which nothing was taken, as said."""
