from shapely import Point

from memorymaze.geometry import polyline
from memorymaze.results.report.decisions import (
    count_decisions,
    decisions_of,
    first_wrong,
)
from memorymaze.results.report.following import Following, follow
from memorymaze.sites import Route, Site


def followed(route: Route, *corners: tuple[float, float]) -> Following:
    walk = polyline.resample(corners, 0.2)
    return follow(list(route.line.coords), walk, tolerance=3.0)


def test_a_crossing_is_a_decision_with_the_turn_of_the_route(
    crossing_site: Site,
) -> None:
    route = crossing_site.reference_route("R1")
    decisions = decisions_of(crossing_site, route)
    assert [each.number for each in decisions] == list(range(1, len(decisions) + 1))
    [decision] = [each for each in decisions if each.id == "tp_crossing"]
    assert decision.way == "turn left"
    corner = route.line.project(Point(0, 0))
    assert decision.enter < corner < decision.leave


def test_a_corridor_without_turning_points_asks_for_no_decision(
    corridor_site: Site,
) -> None:
    route = corridor_site.reference_route("R1")
    assert decisions_of(corridor_site, route) == []
    assert first_wrong([], followed(route, (2, 0), (3, 0), (2, 9))) is None


def test_walks_are_counted_up_to_their_first_wrong_decision(
    crossing_site: Site,
) -> None:
    route = crossing_site.reference_route("R1")
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
