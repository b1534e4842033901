"""From events to legs: every piece of meaning finds its place on the route.

This is where what speakers leave out is inferred: a length or a landmark between two
turns is a stretch of walking; a place named at the end of a sentence belongs to the
turn before it; an opening named and then taken is a turn.
"""

from collections.abc import Sequence
from dataclasses import replace

from memorymaze.language.plans import Length, Mention, Passing, Side, Turn, Way
from memorymaze.language.reading.clause import AT_THE_TURN, ClauseEvent
from memorymaze.language.reading.endings import ended_on_a_side
from memorymaze.language.reading.event_order import (
    counted_from,
    ends_the_sentence_of_a_turn,
    follows_a_thing,
    told_since_turn,
)
from memorymaze.language.reading.lengths import PLACE_METRES
from memorymaze.language.reading.partial_legs import PartialLeg, flank, place_on_leg
from memorymaze.language.reading.repetitions import Restating
from memorymaze.language.reading.setting_off import SettingOff
from memorymaze.language.reading.things import is_floor, kind_of

_LONGEST_OPEN = 3
"""Clauses after which an opening that was named counts as left alone."""


def assemble(events: Sequence[ClauseEvent]) -> list[PartialLeg]:
    """Return the legs in order; the last has no turn and leads to the destination."""
    return _Assembly(events).run()


class _Assembly:
    def __init__(self, events: Sequence[ClauseEvent]) -> None:
        self._events = events
        self._done: list[PartialLeg] = []
        self._draft = PartialLeg()
        self._restating = Restating(events)
        self._setting_off = SettingOff(events)
        self._way: ClauseEvent | None = None
        """An opening that was named but neither taken nor left yet."""
        self._way_age = 0
        self._since_thing = 9
        """Clauses since a thing was named on this leg, in this sentence."""
        self._stands_there = False
        """Whether it was only named: `There is a clock. Turn right.`"""
        self._counted: set[int] = set()
        """Numbers of junctions told on the legs before, for counts that go on."""
        self._left: dict[int, Side | None] = {}
        """Sides of the openings left alone on this leg, by their numbers."""
        self._counting: set[int] = set()
        """Those told on this leg."""
        self._last: list[Mention] = []
        """Where the thing named last was put, so that a side can still be added."""
        self._side: Side | None = None
        """A side said before its thing: `on the left is …`."""

    def run(self) -> list[PartialLeg]:
        for at, event in enumerate(self._events):
            self._take(event, at)
        self._end_at_an_opening()
        self._end_beside_a_way()
        self._settle_way()
        self._draft = ended_on_a_side(self._done, self._draft)
        legs = [*self._done, self._draft]
        legs[0].drop_names()
        return legs

    def _take(self, event: ClauseEvent, at: int) -> None:
        match event.kind:
            case "turn":
                self._add_turn(event, at)
            case "sentence" | "clause" | "then":
                self._close_clause(event)
            case "length":
                self._add_length(event, at)
            case "thing":
                self._add_thing(event, at)
            case "side":
                self._add_side(event, at)
            case "end" | "junction":
                self._add_place(event, at)
            case "pass_ways":
                self._settle_way()
                self._draft.passings.append(
                    Passing(event.count, flank(event.side), event.phrase or None)
                )
            case "way" if event.back and self._done:
                self._done[-1].placed = True
                self._change_last_turn(ordinal=event.ordinal)
            case "way":
                if self._is_named_again(event):
                    self._way = None  # "there is a left, hm, there is a left"
                self._settle_way()
                self._way, self._way_age = self._newly_counted(event), 0
                self._setting_off.note_side(event, at)
                self._last = []
            case "take" if self._way is not None:
                self._turn_into(self._way, at)
            case "take":
                self._go_through_a_door(at)
            case "refuse" if self._way is not None:
                self._leave(self._way)
            case "refuse" if event.taken and told_since_turn(self._events, at) == 0:
                self._take_back()
            case "too_far":
                self._warned_draft().too_far.append(event.phrase)
            case "wrong_way":
                self._warned_draft().wrong_way.append(event.phrase)
            case "ahead":
                self._add_ahead(event, at)
            case "wall" if event.side is not None:
                self._face_anew(at, always=False)
                self._draft.walls.append(event.side)
            case "along" if self._last and event.length is not None:
                self._last[-1] = replace(
                    self._last[-1], after_metres=event.length.metres
                )
            case "restate":
                self._restating.announce()
            case "at_once":
                self._draft.at_once = True
            case "forced" if self._done and self._draft.is_new:
                self._change_last_turn(forced=True)
            case "straight":
                self._go_straight(event, at)
            case _:
                pass

    def _warned_draft(self) -> PartialLeg:
        """A warning is about the last turn."""
        return self._done[-1] if self._done else self._draft

    def _close_clause(self, event: ClauseEvent) -> None:
        self._side = None
        self._way_age += 1
        self._since_thing += 1
        if event.kind == "sentence":
            if not (self._stands_there and self._draft.names_what_is_ahead):
                self._since_thing += 1  # "You see a clock. Turn right."
            if self._way and (self._way.taken or self._counts_on(self._way)):
                self._settle_way()
            self._restating.new_sentence()
        if self._way_age > _LONGEST_OPEN:
            self._settle_way()

    # -- turns

    def _add_turn(self, event: ClauseEvent, at: int) -> None:
        self._set_off(self._setting_off.side_before_a_turn(at))
        event = self._with_named_way(event)
        way: Way | None = event.way
        if way is not None and self._tells_side_of_bend(at):
            self._change_last_turn(way=way)
            return
        if way is None and event.ordinal is not None:
            way = self._draft.passed_side
        if self._restating.repeats(at, way, event.ordinal, self._done, self._draft):
            self._done[-1].lengths.extend(self._draft.lengths)
            self._draft = PartialLeg(side=flank(way) if event.aside else None)
            self._since_thing = 9
            return
        if way is None and self._draft.is_new and self._done and not event.subject:
            return
        draft = self._draft
        if not self._done and draft.side == "ahead":
            draft.straight = True  # "straight ahead, right at the second one"
        ordinal = event.ordinal
        if event.nearest or self._left.get((ordinal or 0) - 1, way) != way:
            ordinal = None  # "next", or counted on both sides
        at_once = (draft.at_once or event.at_once) and bool(self._done)
        before = [m.phrase for m in draft.mentions if m.place == "before_turn"]
        draft.turn = Turn(
            way or "either",
            ordinal=ordinal,
            or_ordinal=event.or_ordinal,
            counted_after=before[-1] if before and ordinal is not None else None,
            at_end=draft.at_end or draft.junction == "t",
            junction=draft.junction,
            immediate=at_once,
            forced=event.forced,
            doubt=event.doubt,
        )
        draft.placed = draft.placed or event.ordinal is not None
        draft.leaves = not self._done and self._setting_off.is_told(event, at, draft)
        draft.here = draft.leaves or (event.here and not (self._done or draft.walks))
        elsewhere = any(
            each.back and (each.kind != "junction" or each.junction is not None)
            for each in self._events[at + 1 : at + 2]
        )  # "the corner with the stool. turn left at this corner": at the stool
        if self._since_thing <= 1 and not (elsewhere or draft.here):
            draft.turn_at_last_thing()
        draft.bare_turn = event.emphatic and not (event.commanded or event.again)
        then = self._events[at - 1].kind == "then" and not event.apposed
        draft.aside_turn = event.aside and not then
        draft.plain_last = draft.bare_turn and follows_a_thing(self._events, at)
        self._done.append(draft)
        self._draft, self._since_thing = PartialLeg(), 9
        self._counted |= self._counting
        self._counting, self._left, self._last = set(), {}, []

    def _tells_side_of_bend(self, at: int) -> bool:
        """`There is a bend and you go left with it`: one turn, its side told late."""
        turn = self._done[-1].turn if self._done else None
        if turn is None or turn.way != "either" or not self._draft.is_new:
            return False
        placed = [e.back for e in self._events[at + 1 : at + 2]]
        return told_since_turn(self._events, at) is not None and placed != [True]

    def _take_back(self) -> None:
        """`It goes off to the right, not that.`: an opening, and left alone."""
        last = self._done[-1] if self._done else self._draft
        if last.turn is None or last.turn.way not in {"left", "right"}:
            return
        side: Side = "left" if last.turn.way == "left" else "right"
        last.turn = None
        self._draft = self._done.pop()
        self._leave(ClauseEvent("way", side=side))

    def _is_named_again(self, event: ClauseEvent) -> bool:
        named = self._way
        return (
            named is not None
            and self._way_age > 0
            and not (named.taken or event.taken or named.ordinal or event.ordinal)
            and (named.side, named.phrase, named.count)
            == (event.side, event.phrase, event.count)
        )

    def _newly_counted(self, way: ClauseEvent) -> ClauseEvent:
        """`At the third junction`, the second being that of the turn before: the next."""
        if way.ordinal is None or way.side or way.phrase.startswith("number"):
            return way
        self._counting.add(way.ordinal)
        goes_on = way.ordinal - 1 in self._counted
        return replace(way, nearest=True) if goes_on else way

    def _with_named_way(self, event: ClauseEvent) -> ClauseEvent:
        """Join a turn with the opening named before it, if they agree."""
        named = self._way
        if named is None:
            return event
        way = event.way or flank(named.side) or self._draft.passed_side
        if named.side is not None and named.side != way:
            self._settle_way()
            return event
        self._way = None
        if event.ordinal is not None:
            return replace(event, way=way)
        return replace(event, way=way, ordinal=named.ordinal, nearest=named.nearest)

    def _counts_on(self, way: ClauseEvent) -> bool:
        """`The first left no, the second yes`: a number after those that were passed."""
        side = self._draft.passed_side
        passed = [p.count or 1 for p in self._draft.passings if p.side in {side, None}]
        return side is not None and way.likely and way.ordinal == sum(passed) + 1

    def _change_last_turn(self, **changes: object) -> None:
        last = self._done[-1]
        if last.turn is not None:
            last.turn = replace(last.turn, **changes)  # type: ignore[arg-type]

    def _end_at_an_opening(self) -> None:
        """`To the second crossing`, said last: one walks that far and no farther."""
        way = self._way
        if way is None or way.taken or way.side is not None or self._draft.lengths:
            return
        if way.nearest and not way.phrase and self._draft.mentions:
            return  # "room 5, and room 6, the next"
        if way.ordinal is not None and way.ordinal > 0:
            self._way = None
            metres = way.ordinal * PLACE_METRES
            length = Length(metres, "places", float(way.ordinal))
            self._draft.lengths.append(length)

    def _end_beside_a_way(self) -> None:
        """`There is the library, to your left`, said last: no way goes off there."""
        way = self._way
        if way is None or way.ordinal is not None or way.phrase or way.taken:
            return
        self._way = None
        if self._draft.mentions and self._draft.mentions[-1].side is None:
            last = self._draft.mentions[-1]
            self._draft.mentions[-1] = replace(last, side=way.side)
        else:
            self._draft.side = way.side

    # -- openings that are named before it is said what to do with them

    def _turn_into(self, way: ClauseEvent, at: int) -> None:
        self._way = None
        self._add_turn(replace(way, kind="turn", way=flank(way.side)), at)

    def _go_through_a_door(self, at: int) -> None:
        """`The glass door is on your right, go out.`: one turns to it."""
        named = self._draft.mentions[-1] if self._draft.mentions else None
        if named is None or kind_of(named.phrase) != "door" or self._since_thing > 1:
            return
        if named.side == "left" or named.side == "right":
            self._draft.mentions.pop()
            self._since_thing = 9
            self._add_turn(ClauseEvent("turn", way=named.side), at)
            told = replace(named, side=None, place="target")
            self._done[-1].mentions.append(told)

    def _go_straight(self, event: ClauseEvent, at: int) -> None:
        way = self._way
        if (
            way
            and flank(way.side)
            and event.phrase
            and way.phrase.endswith(event.phrase)
        ):
            self._turn_into(way, at)  # "walk down this hallway"
            return
        if way is not None and not way.likely:
            self._leave(way)
        self._draft.straight = True

    def _leave(self, way: ClauseEvent) -> None:
        self._way = None
        if way.ordinal is not None and way.side is not None:
            self._left[way.ordinal] = way.side
        self._draft.passings.append(
            Passing(way.count or 1, flank(way.side), way.phrase or None)
        )

    def _settle_way(self) -> None:
        way, self._way = self._way, None
        if way is None:
            return
        if way.taken or (way.likely and (flank(way.side) or self._counts_on(way))):
            self._turn_into(way, 0)
        elif flank(way.side):
            self._leave(way)

    def _settle_likely_way(self) -> None:
        """What is said next is about the way behind an opening surely taken."""
        way = self._way
        if way is None or not way.likely or not self._way_age:
            return
        if way.side is not None or not self._counts_on(way):
            self._settle_way()

    # -- what is on a leg and at its end

    def _add_length(self, event: ClauseEvent, at: int) -> None:
        self._settle_likely_way()
        if event.length is None:
            return
        length, back = event.length, event.back
        thing = counted_from(self._events, at)
        if thing is not None:
            length = replace(length, after=thing.phrase)
            back = back or thing.back
        draft = self._done[-1] if back and self._done else self._draft
        draft.lengths.append(length)
        if draft is self._draft and self._last is not draft.mentions:
            self._last = []

    def _add_thing(self, event: ClauseEvent, at: int) -> None:
        if event.relation == "from":
            if not self._done and self._draft.is_new and not self._draft.origin:
                self._draft.origin = event.phrase
            return
        if event.relation == "away":
            self._draft.behind.append(event.phrase)
            return
        if event.relation == "between" and not event.back:
            self._draft.between.append(event.phrase)
            return
        back = bool(self._done) and (event.back or self._ends_the_turn(event, at))
        draft = self._done[-1] if back else self._draft
        if back and event.relation == "into":
            self._draft.entered = True
        if back and event.relation == "after":
            self._count_from(event.phrase)
        if event.subject and not back:
            self._settle_likely_way()
            draft = self._draft
        if event.subject:
            draft.subjects.add(len(draft.mentions))
        if event.called:
            draft.called.add(len(draft.mentions))
        is_passed = any(each.after == event.phrase for each in draft.lengths)
        draft.mentions.append(
            Mention(
                event.phrase,
                kind_of(event.phrase),
                "passed" if is_passed else place_on_leg(event, back),
                side=self._side,
                nth=event.ordinal,
                ignored=event.ignored,
            )
        )
        self._side = None
        self._since_thing = 9 if back else 0
        self._stands_there = event.relation == "see"
        self._last = draft.mentions

    def _count_from(self, phrase: str) -> None:
        """`The first left after the clock`: the clock is where counting starts."""
        turn = self._done[-1].turn
        if turn is not None and turn.ordinal is not None:
            self._change_last_turn(counted_after=phrase)

    def _add_ahead(self, event: ClauseEvent, at: int) -> None:
        """Add what lies along a way; the way may be a new one."""
        self._settle_likely_way()
        if event.phrase in self._draft.ahead and not self._draft.has_ended:
            return  # "Turn onto the blue path. Take the blue path to the chair."
        if event.turns or (self._draft.has_ended and is_floor(event.phrase)):
            self._face_anew(at, always=True)
        self._draft.ahead.append(event.phrase)
        self._draft.straight = self._draft.straight or event.walks
        self._last = []

    def _face_anew(self, at: int, *, always: bool) -> None:
        """Turn to what is said next, unless one has just turned or still stands."""
        draft = self._draft
        if not draft.is_new or (always and draft.walls and draft.ahead):
            self._add_turn(ClauseEvent("turn", way="either"), at)

    def _add_side(self, event: ClauseEvent, at: int) -> None:
        if event.of_goal:
            self._set_off(self._setting_off.take_side(at))
            self._draft.side = event.side
            self._setting_off.note_side(event, at)
        elif event.likely:
            self._side = event.side
        elif self._way is not None and self._way.side is None and not self._last:
            self._way = replace(self._way, side=event.side)
        elif self._last and self._last[-1].side is None:
            self._last[-1] = replace(self._last[-1], side=event.side)
            self._setting_off.note_side(event, at)
        else:
            self._set_off(self._setting_off.take_side(at))
            self._draft.side = self._draft.side or event.side

    def _set_off(self, turn: Turn | None) -> None:
        """Leave by the side told first, when another is told of the destination."""
        if turn is None or self._done:
            return
        self._way = self._draft.side = None
        self._draft.mentions[:] = [
            replace(each, side=None) if each.side == turn.way else each
            for each in self._draft.mentions
        ]
        self._done.append(PartialLeg(turn=turn, here=True))

    def _add_place(self, event: ClauseEvent, at: int) -> None:
        """Add an end of the way or a kind of junction."""
        if event.kind == "end":
            self._set_off(self._setting_off.side_before_an_end(at))
            self._settle_likely_way()
        placed = event.kind == "junction" or event.relation == "at"
        back = event.back or (
            placed and self._ends_the_turn(replace(event, relation="at"), at)
        )
        if not (back and self._done):
            self._draft.at_end = self._draft.at_end or event.kind == "end"
            self._draft.told_at_end = event.of_goal and bool(self._draft.subjects)
            self._draft.junction = event.junction or self._draft.junction
            self._draft.placed = self._draft.placed or placed
            return
        self._done[-1].placed = True
        if event.kind == "end":
            self._change_last_turn(at_end=True)
        elif event.junction is not None:
            self._change_last_turn(junction=event.junction)
            if event.junction == "t":
                self._change_last_turn(at_end=True)

    def _ends_the_turn(self, event: ClauseEvent, at: int) -> bool:
        """`Turn right, opposite the hall.`: a place said last is that of the turn."""
        if event.relation not in AT_THE_TURN or event.walks or event.of_goal:
            return False
        follows = self._done and self._draft.is_new
        return bool(follows) and ends_the_sentence_of_a_turn(self._events, at)
