"""Which part of the plan belongs to which part of the walk.

A hypothesis says: the robot stands at this crossing, and so many legs of the plan are
done. At each crossing it branches into what the speaker may have meant there. The
costs of `evidence.py` add up along a branch, so that a later surprise speaks against
every decision before it.
"""

from collections.abc import Iterator
from dataclasses import replace

from memorymaze.agents.rules.evidence import (
    Standing,
    junction_cost,
    length_cost,
    mentions_cost,
    ordinal_cost,
    passings_cost,
    too_far_cost,
    way_cost,
)
from memorymaze.agents.walking.choices import Choices, choices_at
from memorymaze.agents.walking.floor_map import FloorMap, Stretch
from memorymaze.agents.walking.outlooks import (
    faces,
    length_of,
    outlook_cost,
    outlook_of,
    things_on,
    walls_cost,
)
from memorymaze.geometry.pose import wrap_angle
from memorymaze.routes import Leg, Length, RoutePlan

UNSAID_TURN = 4.0
"""Cost of a turn that the description leaves out where one could go on."""
UNSAID_CHOICE = 2.6
"""The same where one cannot go on and must choose."""
UNSAID_BEND = 0.15
"""The same where there is but one way and it is slanted."""
UNSAID_CORNER = 0.7
"""The same where there is but one way."""
LEFT_OUT = 3.2
"""Cost of a described turn that does not exist."""
BEND_LEFT_OUT = 0.5
"""The same where the way was said to bend by itself, or only slightly."""
STILL_AHEAD = 0.8
"""What a leg costs when all is right, about: expected for each leg not yet done."""
UNSEEN_YET = 0.6
"""Share of the cost of things not seen that counts while they may still come."""
GONE_TOO_FAR = 0.7
"""Share of the cost of a length that counts against going on beyond it."""
NOT_GONE = 2.0
"""Turning at once where it was said that one walks first."""
UNTOLD_WAY_ON = 0.05
"""Going straight on past an opening."""


class Aligner:
    """Branches hypotheses of one plan."""

    def __init__(self, plan: RoutePlan, floor: FloorMap) -> None:
        """Take the plan and the map that the walk draws."""
        self.plan = plan
        self._floor = floor

    def outlook(self, standing: Standing) -> float:
        """Return the cost so far and the least that must come."""
        left = len(self.plan.legs) - standing.leg
        ahead = STILL_AHEAD * left
        leg = self._leg(standing)
        arrival = self.plan.arrival
        counted_from = any(m.place == "passed" for m in arrival.mentions)
        told = None if leg is not None or counted_from else arrival.length
        if told is not None and _is_passed(told, standing):
            ahead += GONE_TOO_FAR * _walked_cost(told, standing, 0)
        if leg is not None:
            length = _with_lead(length_of(leg), standing.lead)
            if length is not None and _is_passed(length, standing):
                ahead += _walked_cost(length, standing, 0)
            if standing.walked > 6.0 and standing.asked:
                passed = [
                    m
                    for m in things_on(self.plan, standing.leg)
                    if m.place in {"along", "passed"}
                ]
                end = standing.line[-1]
                unseen = mentions_cost(passed, self._floor, standing, end)
                ahead += UNSEEN_YET * max(unseen, 0.0)
            turn = leg.turn
            if turn.ordinal is not None and turn.ordinal > 0:
                met = min(standing.passed(turn.way), standing.crossings) + 1
                ahead += min(1.4 * max(met - turn.ordinal, 0), 3.0)
        return standing.cost + ahead

    def advance(self, before: Standing, stretch: Stretch) -> Standing:
        """Return the hypothesis after a stretch was walked."""
        end = self._floor.crossings[stretch.end]
        asked = stretch.asked if before.asked is None else before.asked & stretch.asked
        return replace(
            before,
            at=stretch.end,
            heading=stretch.arrival,
            walked=before.walked + stretch.length,
            line=(*before.line, end.place),
            asked=asked,
            exit=-1,
        )

    def branches(self, standing: Standing) -> Iterator[Standing]:
        """Yield what may be meant at the crossing where a hypothesis stands."""
        choices = self.choices(standing)
        yield from self._ways_on(standing, choices)
        yield from self._turns(standing, choices)

    # -- going on without using up a leg

    def _ways_on(self, standing: Standing, choices: Choices) -> Iterator[Standing]:
        ahead = choices.forward
        junction = len(choices.ways) > 1
        passed = replace(
            standing,
            left=standing.left + bool(choices.on("left")),
            right=standing.right + bool(choices.on("right")),
            crossings=standing.crossings + junction,
        )
        leg = self._leg(standing)
        for index, angle in choices.ways:
            if ahead is not None and index == ahead[0]:
                cost = UNTOLD_WAY_ON * junction + UNSAID_BEND * (abs(angle) > 0.3)
                if leg is None:
                    cost += 0.3 * junction
                elif self._plain_turn_fits(standing.leg, choices):
                    cost += 0.9
                yield replace(passed, cost=standing.cost + cost, exit=index)
                continue
            if not junction:
                cost, word = UNSAID_CORNER, "follow the only way"
            elif ahead is None:
                cost, word = UNSAID_CHOICE, "choose a way nobody told of"
            else:
                cost, word = UNSAID_TURN, "turn though nobody said so"
            if leg is None:
                cost *= self._final_turn_factor(angle)
            yield replace(
                passed,
                cost=standing.cost + cost,
                story=(*standing.story, f"{word} at {standing.at} (+{cost:.1f})"),
                exit=index,
            )

    def _plain_turn_fits(self, number: int, choices: Choices) -> bool:
        """Tell whether a turn about which nothing else was said could be here."""
        leg = self.plan.legs[number]
        turn = leg.turn
        if turn.ordinal is not None or turn.at_end or turn.junction or turn.forced:
            return False
        if leg.length is not None and leg.length.unit != "vague":
            return False
        if leg.passings or any(
            m.place in {"turn", "before_turn", "passed"}
            and not self._floor.seen(m.phrase)
            for m in things_on(self.plan, number)
        ):
            return False
        return turn.way in {"left", "right"} and bool(choices.on(turn.way))

    def _final_turn_factor(self, angle: float) -> float:
        """`The glass door is on the right` may well mean to turn right at the end."""
        side = self.plan.arrival.side
        if (side == "left" and angle > 0) or (side == "right" and angle < 0):
            return 0.4
        return 0.8

    # -- using up legs

    def _turns(self, standing: Standing, choices: Choices) -> Iterator[Standing]:
        skipped = 0.0
        lead = standing.lead
        story = standing.story
        for number in range(standing.leg, min(standing.leg + 3, len(self.plan.legs))):
            leg = self.plan.legs[number]
            base = skipped + self._place_cost(standing, number, lead, choices)
            looks = faces(self.plan, number)
            anew = looks or leg.turn.way == "around"
            ways = self._all_ways(standing) if anew else choices.ways
            for index, angle in ways:
                way = way_cost(leg.turn, angle, faces=looks)
                if way >= 4.0 and len(choices.ways) > 1 and skipped:
                    continue
                cost = base + way + self._outlook_cost(standing, number + 1, index)
                told = f"leg {number + 1} {leg.turn.way} at {standing.at} (+{cost:.1f})"
                done = Standing(
                    standing.at,
                    wrap_angle(standing.heading + angle),
                    number + 1,
                    line=(self._floor.crossings[standing.at].place,),
                    cost=standing.cost + cost,
                    story=(*story, told),
                    telling=standing.telling,
                )
                yield replace(done, exit=index)
                if anew and self._turns_at_once(done):
                    yield from self._turns(done, self.choices(done))
            skip = self._skip_cost(number)
            skipped += skip
            length = length_of(leg)
            lead += length.metres if length else 0.0
            story = (*story, f"leave out leg {number + 1} (+{skip:.1f})")

    def choices(self, standing: Standing) -> Choices:
        """Return the ways out of the crossing where a hypothesis stands."""
        crossing = self._floor.crossings[standing.at]
        return choices_at(crossing.exits, crossing.closed, standing.heading)

    def _all_ways(self, standing: Standing) -> tuple[tuple[int, float], ...]:
        """Return all ways out, the way back too."""
        crossing = self._floor.crossings[standing.at]
        return tuple(
            (index, wrap_angle(heading - standing.heading))
            for index, heading in enumerate(crossing.exits)
            if index not in crossing.closed
        )

    def _turns_at_once(self, standing: Standing) -> bool:
        """Tell whether the next turn follows on the spot: `face it, turn left`."""
        leg = self._leg(standing)
        return leg is not None and leg.on_the_spot

    def _outlook_cost(self, standing: Standing, leg: int, exit: int) -> float:
        """Compare the way an exit leads with what was said of the way of a leg."""
        outlook = outlook_of(self.plan, leg)
        crossing = self._floor.crossings[standing.at]
        cost = outlook_cost(outlook, self._floor, standing.at, exit)
        return cost + walls_cost(
            outlook, crossing.exits, crossing.closed, crossing.exits[exit]
        )

    def _skip_cost(self, number: int) -> float:
        turn = self.plan.legs[number].turn
        easy = turn.way.startswith("slight") or faces(self.plan, number)
        if turn.forced or easy:
            return BEND_LEFT_OUT
        cost = LEFT_OUT - 1.2 * turn.doubt
        leg = self.plan.legs[number]
        if number > 0 and not (
            length_of(leg) or things_on(self.plan, number) or leg.passings
        ):
            before = self.plan.legs[number - 1].turn.way
            cost -= 1.0 if before == turn.way else 0.3
        return cost

    def _place_cost(
        self, standing: Standing, number: int, lead: float, choices: Choices
    ) -> float:
        """Compare a crossing with all that was said about the end of a leg."""
        leg = self.plan.legs[number]
        crossing = self._floor.crossings[standing.at]
        turn = leg.turn
        junction = len(choices.ways) > 1
        cost = _walked_cost(_with_lead(length_of(leg), lead), standing, junction)
        if not leg.on_the_spot and not standing.walked:
            cost += NOT_GONE
        cost += junction_cost(turn, choices)
        cost += ordinal_cost(
            turn,
            standing.passed(turn.way) + 1,
            standing.crossings + junction,
            choices,
        )
        cost += passings_cost(leg.passings, standing)
        things = things_on(self.plan, number)
        place = crossing.place
        cost += mentions_cost(things, self._floor, standing, place, standing.at)
        missed = (*leg.too_far, *leg.wrong_way)
        return cost + too_far_cost(missed, self._floor, standing, place)

    def _leg(self, standing: Standing) -> Leg | None:
        if standing.leg < len(self.plan.legs):
            return self.plan.legs[standing.leg]
        return None


def _walked_cost(length: Length | None, standing: Standing, junction: int) -> float:
    """Compare a length with the walk since the last turn, the present place included."""
    crossings = standing.crossings + junction
    return length_cost(length, standing.walked, standing.places, crossings)


def _is_passed(length: Length, standing: Standing) -> bool:
    if length.unit == "places" and length.count is not None:
        return standing.places > length.count
    return standing.walked > length.metres


def _with_lead(length: Length | None, lead: float) -> Length | None:
    """Add the length of legs that were left out."""
    if length is None or not lead:
        return length
    if length.unit == "places":
        return length
    return Length(length.metres + lead, length.unit)
