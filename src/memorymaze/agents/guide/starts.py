"""Where a telling may begin."""

import math

from memorymaze.agents.guide.alignments import AssumedStart
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.walking.floor_map import FloorMap
from memorymaze.agents.walking.outlooks import (
    first_heading_cost,
    headings_to_begin,
)
from memorymaze.language.plans import RoutePlan


def starts_ahead(model: Likelihoods, floor: FloorMap, at: int) -> list[AssumedStart]:
    """Return the ways to begin where the robot faces the way told, or the opposite one."""
    wrong = model.wrong_start
    if at == 0:
        back = floor.crossings[at].add_exit(math.pi)
        return [
            AssumedStart(0, 0.0, 0, 1 - wrong),
            AssumedStart(0, math.pi, back, wrong),
        ]
    return [AssumedStart(at, 0.0, -1, 1 - wrong), AssumedStart(at, math.pi, -1, wrong)]


def starts_any_way(plan: RoutePlan, floor: FloorMap, at: int) -> list[AssumedStart]:
    """Return the ways to begin where the robot may have to face any way."""
    headings = headings_to_begin(floor.crossings[at].exits)
    costs = [first_heading_cost(plan, floor, at, heading) for heading in headings]
    chances = [math.exp(-cost) for cost in costs]
    return [
        AssumedStart(at, heading, -1, chance / sum(chances))
        for heading, chance in zip(headings, chances, strict=True)
    ]
