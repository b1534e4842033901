"""Several tellings of one way on one map, and what they make of each other's ways."""

import pytest

from memorymaze.agents.rules.alignment import UNSAID_TURN
from memorymaze.agents.rules.arriving import RulesEnding
from memorymaze.agents.rules.evidence import Standing
from memorymaze.agents.rules.tellings import RulesTellings
from memorymaze.agents.walking.floor_map import Crossing, FloorMap
from memorymaze.understanding import parse_route_description

AHEAD, ASIDE = 0, 1
START = Standing(0, 0.0, 0, line=((0.0, 0.0),), exit=AHEAD)


def told(*texts: str) -> RulesTellings:
    floor = FloorMap()
    floor.crossings[0] = Crossing(0, (0.0, 0.0), [0.0, 1.6])
    return RulesTellings([parse_route_description(text) for text in texts], floor)


def branch(telling: int, exit: int, cost: float) -> Standing:
    return Standing(
        0, 0.0, 1, line=((0.0, 0.0),), exit=exit, cost=cost, telling=telling
    )


def ending(telling: int, metres: float, cost: float) -> RulesEnding:
    return RulesEnding(branch(telling, AHEAD, 0.0), AHEAD, metres, cost, "")


def test_one_telling_is_not_doubted() -> None:
    tellings = told("Turn left.")
    way = branch(0, AHEAD, 3.0)
    tellings.rate([way, branch(0, ASIDE, 1.0)], [])
    assert tellings.way_cost(way) == tellings.outlook(way)


def test_tellings_of_different_length_begin_alike() -> None:
    tellings = told("Turn left.", "Turn left, then right, then left.")
    first, second = tellings.beginnings(START)
    assert tellings.outlook(first) == pytest.approx(tellings.outlook(second))


def test_the_way_both_find_good_beats_the_best_way_of_one() -> None:
    tellings = told("Turn left.", "Turn left.")
    agreed, own = branch(0, AHEAD, 1.0), branch(0, ASIDE, 0.0)
    others = [branch(1, AHEAD, 1.0), branch(1, ASIDE, 9.0)]
    tellings.rate([agreed, own, *others], [])
    assert tellings.way_cost(agreed) < tellings.way_cost(own)


def test_a_telling_speaks_against_a_way_no_more_than_one_error_is_worth() -> None:
    tellings = told("Turn left.", "Turn left.")
    way = branch(0, AHEAD, 0.0)
    tellings.rate([way, branch(1, AHEAD, 30.0), branch(1, ASIDE, 0.0)], [])
    assert tellings.way_cost(way) == pytest.approx(UNSAID_TURN)


def test_endings_near_each_other_are_one_place() -> None:
    tellings = told("Turn left.", "Turn left.")
    near, far = ending(0, 10.0, 1.0), ending(0, 20.0, 1.0)
    tellings.rate([], [near, far, ending(1, 12.0, 1.0)])
    assert tellings.ending_cost(near) == pytest.approx(0.0)
    assert tellings.ending_cost(far) == pytest.approx(UNSAID_TURN)


def test_who_has_legs_to_come_speaks_against_ending_on_the_way() -> None:
    tellings = told("Turn left.", "Turn left, then right.")
    done, more = branch(0, AHEAD, 0.0), branch(1, AHEAD, 0.0)
    finished = Standing(0, 0.0, 2, exit=AHEAD, telling=1)
    for other, agrees in ((more, False), (finished, True)):
        tellings.rate([done, other], [])
        cost = tellings.arrival_cost(done, 0.0, [done, other])
        assert (cost == pytest.approx(0.0)) is agrees
