"""Legs in the making, and how they become records."""

from dataclasses import dataclass, field

from memorymaze.routes.plan import (
    Arrival,
    Junction,
    Leg,
    Length,
    Mention,
    Outlook,
    Passing,
    Place,
    Side,
    Turn,
)
from memorymaze.understanding.clause import Event
from memorymaze.understanding.lengths import combine_lengths

_PLACES: dict[str, Place] = {
    "at": "turn",
    "until": "turn",
    "beside": "beside",
    "after": "before_turn",
    "before": "after_turn",
    "into": "target",
    "past": "passed",
}


@dataclass
class Draft:
    """A leg in the making."""

    lengths: list[Length] = field(default_factory=list[Length])
    mentions: list[Mention] = field(default_factory=list[Mention])
    passings: list[Passing] = field(default_factory=list[Passing])
    too_far: list[str] = field(default_factory=list[str])
    ahead: list[str] = field(default_factory=list[str])
    """What was said to lie along it."""
    behind: list[str] = field(default_factory=list[str])
    """What was said to lie the other way where it begins."""
    walls: list[Side] = field(default_factory=list[Side])
    """Sides without a way where it begins."""
    at_end: bool = False
    junction: Junction | None = None
    at_once: bool = False
    straight: bool = False
    side: Side | None = None
    """Side of what is not named: `it is on your left`."""
    turn: Turn | None = None
    plain_last: bool = False
    """True when the turn was one bare word after a thing named in its sentence."""

    @property
    def is_new(self) -> bool:
        """Whether nothing was said about it yet."""
        return not (
            self.lengths
            or self.mentions
            or self.passings
            or self.at_end
            or self.straight
            or self.junction
        )

    @property
    def outlook(self) -> Outlook:
        """What was said of its beginning."""
        return Outlook(
            tuple(dict.fromkeys(self.ahead)), tuple(self.behind), tuple(self.walls)
        )

    @property
    def has_ended(self) -> bool:
        """Whether it was said where it ends, though not which way one turns there."""
        return bool(
            self.at_end
            or self.junction
            or self.lengths
            or any(m.place in {"turn", "beside"} for m in self.mentions)
        )

    @property
    def has_passed_things(self) -> bool:
        """Whether something was named that lies before what is said next."""
        return any(m.place in {"passed", "before_turn"} for m in self.mentions)


def place_of(event: Event, back: bool) -> Place:
    """Return where on its leg a thing is, from how it was bound to its clause."""
    return _PLACES.get(event.relation, "turn" if back else "along")


def leg_of(draft: Draft) -> Leg:
    """Return the finished leg of a draft that ends in a turn."""
    return Leg(
        turn=draft.turn or Turn("forward_or_side"),
        length=combine_lengths(draft.lengths),
        mentions=tuple(draft.mentions),
        passings=tuple(draft.passings),
        too_far=tuple(draft.too_far),
        outlook=draft.outlook,
        goes=not draft.is_new,
    )


def arrival_of(
    draft: Draft, destinations: tuple[str, ...], side: Side | None, nth: int | None
) -> Arrival:
    """Return the last stretch, to one of the destinations."""
    return Arrival(
        destinations=destinations,
        side=side,
        nth=nth,
        length=combine_lengths(draft.lengths),
        at_end=draft.at_end,
        mentions=tuple(draft.mentions),
        passings=tuple(draft.passings),
        too_far=tuple(draft.too_far),
        outlook=draft.outlook,
        junction=draft.junction,
        goes=not draft.is_new,
    )
