"""Several tellings of one way, joined."""

import math

import pytest

from memorymaze.agents.guide.alignments import mass_of
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.starts import starts_ahead
from memorymaze.agents.guide.tellings import Tellings
from memorymaze.agents.walking.floor_map import Crossing, FloorMap
from memorymaze.language.plans import Leg, RoutePlan, Turn, Way
from memorymaze.language.reading import parse_route_description


def plan_to(way: Way) -> RoutePlan:
    return RoutePlan(legs=(Leg(Turn(way), on_the_spot=True),))


def shares_of(*said: tuple[Way, int]) -> dict[tuple[int, int], float]:
    """Return how likely each way out of the start is.

    By turns that are told, and which telling each is a reading of.
    """
    tellings = told_at_a_crossing(*said)
    return {key: f.mass / tellings.total for key, f in tellings.frontiers.items()}


def told_at_a_crossing(*said: tuple[Way, int]) -> Tellings:
    floor, model = FloorMap(), Likelihoods()
    exits = [0.0, math.pi / 2, math.pi, -math.pi / 2]
    floor.crossings[1] = Crossing(1, (0.0, 0.0), exits)
    tellings = Tellings(floor, model)
    for way, told in said:
        telling = tellings.add(plan_to(way), told=told)
        telling.starts = starts_ahead(model, floor, 1)
    tellings.update()
    return tellings


def test_readings_of_one_telling_share_what_is_likely_and_do_not_bear_out() -> None:
    left, right = shares_of(("left", 0)), shares_of(("right", 0))
    assert left != pytest.approx(right)
    between = {key: (left[key] + right[key]) / 2 for key in left}
    assert shares_of(("left", 0), ("right", 0)) == pytest.approx(between)
    assert shares_of(("left", 0), ("left", 0)) == pytest.approx(left)


def test_what_is_seen_on_a_way_weighs_as_much_if_the_text_is_read_twice() -> None:
    def before_anything_is_seen(tellings: Tellings) -> dict[tuple[int, int], float]:
        return {
            key: sum(mass_of(each.segment.weights) for each in way.alignments)
            / tellings.total
            for key, way in tellings.frontiers.items()
        }

    once, twice = (
        told_at_a_crossing(("left", 0)),
        told_at_a_crossing(*[("left", 0)] * 2),
    )
    assert before_anything_is_seen(twice) == pytest.approx(
        before_anything_is_seen(once)
    )


def test_two_tellings_bear_each_other_out_less_where_one_is_read_in_two_ways() -> None:
    once, twice = shares_of(("left", 0)), shares_of(("left", 0), ("left", 1))
    way = max(once, key=once.__getitem__)
    half = shares_of(("left", 0), ("left", 1), ("right", 1))
    assert once[way] <= half[way] < twice[way]


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
