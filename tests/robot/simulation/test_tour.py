import math
from itertools import pairwise

import pytest

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.runs.films.walkthrough import Tour, tour_of
from memorymaze.world.sites.records import Site


@pytest.fixture(scope="module")
def tour(l_site: Site) -> Tour:
    """Along R1 of the way with a corner."""
    return tour_of(build_scene(l_site), l_site.find_route("R1"))


def test_it_goes_from_the_start_to_the_goal(tour: Tour, l_site: Site) -> None:
    route = l_site.find_route("R1")
    poses = list(tour.poses(10))
    assert poses[0] == pytest.approx(route.start, abs=1e-6)
    goal = route.line.coords[-1][:2]
    assert poses[-1][:2] == pytest.approx(goal, abs=0.1)
    length = sum(math.dist(one[:2], other[:2]) for one, other in pairwise(poses))
    assert length == pytest.approx(route.line.length, rel=0.02)


def test_it_moves_and_turns_in_small_steps(tour: Tour) -> None:
    for one, other in pairwise(tour.poses(20)):
        assert math.dist(one[:2], other[:2]) < 0.06
        turned = turn_between(one.heading, other.heading)
        assert abs(turned) < math.radians(45 / 20 + 0.2)


def test_it_looks_for_a_second_before_it_sets_out(tour: Tour) -> None:
    poses = list(tour.poses(10))
    assert len(set(poses[:10])) == 1
    assert len(set(poses[-9:])) == 1
    assert poses[14] != poses[0]


def test_speed_and_frame_rate_decide_how_many_frames_there_are(tour: Tour) -> None:
    plain = tour.frame_count(10)
    assert plain == len(list(tour.poses(10))) == math.floor(tour.duration * 10) + 1
    assert tour.frame_count(20) == pytest.approx(2 * plain, abs=2)
    assert tour.frame_count(10, speed=4) == pytest.approx(plain / 4, abs=2)
    fast = list(tour.poses(10, speed=4))
    assert fast[5] == pytest.approx(list(tour.poses(10))[20], abs=1e-6)


def test_a_route_that_cannot_be_driven_is_told(
    scenes: dict[str, Scene], l_site: Site
) -> None:
    elsewhere = scenes["corridor"]
    with pytest.raises(MemoryMazeError, match=r"stopped by wall after .* sites check"):
        tour_of(elsewhere, l_site.find_route("R1"))
