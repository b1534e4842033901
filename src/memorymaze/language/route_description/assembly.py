"""From events to a plan: every piece of meaning finds its leg.

This is where what speakers leave out is inferred: a length or a landmark between two
turns is a stretch of walking; a place named at the end of a sentence belongs to the
turn before it; an opening named and then taken is a turn.
"""

from dataclasses import dataclass, field, replace

from memorymaze.language.route_description.events import Event
from memorymaze.language.route_description.lengths import combine_lengths
from memorymaze.language.route_description.plan import (
    Arrival,
    Junction,
    Leg,
    Length,
    Mention,
    Passing,
    Place,
    Side,
    Turn,
    Way,
)

__all__ = ["Draft", "assemble"]

_IMMEDIATE = Length(4.0, "vague")


@dataclass
class Draft:
    """A leg in the making."""

    lengths: list[Length] = field(default_factory=list[Length])
    things: list[Event] = field(default_factory=list[Event])
    mentions: list[Mention] = field(default_factory=list[Mention])
    passings: list[Passing] = field(default_factory=list[Passing])
    too_far: list[str] = field(default_factory=list[str])
    at_end: bool = False
    junction: Junction | None = None
    at_once: bool = False
    forced: bool = False
    straight: bool = False
    turn: Turn | None = None
    def things_passed(self) -> bool:
        """Tell whether something was named that lies before what is said next."""
        return any(m.place in {"passed", "before_turn"} for m in self.mentions)

    plain_last: bool = False
    """True when the turn was one bare word after a thing named in its sentence."""


def assemble(events: list[Event]) -> list[Draft]:
    """Return the legs in order; the last has no turn and leads to the destination."""
    return _Assembly(events).run()


class _Assembly:
    def __init__(self, events: list[Event]) -> None:
        self._events = events
        self._done: list[Draft] = []
        self._draft = Draft()
        self._way: Event | None = None
        """An opening that was named but neither taken nor left yet."""
        self._way_age = 0
        self._last: list[Mention] = []
        """Where the thing named last was put, so that a side can still be added."""
        self._side: Side | None = None
        """A side said before its thing: `on the left is …`."""
        self._fresh = True
        """True between a turn and the first word about the way after it."""

        self._restating = False
        """True in a sentence that says the last turn again."""
        self._restating_all = False
        """The same after `again,`, whatever was said since."""

    def run(self) -> list[Draft]:
        for at, event in enumerate(self._events):
            self._take_event(event, at)
        self._settle_way()
        self._end_on_a_side()
        return [*self._done, self._draft]

    def _end_on_a_side(self) -> None:
        """`Room 2347, left.`: the last word tells the side of the destination."""
        if not self._done or not self._draft_is_new():
            return
        last = self._done[-1]
        if last.turn is None or last.turn.at_end or last.turn.ordinal is not None:
            return
        if last.plain_last and last.mentions and last.turn.way in {"left", "right"}:
            self._done.pop()
            side: Side = "left" if last.turn.way == "left" else "right"
            last.mentions[-1] = replace(last.mentions[-1], side=side, place="along")
            last.turn = None
            self._draft = last

    def _take_event(self, event: Event, at: int) -> None:
        kind = event.kind
        if kind == "turn":
            self._add_turn(event, at)
        elif kind in {"sentence", "clause", "then"}:
            self._side = None
            if kind == "sentence":
                if self._way is not None and self._way.taken:
                    self._settle_way()
                self._restating = self._restating_all = False
            self._way_age += 1
            if self._way_age > 3:
                self._settle_way()
        elif kind == "length" and event.length is not None:
            self._settle_likely_way()
            target = self._done[-1] if event.back and self._done else self._draft
            target.lengths.append(event.length)
        elif kind == "thing":
            self._add_thing(event, at)
        elif kind == "side":
            self._add_side(event)
        elif kind == "end":
            self._add_end(event, at)
        elif kind == "junction":
            self._add_junction(event, at)
        elif kind == "pass_ways":
            self._settle_way()
            side = event.side if event.side in {"left", "right"} else None
            self._draft.passings.append(Passing(event.count, side))  # type: ignore[arg-type]
        elif kind == "way":
            self._settle_way()
            self._way, self._way_age = event, 0
            self._last = []
        elif kind == "take":
            if self._way is not None:
                self._turn_into(self._way)
        elif kind == "refuse":
            if self._way is not None:
                self._leave(self._way)
        elif kind == "too_far":
            target = self._draft if self._draft_is_new() and not self._done else None
            draft = target or (self._done[-1] if self._done else self._draft)
            draft.too_far.append(event.phrase)
        elif kind == "restate":
            self._restating_all = True
        elif kind == "at_once":
            self._draft.at_once = True
        elif kind == "forced":
            if self._done and self._said_nothing_new():
                last = self._done[-1]
                if last.turn is not None:
                    last.turn = replace(last.turn, forced=True)
        elif kind == "straight":
            if self._way is not None and not self._way.likely:
                self._leave(self._way)
            self._draft.straight = True

    # -- turns

    def _add_turn(self, event: Event, at: int) -> None:
        way = event.way
        ordinal = event.ordinal
        if self._way is not None:
            side = self._way.side
            if way is None and side in {"left", "right"}:
                way = side
            if way is None and side is None:
                way = self._passed_side()
            if side is None or side == way:
                if ordinal is None:
                    ordinal = self._way.ordinal
                    event = replace(event, nearest=self._way.nearest)
                self._way = None
            else:
                self._settle_way()
        if way is None and ordinal is not None:
            way = self._passed_side()
        if self._repeats(event, way, ordinal, at):
            return
        if way is None and self._draft_is_new() and self._done:
            return
        draft = self._draft
        if event.nearest and (draft.things_passed() or draft.lengths or draft.passings):
            ordinal = None
        at_once = draft.at_once or event.at_once
        if at_once and not draft.lengths and not draft.mentions and self._done:
            draft.lengths.append(_IMMEDIATE)
        draft.turn = Turn(
            way or "forward_or_side",
            ordinal=ordinal,
            at_end=draft.at_end,
            junction=draft.junction,
            immediate=at_once and bool(self._done),
            forced=event.forced or draft.forced,
            doubt=event.doubt,
        )
        draft.plain_last = (
            event.emphatic and not event.commanded and self._follows_a_thing(at)
        )
        self._done.append(draft)
        self._draft = Draft()
        self._last = []

    def _repeats(
        self, event: Event, way: Way | None, ordinal: int | None, at: int
    ) -> bool:
        """Tell whether a turn only says the last turn again.

        It does when it goes the same way, nothing else was said in between, and
        nothing (`then`, `again`, the next item of a list) says that it is a new one.
        """
        if not self._done or event.again or event.at_once:
            return False
        last = self._done[-1].turn
        if last is None or last.way != way:
            return False
        if self._restating_all:
            return True
        if not self._draft_is_new():
            only_length = not (
                self._draft.mentions or self._draft.passings or self._draft.at_end
            )
            said_so = ordinal is not None and ordinal == last.ordinal and event.emphatic
            if only_length and said_so and not event.commanded:
                self._done[-1].lengths.extend(self._draft.lengths)
                self._draft = Draft()
                return True
            return False
        if ordinal is not None and last.ordinal is None:
            return False
        if self._names_something_new(at):
            return False
        if event.forced or event.apposed or self._restating:
            return True
        for earlier in reversed(self._events[:at]):
            if earlier.kind == "sentence":
                self._restating = not earlier.counted
                return self._restating
            if earlier.kind == "then":
                return False
            if earlier.kind == "turn":
                same = ordinal is not None and ordinal == last.ordinal
                return same or event.commanded or earlier.commanded
        return False

    def _follows_a_thing(self, at: int) -> bool:
        for earlier in reversed(self._events[:at]):
            if earlier.kind in {"sentence", "turn", "then"}:
                return False
            if earlier.kind == "arrive":
                return True
            if earlier.kind == "thing" and earlier.relation not in {"see", "into", "at"}:
                return False
            if earlier.kind == "thing":
                named = earlier.relation != "at"
                return named or any(e.kind == "arrive" for e in self._sentence(at))
        return False

    def _sentence(self, at: int) -> list[Event]:
        """The events of the sentence up to an index."""
        start = at
        while start > 0 and self._events[start - 1].kind != "sentence":
            start -= 1
        return self._events[start:at]

    def _passed_side(self) -> Way | None:
        """`Skip the first left and take the second`: the side is said once."""
        for passing in reversed(self._draft.passings):
            if passing.side is not None:
                return passing.side
        return None

    def _names_something_new(self, at: int) -> bool:
        """Tell whether a place is said with a turn that the last leg does not name."""
        known = {
            word
            for draft in self._done[-2:]
            for mention in draft.mentions
            for word in mention.phrase.split()
        }
        for later in self._events[at + 1 :]:
            if later.kind != "thing":
                return False
            if later.back and not known & set(later.phrase.split()):
                return True
        return False

    def _turn_into(self, way: Event) -> None:
        self._way = None
        side = way.side if way.side in {"left", "right"} else None
        self._add_turn(
            replace(way, kind="turn", way=side, emphatic=False),  # type: ignore[arg-type]
            0,
        )

    def _leave(self, way: Event) -> None:
        self._way = None
        side = way.side if way.side in {"left", "right"} else None
        self._draft.passings.append(Passing(1, side))  # type: ignore[arg-type]

    def _settle_likely_way(self) -> None:
        """What is said next is about the way behind an opening that is surely taken."""
        if self._way is not None and self._way.likely and self._way_age:
            self._settle_way()

    def _settle_way(self) -> None:
        way, self._way = self._way, None
        if way is None:
            return
        if (way.likely and way.side in {"left", "right"}) or way.taken:
            self._turn_into(way)
        elif way.side in {"left", "right"}:
            self._leave(way)

    def _draft_is_new(self) -> bool:
        draft = self._draft
        return not (
            draft.lengths or draft.mentions or draft.passings or draft.at_end
            or draft.straight or draft.junction
        )  # fmt: skip

    def _said_nothing_new(self) -> bool:
        return self._draft_is_new()

    # -- things

    def _add_thing(self, event: Event, at: int) -> None:
        if event.relation == "from":
            return
        back = event.back or self._ends_the_turn(event, at)
        draft = self._done[-1] if back and self._done else self._draft
        mention = Mention(
            event.phrase,
            _place(event, back),
            side=self._side,
            weak=event.relation == "into",
            nth=event.ordinal,
            ignored=event.ignored,
        )
        self._side = None
        draft.mentions.append(mention)
        self._last = draft.mentions

    def _ends_the_turn(self, event: Event, at: int) -> bool:
        """`Turn right, opposite the hall.`: a place said last is that of the turn."""
        if event.relation not in {"at", "before", "after"} or not self._done:
            return False
        if not self._draft_is_new():
            return False
        for later in self._events[at + 1 :]:
            if later.kind == "sentence":
                break
            if later.kind not in {"side", "clause", "thing", "take"}:
                return False
        for earlier in reversed(self._events[:at]):
            if earlier.kind == "sentence":
                return False
            if earlier.kind == "turn":
                return True
        return False

    def _add_side(self, event: Event) -> None:
        if event.likely:
            self._side = event.side
        elif self._way is not None and self._way.side is None and not self._last:
            self._way = replace(self._way, side=event.side)
        elif self._last and self._last[-1].side is None:
            self._last[-1] = replace(self._last[-1], side=event.side)

    def _add_end(self, event: Event, at: int) -> None:
        self._settle_likely_way()
        if event.back or (
            event.relation == "at" and self._ends_the_turn(replace(event, relation="at"), at)
        ):
            last = self._done[-1]
            last.at_end = True
            if last.turn is not None:
                last.turn = replace(last.turn, at_end=True)
            return
        self._draft.at_end = True

    def _add_junction(self, event: Event, at: int) -> None:
        if event.back or self._ends_the_turn(replace(event, relation="at"), at):
            last = self._done[-1]
            if last.turn is not None and last.turn.junction is None:
                last.turn = replace(last.turn, junction=event.junction)
            return
        self._draft.junction = event.junction


def _place(event: Event, back: bool) -> Place:
    if event.relation in {"at", "until"}:
        return "turn"
    if event.relation == "after":
        return "before_turn"
    if event.relation == "before":
        return "after_turn"
    if event.relation == "into":
        return "target"
    if event.relation == "past":
        return "passed"
    return "along" if not back else "turn"


def leg_of(draft: Draft) -> Leg:
    """Return the finished leg of a draft that ends in a turn."""
    turn = draft.turn or Turn("forward_or_side")
    return Leg(
        turn=turn,
        length=combine_lengths(draft.lengths),
        mentions=tuple(draft.mentions),
        passings=tuple(draft.passings),
        too_far=tuple(draft.too_far),
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
    )
