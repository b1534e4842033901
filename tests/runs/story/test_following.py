import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point

from memorymaze.basics.geometry import polyline
from memorymaze.runs.story.following import (
    Following,
    count_decisions,
    decisions_of,
    first_wrong,
    followed_along,
)
from memorymaze.world.sites import Route, Site

WAY = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]
"""East, then north round a corner."""


def walk(*corners: tuple[float, float]) -> np.ndarray:
    return polyline.resample(corners, 0.2)


@pytest.mark.parametrize(
    ("corners", "how", "along"),
    [
        pytest.param([(0, 0), (10, 0), (10, 10)], "end", 20, id="all the way"),
        pytest.param([(0, 0), (10, 0), (10, 8)], "end", 18, id="near enough"),
        pytest.param([(0, 0), (10, 0), (10, 4)], "stopped", 14, id="too early"),
        pytest.param([(0, 0), (16, 0)], "left", 10, id="straight on at the corner"),
        pytest.param([(0, 0), (10, 0), (10, -9)], "left", 10, id="the other way"),
        pytest.param([(0, 0), (8, 0), (0, 0)], "turned_back", 8, id="back"),
        pytest.param([(0, 0), (10, 0), (10, 19)], "passed", 20, id="past the goal"),
        pytest.param(
            [(0, 0), (10, 0), (10, 10), (16, 10), (10, 10)], "end", 20, id="and back"
        ),
        pytest.param([(0, 0), (0, 0)], "stopped", 0, id="never moved"),
    ],
)
def test_a_walk_is_followed_until_it_leaves_the_way(
    corners: list[tuple[float, float]], how: str, along: float
) -> None:
    found = followed_along(WAY, walk(*corners), tolerance=3.0)
    assert found.how == how
    assert found.along == pytest.approx(along, abs=0.6)


def test_the_place_of_leaving_lies_on_the_way() -> None:
    found = followed_along(WAY, walk((0, 0), (16, 0)), tolerance=3.0)
    assert found.place == pytest.approx((10, 0), abs=0.3)
    assert found.away is not None
    assert found.away == pytest.approx((13, 0), abs=0.6)


def test_coming_back_later_does_not_undo_leaving() -> None:
    there_and_back = walk((0, 0), (16, 0), (10, 0), (10, 10))
    found = followed_along(WAY, there_and_back, tolerance=3.0)
    assert (found.how, round(found.along)) == ("left", 10)


def test_a_way_that_crosses_itself_is_followed_in_its_order() -> None:
    loop = [(0, 0), (20, 0), (20, 10), (10, 10), (10, -10)]
    assert followed_along(loop, walk(*loop), tolerance=3.0).how == "end"
    short_cut = followed_along(loop, walk((0, 0), (10, 0), (10, -10)), tolerance=3.0)
    assert (short_cut.how, round(short_cut.along)) == ("left", 10)


@given(st.floats(0.0, 20.0), st.floats(-2.5, 2.5))
def test_whoever_keeps_beside_the_way_never_leaves_it(end: float, aside: float) -> None:
    places = polyline.resample(WAY, 0.1)
    beside = places[: max(1, int(end / 0.1))] + aside / 2
    assert followed_along(WAY, beside, tolerance=3.0).how in {"end", "stopped"}


def followed(route: Route, *corners: tuple[float, float]) -> Following:
    walk = polyline.resample(corners, 0.2)
    return followed_along(list(route.line.coords), walk, tolerance=3.0)


def test_a_crossing_is_a_decision_with_the_turn_of_the_route(
    crossing_site: Site,
) -> None:
    route = crossing_site.find_route("R1")
    decisions = decisions_of(crossing_site, route)
    assert [each.number for each in decisions] == list(range(1, len(decisions) + 1))
    [decision] = [each for each in decisions if each.id == "tp_crossing"]
    assert decision.way == "turn left"
    corner = route.line.project(Point(0, 0))
    assert decision.enter < corner < decision.leave


def test_a_corridor_without_turning_points_asks_for_no_decision(
    corridor_site: Site,
) -> None:
    route = corridor_site.find_route("R1")
    assert decisions_of(corridor_site, route) == []
    assert first_wrong([], followed(route, (2, 0), (3, 0), (2, 9))) is None


def test_walks_are_counted_up_to_their_first_wrong_decision(
    crossing_site: Site,
) -> None:
    route = crossing_site.find_route("R1")
    (x, y), (goal_x, goal_y) = route.line.coords[0][:2], route.line.coords[-1][:2]
    decisions = decisions_of(crossing_site, route)
    walks = [
        followed(route, (x, y), (0, 0), (goal_x, goal_y)),
        followed(route, (x, y), (0, 0), (8, 0)),
        followed(route, (x, y), (0, 0), (0, -8)),
        followed(route, (x, y), (x + 1, y)),
    ]
    counts = {c.decision.id: c for c in count_decisions(decisions, route, walks)}
    count = counts["tp_crossing"]
    assert (count.reached, count.right, count.wrong) == (3, 1, 2)
    assert dict(count.instead) == {"went straight on": 1, "went right": 1}
    assert first_wrong(decisions, walks[0]) is None
    assert first_wrong(decisions, walks[1]) == count.decision
