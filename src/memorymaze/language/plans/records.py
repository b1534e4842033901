"""What a description of a way says, as immutable records.

They are the plan language of the project: readers of texts give them, agents walk with
them, writers of texts tell from them, and files hold them (`files.py`). A plan holds what
a speaker means, not what is true of a building.

`Leg`s are the compound actions of MARCO (MacMahon, Stankiewicz and Kuipers, AAAI 2006):
a stretch of walking with all that is said about it, and the turn that ends it.
"""

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import AfterValidator, ConfigDict, Field, StringConstraints

Way = Literal["left", "right", "slight_left", "slight_right", "either", "around"]
"""Where a turn leads; `either` where its side is not said. Going straight over a junction
is no turn but a `Passing`."""
Side = Literal["left", "right", "ahead", "behind"]
"""Where a thing is, as one walks."""
Junction = Literal["t", "crossing", "corner"]
"""Kinds of junction that speakers name: a wall ahead, four ways, one way on."""
Unit = Literal["metres", "steps", "time", "vague", "places"]
"""What a speaker counted in; `places` are corridors, blocks or junctions."""
Kind = Literal[
    "object", "sign", "door", "place", "floor", "wall", "sound", "smell", "person"
]
"""What a thing is; a `place` is an area, room, shop or corridor by its name."""
Place = Literal[
    "turn",
    "beside",
    "before_turn",
    "after_turn",
    "along",
    "passed",
    "target",
    "opposite",
]
"""Where a thing is said to be: right at the turn, next to it, shortly before it, only
after turning, somewhere on the stretch, walked past, what the turn leads to (with the
side `ahead` or `behind`: what one has there before oneself once one has turned), or
opposite the opening that one takes."""


def _not_zero(number: int) -> int:
    if number == 0:
        raise ValueError("Input should be 1 or more, or -1 for the last")
    return number


Words = Annotated[str, StringConstraints(min_length=1, pattern=r"\S")]
Doubt = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]
_Metres = Annotated[float, Field(ge=0, allow_inf_nan=False)]
STEP_METRES, SECOND_METRES = 0.7, 1.0
"""Metres of a step, and of a second of walking: a minute is 60 m."""
MOST_COUNTED, MOST_LEGS = 10**6, 200
"""What is more no speaker means; agents count and search with these."""
_Count = Annotated[int, Field(ge=1, le=MOST_COUNTED)]
Ordinal = Annotated[int, Field(ge=-1, le=MOST_COUNTED), AfterValidator(_not_zero)]
"""2 for `the second`, -1 for `the last`."""

_CHECKED = ConfigDict(extra="forbid", strict=True)


@dataclass(frozen=True, slots=True)
class Start:
    """What is said of the start only."""

    __pydantic_config__ = _CHECKED

    facing: Words | None = None
    """What one faces."""
    from_: Annotated[Words | None, Field(alias="from")] = None
    """What one comes from or has behind oneself; `from` in files."""


@dataclass(frozen=True, slots=True)
class Length:
    """How far a stretch is said to be."""

    __pydantic_config__ = _CHECKED

    metres: _Metres
    unit: Unit
    """It tells how far to trust the number."""
    count: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None
    """In the speaker's unit; of `places` always."""
    after: Words | None = None
    """The thing that it is counted from: `ten metres after the lift`."""
    at_most: bool = False
    """True where it is said as a bound: `two minutes at most`."""
    stretches: Annotated[int, Field(ge=1, le=MOST_LEGS)] = 1
    """So many it is of; the one that it is told with is the last."""
    doubt: Doubt = 0.0
    """The speaker's."""


@dataclass(frozen=True, slots=True)
class Mention:
    """A thing that is said to be on the way."""

    __pydantic_config__ = _CHECKED

    phrase: Words
    """Short, as one would ask a camera for it: `red sofa`, `sign that says Library`."""
    kind: Kind = "object"
    place: Place = "along"
    side: Side | None = None
    nth: Ordinal | None = None
    """2 for `the second door`."""
    after_metres: _Metres | None = None
    """How far along the stretch."""
    ignored: bool = False
    """True when it is to be left alone: said only so that it is not taken for something."""
    doubt: Doubt = 0.0
    """The speaker's."""


@dataclass(frozen=True, slots=True)
class Passing:
    """Openings or junctions that are left alone."""

    __pydantic_config__ = _CHECKED

    count: _Count | None = None
    """None when all there are."""
    side: Literal["left", "right"] | None = None
    what: Words | None = None
    """What they are called."""
    after_metres: _Metres | None = None
    """How far along the stretch."""
    doubt: Doubt = 0.0
    """The speaker's."""


@dataclass(frozen=True, slots=True)
class Turn:
    """A change of direction."""

    __pydantic_config__ = _CHECKED

    way: Way
    ordinal: Ordinal | None = None
    """2 for `the second left`; None where nothing was said."""
    or_ordinal: Ordinal | None = None
    """Another one that the speaker leaves open: `the second or third`."""
    counted_after: Words | None = None
    """What the counting starts from: `the first left after the clock`."""
    at_end: bool = False
    """True when it is said that one cannot go straight on there."""
    junction: Junction | None = None
    immediate: bool = False
    """True when it follows the turn before at once."""
    forced: bool = False
    """True when the way bends by itself and one only follows it."""
    doubt: Doubt = 0.0
    """The speaker's: 0.4 for `I think`, 0.7 for `maybe, not sure`."""


@dataclass(frozen=True, slots=True)
class Leg:
    """A stretch of walking and the turn that ends it."""

    __pydantic_config__ = _CHECKED

    turn: Turn
    on_the_spot: bool = False
    """True when nothing is walked before the turn."""
    length: Length | None = None
    mentions: tuple[Mention, ...] = ()
    """In the order they are met."""
    passings: tuple[Passing, ...] = ()
    too_far: tuple[Words, ...] = ()
    """Things that are met only after having missed the turn."""
    wrong_way: tuple[Words, ...] = ()
    """Things that are met only after having turned to the wrong side."""
    unclear: Doubt = 0.0
    """The reader's doubt whether this leg was understood as meant: that its turn is none."""


@dataclass(frozen=True, slots=True)
class Arrival:
    """The last stretch of walking, after the last turn, and the destination."""

    __pydantic_config__ = _CHECKED

    destinations: tuple[Words, ...] = ()
    """What a camera or a sign would show of it, the best first; empty if never named."""
    side: Side | None = None
    nth: Ordinal | None = None
    """3 for `the third door on the left`."""
    at_end: bool = False
    """True when it is at the end of the way."""
    length: Length | None = None
    mentions: tuple[Mention, ...] = ()
    passings: tuple[Passing, ...] = ()
    too_far: tuple[Words, ...] = ()
    wrong_way: tuple[Words, ...] = ()
    on_the_spot: bool = False
    """True when nothing is walked after the last turn."""
    doubt: Doubt = 0.0
    unclear: Doubt = 0.0
    unclear_names: tuple[Doubt, ...] = ()
    """The reader's doubt of each destination, in their order; none of those without."""


@dataclass(frozen=True, slots=True)
class Totals:
    """What is said of the whole way."""

    __pydantic_config__ = _CHECKED

    turns: Annotated[int, Field(ge=0, le=MOST_COUNTED)] | None = None
    metres: _Metres | None = None


@dataclass(frozen=True, slots=True)
class RoutePlan:
    """A whole description, in the order of the walk."""

    __pydantic_config__ = _CHECKED

    start: Start = Start()
    legs: Annotated[tuple[Leg, ...], Field(max_length=MOST_LEGS)] = ()
    arrival: Arrival = Arrival()
    totals: Totals = Totals()

    @property
    def tells_place_alone(self) -> bool:
        """Whether it tells what the place is or what is there, and nothing of the way."""
        arrival = self.arrival
        place = Arrival(
            arrival.destinations,
            mentions=arrival.mentions,
            too_far=arrival.too_far,
            wrong_way=arrival.wrong_way,
            doubt=arrival.doubt,
            unclear=arrival.unclear,
            unclear_names=arrival.unclear_names,
        )
        is_told = bool(place.destinations or place.mentions)
        return is_told and self == RoutePlan(arrival=place)
