"""How well what the robot met fits what was said: costs in nats, 0 for what is usual.

A cost is the negative logarithm of how likely a right-minded speaker, whose memory of
lengths is off by a third or more and whose landmarks may be made up, says so at such a
place. Negative costs are evidence for a place.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from memorymaze.agents.walking.choices import BACK, FORWARD, SLIGHT, Choices
from memorymaze.agents.walking.floor_map import (
    AT_CROSSING,
    SEES_FAR,
    FloorMap,
    Point,
    distance_to_line,
)
from memorymaze.agents.walking.outlooks import crossing_floor_cost
from memorymaze.routes import Length, Mention, Passing, Turn
from memorymaze.understanding import is_common, is_floor

SPREAD = {"metres": 0.4, "steps": 0.45, "time": 0.6, "vague": 0.9, "places": 0.5}
"""Standard deviation of the logarithm of a length from memory, by what was counted."""
GREATEST = {"metres": 3.5, "steps": 3.2, "time": 2.4, "vague": 1.6, "places": 4.0}
"""A length that is wrong altogether costs this."""

MISCOUNTED = 1.6
"""For each place where one can turn that was counted too many or too few."""
ELSEWHERE = 2.5
"""What was said to be at a turn was seen, but at another place."""
AT_THE_TURN = frozenset({"turn", "beside", "opposite", "before_turn", "after_turn"})
PLACE_METRES = 8.0
"""From one place where one can turn to the next, where only metres are told."""
BESIDE = 5.0
"""Metres from the line of a leg within which a thing is on it."""


@dataclass(frozen=True, slots=True)
class Standing:
    """A hypothesis: the robot is at a crossing, with some legs of the plan done."""

    at: int
    heading: float
    leg: int
    """Legs done; as many as the plan has when only the arrival is left."""
    walked: float = 0.0
    """Metres since the last turn of the plan."""
    left: int = 0
    """Openings passed on the left since then."""
    right: int = 0
    crossings: int = 0
    """Junctions passed since then."""
    line: tuple[Point, ...] = ()
    """Corners of the walk since then."""
    asked: frozenset[str] | None = None
    """What was looked for all along since then; None before the first stretch."""
    lead: float = 0.0
    """Metres of legs that were left out and add to the present one."""
    cost: float = 0.0
    story: tuple[str, ...] = ()
    """The decisions so far, in words."""
    exit: int = -1
    """By which it leaves the crossing; -1 while that is open."""
    telling: int = 0
    """Which of the tellings it follows."""

    @property
    def places(self) -> int:
        """Places where one can turn that were come to since the last turn."""
        return len(self.line) - 1

    def passed(self, way: str) -> int:
        """Return how many openings were passed on the side of a way; or junctions."""
        if way.endswith("left"):
            return self.left
        return self.right if way.endswith("right") else self.crossings


def length_cost(
    length: Length | None, walked: float, places: int = 0, junctions: int = 0
) -> float:
    """Compare a stated length with the metres walked.

    `places` are those where one can turn that were come to, the present one included;
    `junctions` are those of them where one has to choose.
    """
    if length is None:
        return 0.0
    if length.unit == "places":
        count = length.count or length.metres / PLACE_METRES
        off = min(abs(places - count), abs(junctions - count) + 0.3)
        return min(MISCOUNTED * off, GREATEST[length.unit])
    ratio = math.log(max(walked, 1.0) / max(length.metres, 1.0))
    slack = 2.0 / max(length.metres, 2.0)
    off = max(abs(ratio) - slack, 0.0) / SPREAD[length.unit]
    return min(0.5 * off * off, GREATEST[length.unit])


def way_cost(turn: Turn, angle: float, *, faces: bool = False) -> float:
    """Compare the direction of a turn with the angle of a way out, left positive.

    `faces` says whether of the turn only what lies that way was said.
    """
    if faces:
        return 0.2 if abs(angle) <= BACK else 1.0
    if turn.way == "around":
        return 0.0 if abs(angle) > BACK else 4.0
    if turn.way == "either":
        return 0.3 if abs(angle) > FORWARD else 1.5
    right = turn.way.endswith("right")
    if right:
        angle = -angle
    if angle < math.radians(-20):
        return 4.0
    if turn.way.startswith("slight"):
        return 0.0 if FORWARD < angle <= SLIGHT else 0.6 if angle <= FORWARD else 1.2
    if angle <= FORWARD:
        return 3.5
    if angle <= SLIGHT:
        return 0.5 if turn.forced else 1.0
    return 0.0 if angle <= math.radians(125) else 0.5


def junction_cost(turn: Turn, choices: Choices) -> float:
    """Compare the kind of junction with what was said of it."""
    goes_on = choices.forward is not None
    cost = 0.0
    if turn.at_end:
        cost += 1.6 if goes_on else 0.0
    if turn.junction == "t":
        if goes_on:
            cost += 0.6 if turn.at_end else 1.6
        elif len(choices.ways) < 2:
            cost += 0.4
    elif turn.junction == "crossing":
        if len(choices.ways) < 2:
            cost += 1.0
        elif not goes_on:
            cost += 0.5
    elif turn.junction == "corner" and goes_on and len(choices.ways) > 1:
        cost += 0.6
    if turn.forced and len(choices.ways) > 1:
        cost += 1.0 if goes_on else 0.5
    return cost


def ordinal_cost(turn: Turn, on_side: int, of_all: int, choices: Choices) -> float:
    """Compare `the second left` with the openings met, this one included."""
    if turn.ordinal == -1:
        return 1.2 if choices.forward is not None else 0.0
    if turn.ordinal is not None:
        off = min(abs(on_side - turn.ordinal), abs(of_all - turn.ordinal) + 0.3)
        return min(1.4 * off, 3.0)
    return 0.0


def passings_cost(passings: Sequence[Passing], standing: Standing) -> float:
    """Compare the openings that were to be left alone with those left alone."""
    cost = 0.0
    told: dict[str | None, int] = {}
    for passing in passings:
        if passing.count is not None:
            told[passing.side] = told.get(passing.side, 0) + passing.count
    for side, count in told.items():
        missing = count - standing.passed(side or "")
        cost += 0.7 * missing if missing > 0 else -0.25 * missing
    return min(cost, 2.4)


def mentions_cost(
    mentions: Sequence[Mention],
    floor: FloorMap,
    standing: Standing,
    place: Point,
    at: int | None = None,
) -> float:
    """Compare the things named on a leg with those seen along the line of its corners.

    The turn would be at `place`, and at the crossing `at` if it is at one.
    """
    total = 0.0
    for mention in mentions:
        if is_floor(mention.phrase):
            total += crossing_floor_cost(mention, floor, at)
        else:
            total += _mention_cost(mention, floor, standing, place)
    return max(min(total, 3.0 if at is not None else 1.5), -4.0)


def _mention_cost(
    mention: Mention, floor: FloorMap, standing: Standing, place: Point
) -> float:
    weight = (
        0.4 if mention.place == "target" else 0.5 if is_common(mention.phrase) else 1.0
    )
    at_turn = mention.place in AT_THE_TURN
    best = 0.0
    for sighting in floor.seen(mention.phrase):
        beside = distance_to_line(sighting.place, standing.line)
        if at_turn:
            is_there = floor.is_at(sighting.place, place)
            sees_far = floor.farthest > SEES_FAR
            near_by = beside <= BESIDE and not sees_far
            gain = 1.5 if is_there else 0.4 if near_by else 0.0
        else:
            reach = BESIDE if floor.farthest <= SEES_FAR else AT_CROSSING
            gain = 0.9 if beside <= reach else 0.0
        if gain and mention.side in {"left", "right"} and sighting.side != "ahead":
            gain *= 1.1 if sighting.side == mention.side else 0.4
        best = max(best, gain * min(sighting.score + 0.2, 1.0))
    if best:
        return -best * weight
    if at_turn and floor.seen(mention.phrase):
        return weight * ELSEWHERE
    if mention.phrase in (standing.asked or ()):
        ordered = at_turn or mention.place == "passed"
        return weight * (0.6 if ordered else 0.25)
    return 0.0


def too_far_cost(
    too_far: Sequence[str], floor: FloorMap, standing: Standing, place: Point
) -> float:
    """Charge for things that are met only after missing the turn."""
    cost = 0.0
    for phrase in too_far:
        if is_common(phrase):
            continue
        for sighting in floor.seen(phrase):
            passed = distance_to_line(sighting.place, standing.line) <= BESIDE
            if passed and not floor.is_at(sighting.place, place):
                cost = 2.0
    return cost
