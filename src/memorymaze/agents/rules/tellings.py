"""Tellings of one way on one map: what each makes of the ways and places there are.

A hypothesis belongs to one telling. What the others think of the same way, or of the same
place, counts too: so two mediocre readings that agree beat a good one alone.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from memorymaze.agents.rules.alignment import STILL_AHEAD, UNSAID_TURN, Aligner
from memorymaze.agents.rules.arriving import LEG_TO_COME, RulesArrivals, RulesEnding
from memorymaze.agents.rules.evidence import Standing
from memorymaze.agents.walking.floor_map import FloorMap, Point
from memorymaze.routes import RoutePlan

SAME_PLACE = 3.0
"""Metres within which endings by two tellings are one place."""


@dataclass(slots=True)
class _Telling:
    """A telling of the way, as it is compared with the map."""

    plan: RoutePlan
    aligner: Aligner
    arrivals: RulesArrivals
    ways: dict[tuple[int, int], float] = field(default_factory=dict)
    """Its cost of each way that is open, by crossing and exit; where there are others."""
    endings: list[tuple[float, Point]] = field(default_factory=list)
    """Its costs of places to end at; where there are others."""
    best: float = 0.0
    """The least of these costs."""

    def doubt(self, cost: float) -> float:
        """Return how much it speaks against what costs so much by it.

        No more than one turn that was left out: a telling may be wrong.
        """
        return min(cost - self.best, UNSAID_TURN)


class RulesTellings:
    """The tellings of a way; one that is alone is never doubted."""

    def __init__(self, plans: Sequence[RoutePlan], floor: FloorMap) -> None:
        """Take the plan of each and the map that the walk draws."""
        self._floor = floor
        self.all = [
            _Telling(plan, Aligner(plan, floor), RulesArrivals(plan, floor))
            for plan in plans
        ]

    def of(self, standing: Standing) -> _Telling:
        """Return the telling of a hypothesis."""
        return self.all[standing.telling]

    def outlook(self, branch: Standing) -> float:
        """Return the cost so far and the least that must come, by its own telling."""
        return self.of(branch).aligner.outlook(branch)

    def beginnings(self, standing: Standing) -> Iterator[Standing]:
        """Yield the beginning by each telling, all with the same outlook.

        What one has more legs it costs more when all is right, which says nothing of it.
        """
        legs = [len(each.plan.legs) for each in self.all]
        for number, count in enumerate(legs):
            cost = STILL_AHEAD * (legs[0] - count)
            yield replace(standing, telling=number, cost=cost)

    def rate(
        self, frontier: Sequence[Standing], endings: Sequence[RulesEnding]
    ) -> None:
        """Take note of what each thinks of the ways and places there are now."""
        if len(self.all) == 1:
            return
        for each in self.all:
            each.ways, each.endings = {}, []
        for branch in frontier:
            ways, way = self.of(branch).ways, (branch.at, branch.exit)
            ways[way] = min(self.outlook(branch), ways.get(way, math.inf))
        for ending in endings:
            told = self.of(ending.standing)
            told.endings.append((ending.cost, self._place_of(ending)))
        for each in self.all:
            costs = [*each.ways.values(), *(cost for cost, _ in each.endings)]
            each.best = min(costs, default=0.0)

    def way_cost(self, branch: Standing) -> float:
        """Return what a way costs by all tellings, beside the best by each."""
        way = branch.at, branch.exit
        cost = self.outlook(branch) - self.of(branch).best
        return cost + sum(
            each.doubt(each.ways.get(way, math.inf)) for each in self._others(branch)
        )

    def ending_cost(self, ending: RulesEnding) -> float:
        """Return what ending at a place costs by all tellings, beside the best by each."""
        cost = ending.cost - self.of(ending.standing).best
        place = self._place_of(ending)
        return cost + sum(
            each.doubt(_cheapest_near(place, each.endings))
            for each in self._others(ending.standing)
        )

    def arrival_cost(
        self, branch: Standing, cost: float, frontier: Iterable[Standing]
    ) -> float:
        """Return what it costs by all to end on a way that costs so much by its telling."""
        doubts = {id(each): each.doubt(math.inf) for each in self._others(branch)}
        for other in frontier:
            told = self.of(other)
            same_way = (other.at, other.exit) == (branch.at, branch.exit)
            if same_way and id(told) in doubts:
                to_come = LEG_TO_COME * (len(told.plan.legs) - other.leg)
                doubt = told.doubt(self.outlook(other) + to_come)
                doubts[id(told)] = min(doubt, doubts[id(told)])
        return cost - self.of(branch).best + sum(doubts.values())

    def _others(self, standing: Standing) -> list[_Telling]:
        return [each for each in self.all if each is not self.of(standing)]

    def _place_of(self, ending: RulesEnding) -> Point:
        crossing = self._floor.crossings[ending.standing.at]
        x, y = crossing.place
        if ending.exit is None:
            return x, y
        heading = crossing.exits[ending.exit]
        return (
            x + ending.distance * math.cos(heading),
            y + ending.distance * math.sin(heading),
        )


def _cheapest_near(place: Point, endings: Iterable[tuple[float, Point]]) -> float:
    near = (cost for cost, other in endings if math.dist(place, other) <= SAME_PLACE)
    return min(near, default=math.inf)
