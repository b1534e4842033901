import math
from itertools import pairwise

import pytest

from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory
from memorymaze.runs.episodes.results import route_turns_in_order, site_turns_taken
from memorymaze.runs.metrics.turns import TurnAtPlace
from memorymaze.world.sites import Site


def walk(*corners: tuple[float, float]) -> Trajectory:
    """Walk along straight lines in small steps, facing the way one goes."""
    poses: list[TimedPose] = []
    for (x, y), (to_x, to_y) in pairwise(corners):
        heading = math.atan2(to_y - y, to_x - x)
        steps = math.ceil(math.dist((x, y), (to_x, to_y)) / 0.1)
        for step in range(steps + 1):
            part = step / steps
            poses.append(
                TimedPose(
                    len(poses) * 0.1,
                    x + part * (to_x - x),
                    y + part * (to_y - y),
                    heading,
                )
            )
    return Trajectory(poses)


def along(site: Site, route_id: str) -> Trajectory:
    return walk(*(point[:2] for point in site.find_route(route_id).line.coords))


def test_walking_a_route_takes_all_its_turns(tiny_sites: dict[str, Site]) -> None:
    for site in tiny_sites.values():
        for route in site.routes:
            assert route_turns_in_order(site, route, along(site, route.id)) == 1.0


def test_the_wrong_turn_counts_nothing(t_site: Site) -> None:
    left, right = t_site.find_route("R1"), t_site.find_route("R2")
    assert site_turns_taken(t_site, along(t_site, right.id)) == [
        TurnAtPlace("tp_junction", "right")
    ]
    assert route_turns_in_order(t_site, left, along(t_site, right.id)) == 0.0


def test_part_of_the_turns_gives_their_share(loop_site: Site) -> None:
    route = loop_site.find_route("route_r1_alternative")
    *first, _ = [point[:2] for point in route.line.coords]
    assert route_turns_in_order(loop_site, route, walk(*first)) == pytest.approx(2 / 3)


def test_turning_back_is_no_turn(t_site: Site) -> None:
    assert site_turns_taken(t_site, walk((0, -5), (0, 0), (0, -5))) == []


def test_standing_still_takes_no_turn(corridor_site: Site, t_site: Site) -> None:
    stand = Trajectory([TimedPose(0.0, 2.0, 0.0, 0.0)])
    [route] = corridor_site.routes
    assert route_turns_in_order(corridor_site, route, stand) == 1.0
    assert route_turns_in_order(t_site, t_site.find_route("R1"), stand) == 0.0
