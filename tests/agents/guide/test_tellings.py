"""Several tellings of one way, joined."""

import math

import pytest

from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.starts import starts_ahead
from memorymaze.agents.guide.tellings import Tellings
from memorymaze.agents.walking.floor_map import Crossing, FloorMap
from memorymaze.understanding import parse_route_description


def test_a_telling_that_explains_nothing_leaves_the_others_as_they_are() -> None:
    floor, model = FloorMap(), Likelihoods()
    floor.crossings[0] = Crossing(0, (0.0, 0.0), [0.0, math.pi / 2, -math.pi / 2])
    plan = parse_route_description("Turn left, then right at the clock.")

    def shares(*, with_nothing: bool) -> dict[tuple[int, int], float]:
        tellings = Tellings(floor, model)
        tellings.add(plan).starts = starts_ahead(model, floor, 0)
        if with_nothing:
            silent = tellings.add(plan)
            starts = starts_ahead(model, floor, 0)
            silent.starts = [each._replace(chance=0.0) for each in starts]
        tellings.update()
        return {key: f.mass / tellings.total for key, f in tellings.frontiers.items()}

    assert shares(with_nothing=True) == pytest.approx(shares(with_nothing=False))
