"""Legs in the making, and how they become records."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from memorymaze.language.plans import (
    Arrival,
    Junction,
    Leg,
    Length,
    Mention,
    Passing,
    Place,
    RoutePlan,
    Side,
    Start,
    Turn,
    Way,
)
from memorymaze.language.reading.clause import ClauseEvent
from memorymaze.language.reading.lengths import combine_lengths
from memorymaze.language.reading.things import is_floor, kind_of

JUNCTION_NAMES: dict[Junction, str] = {
    "t": "t junction",
    "crossing": "crossing",
    "corner": "corner",
}
"""What a junction is called where one arrives at it."""
_PLACES: dict[str, Place] = {
    "at": "turn",
    "until": "turn",
    "beside": "beside",
    "opposite": "opposite",
    "between": "beside",
    "after": "before_turn",
    "before": "after_turn",
    "into": "target",
    "past": "passed",
}


@dataclass
class PartialLeg:
    """A leg in the making."""

    lengths: list[Length] = field(default_factory=list[Length])
    mentions: list[Mention] = field(default_factory=list[Mention])
    passings: list[Passing] = field(default_factory=list[Passing])
    too_far: list[str] = field(default_factory=list[str])
    wrong_way: list[str] = field(default_factory=list[str])
    ahead: list[str] = field(default_factory=list[str])
    """What was said to lie along it."""
    behind: list[str] = field(default_factory=list[str])
    """What was said to lie the other way where it begins."""
    between: list[str] = field(default_factory=list[str])
    """What there are two of, one before where it ends and one beyond."""
    walls: list[Side] = field(default_factory=list[Side])
    """Sides without a way where it begins."""
    at_end: bool = False
    junction: Junction | None = None
    at_once: bool = False
    straight: bool = False
    here: bool = False
    """Whether its turn is where one stands."""
    leaves: bool = False
    """Whether its turn only says how one leaves: `to the left, then …`"""
    called: set[int] = field(default_factory=set[int])
    """Indices of mentions that are names alone: `The library.`"""
    placed: bool = False
    """Whether it was said that its turn is at an opening or a junction."""
    entered: bool = False
    """Whether it was said what the turn before leads to."""
    side: Side | None = None
    """Side of what is not named: `it is on your left`."""
    turn: Turn | None = None
    origin: str = ""
    """What one comes from; of the first."""
    subjects: set[int] = field(default_factory=set[int])
    """Indices of mentions that a clause is about: `the chapel is on your left`."""
    bare_turn: bool = False
    """Whether the turn was one word, at the beginning of its clause."""
    told_at_end: bool = False
    """Whether its end was said to be where something is: `the office is at the end`."""
    aside_turn: bool = False
    """Whether its turn was said as `to the left` alone."""
    plain_last: bool = False
    """True when the turn was one bare word after a thing named in its sentence."""

    @property
    def is_new(self) -> bool:
        """Whether nothing was said about it yet."""
        return not (
            self.lengths
            or any(each.place != "target" for each in self.mentions)
            or self.passings
            or self.between
            or self.at_end
            or self.straight
            or self.entered
            or self.junction
        )

    @property
    def is_unsaid(self) -> bool:
        """Whether it was said neither how far one walks, nor on which side anything is."""
        sided = self.side or any(each.side for each in self.mentions)
        ends = self.at_end or self.junction is not None
        return not (self.lengths or self.straight or self.ahead or ends or sided)

    @property
    def walks(self) -> bool:
        """Whether it was said how far one walks, or where to."""
        there = any(each.place in {"turn", "passed"} for each in self.mentions)
        return bool(self.lengths or self.passings or self.straight or there) or (
            self.at_end or self.junction is not None
        )

    @property
    def passed_side(self) -> Literal["left", "right"] | None:
        """`Skip the first left and take the second`: the side is said once."""
        for passing in reversed(self.passings):
            if passing.side is not None:
                return passing.side
        return None

    @property
    def names_what_is_ahead(self) -> bool:
        """Whether the thing named last may be where the stretch ends."""
        return bool(self.mentions) and self.mentions[-1].side in {None, "ahead"}

    def drop_names(self) -> None:
        """`The library. Go to your left.`: no thing that one sees where one stands."""
        if self.here:
            kept = [n for n in range(len(self.mentions)) if n not in self.called]
            self.mentions = [self.mentions[n] for n in kept]

    def turn_at_last_thing(self) -> None:
        """`Information desk, right.`: what was named just before is where one turns."""
        last = self.mentions[-1]
        if last.place == "along" and not (last.ignored or is_floor(last.phrase)):
            self.mentions[-1] = replace(last, place="turn")

    @property
    def has_only_a_door(self) -> bool:
        """Whether nothing but the door of a numbered room was named on it."""
        other = self.lengths or self.passings or self.at_end or self.straight
        named = [each.phrase.startswith("door that says") for each in self.mentions]
        return named == [True] and not other

    @property
    def has_ended(self) -> bool:
        """Whether it was said where it ends, though not which way one turns there."""
        return bool(
            self.at_end
            or self.junction
            or self.lengths
            or any(m.place in {"turn", "beside", "opposite"} for m in self.mentions)
        )


def flank(side: Side | Way | None) -> Literal["left", "right"] | None:
    """Return a side if one can turn to it."""
    return side if side == "left" or side == "right" else None


def place_on_leg(event: ClauseEvent, back: bool) -> Place:
    """Return where on its leg a thing is, from how it was bound to its clause."""
    if event.relation == "into" and not back:
        return "along"
    return _PLACES.get(event.relation, "turn" if back else "along")


def plan_of(
    drafts: Sequence[PartialLeg],
    destinations: tuple[str, ...],
    side: Side | None,
    nth: int | None,
) -> RoutePlan:
    """Return the plan of drafts, the last of which leads to one of the destinations."""
    *before, last = drafts
    legs = tuple(_leg_of(number, draft, drafts) for number, draft in enumerate(before))
    return RoutePlan(
        start=_start_of(drafts[0]),
        legs=legs,
        arrival=Arrival(
            destinations=destinations,
            side=side,
            nth=nth,
            at_end=last.at_end,
            length=combine_lengths(last.lengths),
            mentions=tuple(
                each
                for each in _mentions_of(last, first=not legs)
                if each.phrase not in destinations or each.place == "passed"
            ),
            passings=tuple(last.passings),
            too_far=tuple(last.too_far),
            wrong_way=tuple(last.wrong_way),
            on_the_spot=last.is_new and not destinations,
        ),
    )


def _leg_of(number: int, draft: PartialLeg, drafts: Sequence[PartialLeg]) -> Leg:
    """Return the leg of a draft; what lies beyond its turn is said of it."""
    turn = draft.turn or Turn("either")
    before = drafts[number - 1].turn if number else None
    turned = before is None or before.way == "around" or drafts[number].ahead
    return Leg(
        turn=turn,
        on_the_spot=draft.here
        or (draft.is_new and bool(turned) and _may_be_here(draft, turn)),
        length=combine_lengths(draft.lengths),
        mentions=(
            *_mentions_of(draft, first=not number),
            *_outlook_of(drafts[number + 1]),
        ),
        passings=tuple(draft.passings),
        too_far=tuple(draft.too_far),
        wrong_way=tuple(draft.wrong_way),
    )


def _may_be_here(draft: PartialLeg, turn: Turn) -> bool:
    """Tell whether a turn of which nothing else is said can be where one stands."""
    if draft.placed or turn.at_end or turn.forced:
        return False
    return turn.ordinal is None and turn.junction is None


def _start_of(draft: PartialLeg) -> Start:
    """Return what is said of the start; where the wall is, when that is said."""
    ahead = list(dict.fromkeys(draft.ahead))
    behind = list(draft.behind)
    if "ahead" in draft.walls:
        ahead.append("wall")
    if "behind" in draft.walls:
        behind.append("wall")
    if not behind and draft.origin:
        behind.append(draft.origin)
    return Start(" and ".join(ahead) or None, " and ".join(behind) or None)


def _outlook_of(draft: PartialLeg) -> Iterator[Mention]:
    """Yield what one has before, behind and beside oneself where a stretch begins."""
    for phrase in dict.fromkeys(draft.ahead):
        yield Mention(phrase, kind_of(phrase), "target", side="ahead")
    for phrase in draft.behind:
        yield Mention(phrase, kind_of(phrase), "target", side="behind")
    for side in draft.walls:
        yield Mention("wall", "wall", "target", side=side)


def _mentions_of(draft: PartialLeg, *, first: bool) -> tuple[Mention, ...]:
    """Return the things on a stretch, and the junction at the end of the last one."""
    walls = [
        Mention("wall", "wall", "along", side=side)
        for side in draft.walls
        if first and side in {"left", "right"}
    ]
    between = [
        each
        for phrase in draft.between
        for each in (
            Mention(phrase, kind_of(phrase), "passed"),
            Mention(phrase, kind_of(phrase), "along", side="ahead"),
        )
    ]
    ends = draft.turn is None and draft.junction is not None
    junction = JUNCTION_NAMES[draft.junction] if ends and draft.junction else ""
    place = [Mention(junction, "place", "turn")] if junction else []
    return (*walls, *draft.mentions, *between, *place)
