"""Things and floors said to be on the way, against those seen where they should be."""

import math
from dataclasses import replace
from itertools import pairwise

from memorymaze.agents.guide.likelihoods import (
    NOTHING,
    Heard,
    Likelihoods,
    Weights,
    not_seen,
    seen_as_said,
    then,
)
from memorymaze.agents.walking.floor_map import (
    SURE,
    SURELY_AT,
    FloorMap,
    Point,
    Sighting,
    along_and_aside,
    distance_to_line,
    side_of_line,
)
from memorymaze.agents.walking.outlooks import (
    crossing_has_floor,
    outlook_cost,
    outlook_of,
    things_on,
    walls_cost,
)
from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.language.plans import Mention, RoutePlan, Side
from memorymaze.language.reading import ANY_FLOOR, is_common, is_floor

AT_THE_TURN = frozenset({"turn", "beside", "opposite", "before_turn", "after_turn"})
UNSEEN = frozenset({"sound", "smell", "person", "wall"})
"""Kinds of things that need not be in the picture where they were told."""
BESIDE = 4.5
"""Metres from the line of a stretch within which a thing is on it."""
LEAST_REACH = 10.0
"""Metres of way that one sees along at least."""
NOT_BEYOND = 1.5
"""Metres beyond the end of a way at which a thing still counts as passed."""
ON_THE_WAY = 0.5
"""Share of its weight that something unseen has which is told beside the way."""
NO_WAY = 0.25
"""Weight of a place that has no such floor on the side where it was told."""
ON_FLOOR = 1.0
"""Metres from the line of a stretch within which a piece of floor is walked on."""
MOST_OF_A_FLOOR = 0.95
"""Share of a building's floor that one covering has at most."""
FLOORS_THERE_ARE = 3
"""Coverings that a building has, before any was seen."""
ONE_PLACE = 4.0
"""Metres within which what bears a name is one place."""
_SIDES = {"left": math.pi / 2, "right": -math.pi / 2, "ahead": 0.0}
_ByLine = dict[tuple[Point, ...], list[Sighting]]
BEFORE_ANY = 60.0
"""Metres of way that the usual rates of things are worth, beside those counted."""


class Things:
    """Weighs the things of a plan against the map."""

    def __init__(self, plan: RoutePlan, floor: FloorMap, model: Likelihoods) -> None:
        """Take the plan, the map that the walk draws, and how speakers are."""
        self._plan = plan
        self._floor = floor
        self._model = model
        self._mentions = [_things_of(plan, n) for n in range(len(plan.legs) + 1)]
        self._outlooks = [outlook_of(plan, n) for n in range(len(plan.legs) + 1)]
        self._met: dict[str, tuple[list[Sighting], _ByLine]] = {}
        """What was seen for a phrase, and which of it along which line."""
        self.forget()

    def forget(self) -> None:
        """Begin to weigh anew, after something was seen."""
        self._heard: dict[tuple[int, tuple[Point, ...]], Heard | None] = {}
        for phrase, (seen, _) in list(self._met.items()):
            if seen != self._floor.seen(phrase):
                del self._met[phrase]

    def phrases(self, number: int) -> list[str]:
        """Return what to look for on a leg, or on the last stretch; first at its end."""
        things = sorted(
            self._mentions[number], key=lambda e: e.place not in AT_THE_TURN
        )
        return [each.phrase for each in things]

    def awaited(self, number: int, line: tuple[Point, ...], at: int) -> bool:
        """Tell whether a leg is told by a thing that was not come to at a crossing."""
        return any(
            each.place in {"turn", "before_turn", "passed"}
            and all(self._is_on(e, at) for e in self._met_along(each.phrase, line))
            for each in self._mentions[number]
        )

    def rate(self, phrase: str, beside: Sighting | None = None) -> float:
        """Return how often such a thing is met per metre in this building.

        Of what is at the place of a sighting none counts: a café has a door and signs.
        """
        usual = self._model.common_rate if is_common(phrase) else self._model.rare_rate
        seen = self._floor.seen(phrase)
        if beside is not None:
            seen = [e for e in seen if math.dist(e.place, beside.place) > ONE_PLACE]
        return (usual * BEFORE_ANY + len(seen)) / (BEFORE_ANY + self._floor.metres)

    def _detected(self, *, at_turn: bool = False) -> float:
        """How likely a thing that is there is seen.

        Of the walls of wide ways much is seen in passing that is not seen from abreast.
        """
        if at_turn and not self._floor.sees_far:
            return self._model.detected_at_turn
        return self._model.detected * math.sqrt(self._floor.seen_beside)

    def weigh(
        self,
        weights: Weights,
        number: int,
        line: tuple[Point, ...],
        asked: frozenset[str],
        place: Point,
        at: int | None = None,
    ) -> Weights:
        """Weigh what is said of a leg, or of the last stretch, that ends at a place.

        `at` is the number of the crossing there, if there is one.
        """
        model = self._model
        if at is None:
            at = self._floor.crossing_near(place)
        for mention in self._mentions[number]:
            if is_floor(mention.phrase):
                weights = weights * self._floor_ratio(mention, at, line, asked)
                continue
            at_turn = mention.place in AT_THE_TURN
            if at_turn:
                best = self._seen_at(mention, place, line, at)
            else:
                best = self._seen_along(mention, line)
            if best is not None:
                weights = weights * _weaker(best, mention).of_all
            elif mention.phrase in asked and mention.kind not in UNSEEN:
                unseen = not_seen(model, self._detected(at_turn=at_turn))
                if at_turn and not is_common(mention.phrase):
                    weights = then(weights, unseen.of_all, model.mistaken, model.again)
                else:
                    weights = weights * (unseen**ON_THE_WAY).of_all
        return weights

    def _floor_ratio(
        self,
        mention: Mention,
        at: int | None,
        line: tuple[Point, ...],
        asked: frozenset[str],
    ) -> float:
        """Weigh a floor that is told of a leg which ends at a place.

        At a turn any way out may have it, the way that led there too; else the leg has.
        """
        on_side = self._floor_on_side(mention, at, line)
        if on_side is not None:
            return on_side
        if mention.place in AT_THE_TURN:
            if at is None:
                return 1.0
            has_floor = crossing_has_floor(mention.phrase, self._floor, at)
            return self._floor_fits(mention.phrase, has_floor)
        walked_on = self._is_walked_on(mention.phrase, line)
        seen = walked_on or (len(line) > 1 and mention.phrase in asked)
        return self._floor_fits(mention.phrase, walked_on if seen else None)

    def _floor_fits(self, phrase: str, has_floor: bool | None) -> float:
        """Weigh that a way has a floor told of it, or has another; None is not known.

        By how much of the floor that was seen in this building is so.
        """
        seen = self._floor.seen(phrase)
        surely = sum(each.score >= SURE for each in seen)
        # What may be it or not tells nothing.
        if has_floor is None or (not has_floor and surely < len(seen)):
            return 1.0
        share = (surely + 1) / (len(self._floor.seen(ANY_FLOOR)) + FLOORS_THERE_ARE)
        share = min(share, MOST_OF_A_FLOOR)
        right = self._model.floor_right
        return right / share if has_floor else (1 - right) / (1 - share)

    def _is_walked_on(self, phrase: str, line: tuple[Point, ...]) -> bool:
        """Tell whether a piece of a floor lies on a line walked."""
        return len(line) > 1 and any(
            each.score >= SURE and distance_to_line(each.place, line) <= ON_FLOOR
            for each in self._met_along(phrase, line)
        )

    def _floor_on_side(
        self, mention: Mention, at: int | None, line: tuple[Point, ...]
    ) -> float | None:
        """Weigh a floor that is told on a side of who comes along a line; None if untold.

        As in `you see grey floor to your right`.
        """
        side = _SIDES.get(mention.side or "")
        if at is None or side is None or mention.place != "along" or len(line) < 2:
            return None
        crossing = self._floor.crossings[at]
        came = math.atan2(line[-1][1] - line[-2][1], line[-1][0] - line[-2][0])
        exit = crossing.find_exit(wrap_angle(came + side))
        if exit is None:
            return NO_WAY
        has_floor = self._way_has_floor(mention.phrase, at, exit)
        if has_floor is None:
            return None
        return max(self._floor_fits(mention.phrase, has_floor), NO_WAY)

    def _way_has_floor(self, phrase: str, at: int, exit: int) -> bool | None:
        """Tell whether a way out has a floor; None where one did not look or cannot tell."""
        view = self._floor.views.get((at, exit))
        if view is None or view.floor is None or phrase not in view.asked:
            return None
        return view.has_floor(phrase)

    def floors_ahead(self, number: int, at: int, exit: int) -> float:
        """Weigh the floors told of a stretch against that of a way that it ends on."""
        floors = (e for e in self._mentions[number] if is_floor(e.phrase))
        return math.prod(self._floor_ahead(each, at, exit) for each in floors)

    def _floor_ahead(
        self, mention: Mention, at: int, exit: int, *, begins: bool = False
    ) -> float:
        """Weigh a floor told of a stretch against that of the way on, or of its beginning.

        It may be farther on, unless it is what the turn before leads to.
        """
        has_floor = self._way_has_floor(mention.phrase, at, exit)
        fits = self._floor_fits(mention.phrase, has_floor)
        is_here = begins and mention.place == "target"
        return fits if has_floor or is_here else math.sqrt(fits)

    def so_far(self, number: int, line: tuple[Point, ...]) -> Weights:
        """Weigh the things of a leg that goes on which were met on it already."""
        ratio, floors = NOTHING, 1.0
        for mention in self._mentions[number]:
            if mention.place in AT_THE_TURN:
                continue
            if not is_floor(mention.phrase):
                ratio *= _weaker(self._seen_along(mention, line) or NOTHING, mention)
            elif self._is_walked_on(mention.phrase, line):
                floors *= self._floor_fits(mention.phrase, True)
        return ratio.of_all * floors

    def ahead(
        self, number: int, line: tuple[Point, ...], at: int, exit: int
    ) -> Weights:
        """Weigh the things of a leg that are in sight along a way not walked yet."""
        crossing = self._floor.crossings[at]
        ratio, floors = NOTHING, 1.0
        for mention in self._mentions[number]:
            if is_floor(mention.phrase):
                at_turn = mention.place in AT_THE_TURN
                if not (at_turn or self._is_walked_on(mention.phrase, line)):
                    begins = len(line) < 2
                    floors *= self._floor_ahead(mention, at, exit, begins=begins)
                continue
            ahead = self._floor.seen_ahead(mention.phrase, at, crossing.exits[exit])
            if not ahead:
                continue
            met = self._met_along(mention.phrase, line)
            if all(each in ahead for each in met):
                nearest = min(ahead, key=lambda e: math.dist(e.place, crossing.place))
                reach = max(math.dist(nearest.place, crossing.place), LEAST_REACH)
                rate = self.rate(mention.phrase)
                seen = seen_as_said(
                    self._model, rate, reach, self._detected() * nearest.score
                )
                ratio *= _weaker(seen, mention)
        return ratio.of_all * floors

    def _seen_at(
        self, mention: Mention, place: Point, line: tuple[Point, ...], at: int | None
    ) -> Heard | None:
        """Weigh that a thing was seen where a way ends; None where it was not.

        One that is seen some way down a way not walked yet tells nothing: there may be
        a place to turn beside it.
        """
        seen_anywhere = self._floor.seen(mention.phrase)
        if not seen_anywhere:
            return None
        rim = self._floor.rim_of(at)
        near = [
            (each, nearness)
            for each in seen_anywhere
            if (nearness := self._floor.nearness(each.place, place, rim)) > 0
        ]
        here = [each for each in near if at is None or not self._is_on(each[0], at)]
        if near and not here:
            return NOTHING
        rate, reach = self.rate(mention.phrase), 2 * (rim + SURELY_AT)
        detected = self._detected(at_turn=True)
        missed = not_seen(self._model, detected)
        seen = (
            seen_as_said(self._model, rate, reach, detected * each.score).or_else(
                missed, nearness
            )
            * self.side_ratio(mention.side, each, line)
            for each, nearness in here
        )
        return max(seen, default=None)

    def _is_on(self, sighting: Sighting, at: int) -> bool:
        """Tell whether a thing is on a way out of a crossing that was not walked yet."""
        return any(
            (at, exit) not in self._floor.stretches
            and sighting in self._floor.seen_ahead(sighting.phrase, at, heading)
            for exit, heading in self._floor.crossings[at].open_exits()
        )

    def _seen_along(self, mention: Mention, line: tuple[Point, ...]) -> Heard | None:
        """Weigh that a thing was seen along a way; None where it was not."""
        # Many alignments walk one line.
        key = id(mention), line
        if key not in self._heard:
            met = self._met_along(mention.phrase, line)
            if mention.place == "passed":
                met = [e for e in met if passed_after(e.place, line) is not None]
            reach = max(_length(line), 4.0)
            self._heard[key] = self._best(mention, met, reach, line)
        return self._heard[key]

    def _met_along(self, phrase: str, line: tuple[Point, ...]) -> list[Sighting]:
        if phrase not in self._met:
            self._met[phrase] = self._floor.seen(phrase), {}
        by_line = self._met[phrase][1]
        met = by_line.get(line)
        if met is None:
            met = by_line[line] = [
                each
                for each in self._floor.seen(phrase)
                if distance_to_line(each.place, line) <= BESIDE
            ]
        return met

    def passed_at(self, phrase: str, line: tuple[Point, ...]) -> float | None:
        """Return after how many metres of a line a thing is passed; None if it is not."""
        met = self._met_along(phrase, line)
        if not met:
            return None
        return passed_after(max(met, key=lambda each: each.score).place, line)

    def _best(
        self,
        mention: Mention,
        near: list[Sighting],
        reach: float,
        line: tuple[Point, ...],
    ) -> Heard | None:
        rate, detected = self.rate(mention.phrase), self._detected()
        seen = (
            seen_as_said(self._model, rate, reach, detected * each.score)
            * self.side_ratio(mention.side, each, line)
            for each in near
        )
        return max(seen, default=None)

    def side_ratio(
        self, told: Side | None, sighting: Sighting, line: tuple[Point, ...]
    ) -> float:
        """Weigh the side that is told of a thing against its side of a line walked."""
        if told not in {"left", "right"}:
            return 1.0
        side = side_of_line(sighting.place, line) if len(line) > 1 else sighting.side
        if side == "ahead":
            return 1.0
        right = self._model.side_right
        return 2 * (right if told == side else 1 - right)

    def outlook_ratio(self, at: int, exit: int, number: int) -> float:
        """Weigh what was said to lie along a way against what is seen along it."""
        outlook = self._outlooks[number]
        if not (outlook.ahead or outlook.behind or outlook.walls):
            return 1.0
        crossing = self._floor.crossings[at]
        cost = outlook_cost(outlook, self._floor, at, exit)
        cost += walls_cost(
            outlook, crossing.exits, crossing.closed, crossing.exits[exit]
        )
        return math.exp(-cost)


def _things_of(plan: RoutePlan, number: int) -> tuple[Mention, ...]:
    """Return the things on a leg; what openings are counted from is not at the turn."""
    things = things_on(plan, number)
    after = plan.legs[number].turn.counted_after if number < len(plan.legs) else None
    return tuple(
        replace(each, place="passed")
        if each.phrase == after and each.place == "before_turn"
        else each
        for each in things
    )


def passed_after(place: Point, line: tuple[Point, ...]) -> float | None:
    """Return after how many metres of a line a place is passed; None if it is not."""
    begun, passed, least = 0.0, 0.0, math.inf
    for start, end in pairwise(line):
        aside = distance_to_line(place, (start, end))
        if aside < least:
            heading = math.atan2(end[1] - start[1], end[0] - start[0])
            along, _ = along_and_aside(place, start, heading)
            passed, least = begun + max(along, 0.0), aside
        begun += math.dist(start, end)
    return passed if passed <= begun + NOT_BEYOND else None


def _weaker(ratio: Heard, mention: Mention) -> Heard:
    """What a turn leads to is mostly behind it, so it says less of the place."""
    return ratio**0.5 if mention.place == "target" else ratio


def _length(line: tuple[Point, ...]) -> float:
    return sum(math.dist(a, b) for a, b in pairwise(line))
