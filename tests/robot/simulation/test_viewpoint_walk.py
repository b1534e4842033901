import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from memorymaze.basics.errors import EpisodeOver
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.api.viewpoints import Panorama, SeenThing
from memorymaze.robot.simulation.obstacles import parse_obstacles
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.simulation.viewpoint_walk import (
    ViewpointWalk,
    look_around,
)
from memorymaze.world.sites import Site, load_site
from memorymaze.world.sites.navigation_graph import (
    NavigationGraph,
    Viewpoint,
    navigation_graph,
)

Make = Callable[..., SimulatedRobot]
NORTH, EAST, SOUTH, WEST = 0, 2, 4, 6


@pytest.fixture
def robot_in() -> Make:
    def make(
        site: Site, start: Pose | None = None, time_budget: float = 600.0
    ) -> SimulatedRobot:
        return SimulatedRobot(
            build_scene(site),
            start or site.find_route("R1").start,
            SimulationSettings(time_budget=time_budget),
            np.random.default_rng(0),
        )

    return make


def test_it_really_drives_from_viewpoint_to_viewpoint(
    t_site: Site, robot_in: Make
) -> None:
    robot = robot_in(t_site)
    graph = navigation_graph(t_site)
    walk = ViewpointWalk(robot, graph)
    places = {each.id: each for each in graph.viewpoints}
    for _ in range(4):
        before = robot.time
        way = max(walk.ways_on(), key=lambda way: way.heading)
        journey = walk.go_to(way.viewpoint)
        assert journey.end == "arrived"
        assert journey.distance == pytest.approx(way.distance, abs=0.1)
        assert walk.viewpoint == way.viewpoint
        assert math.dist(robot.pose[:2], places[way.viewpoint][1:]) < 0.1
        assert robot.time - before > way.distance, "at no more than 1 m/s"
    assert robot.collisions == ()
    assert robot.trajectory().poses[-1][1:3] == pytest.approx(robot.pose[:2])


def test_it_begins_at_the_nearest_viewpoint_facing_as_the_episode_does(
    t_site: Site, robot_in: Make
) -> None:
    robot = robot_in(t_site, Pose(0.3, -6.0, math.pi / 2))
    graph = navigation_graph(t_site)
    walk = ViewpointWalk(robot, graph)
    assert walk.viewpoint == graph.nearest(0.3, -6.0).id
    assert walk.start_heading == pytest.approx(math.pi / 2)
    assert math.dist(robot.pose[:2], graph.nearest(0.3, -6.0)[1:]) < 0.1


def test_it_refuses_to_go_where_no_way_leads(t_site: Site, robot_in: Make) -> None:
    robot = robot_in(t_site)
    graph = navigation_graph(t_site)
    walk = ViewpointWalk(robot, graph)
    here, before = robot.pose, robot.time
    far = graph.nearest(-11, 0).id
    assert walk.go_to(far).end == "not_adjacent"
    assert walk.go_to("f" * 32).end == "unknown"
    assert walk.go_to(walk.viewpoint).end == "not_adjacent"
    assert (robot.pose, robot.time) == (here, before)


def test_a_blocked_way_is_told_and_the_robot_comes_back(
    t_site: Site, robot_in: Make
) -> None:
    """The edge of this graph leads through a wall."""
    start, beyond = Viewpoint("a" * 32, 0.0, -5.0), Viewpoint("b" * 32, 4.0, -5.0)
    graph = NavigationGraph("t_junction", (start, beyond), frozenset({(0, 1)}))
    robot = robot_in(t_site, Pose(0.0, -5.0, math.pi / 2))
    walk = ViewpointWalk(robot, graph)
    journey = walk.go_to(beyond.id)
    assert (journey.end, journey.reason) == ("blocked", "wall")
    assert journey.distance > 1.0
    assert walk.viewpoint == start.id
    assert math.dist(robot.pose[:2], start[1:]) < 0.2
    assert len(robot.collisions) >= 1


def test_a_budget_that_runs_out_on_the_way_ends_the_episode(
    t_site: Site, robot_in: Make
) -> None:
    graph = navigation_graph(t_site)
    robot = robot_in(t_site, Pose(*graph.viewpoints[0][1:], 0.0), time_budget=1.5)
    walk = ViewpointWalk(robot, graph)
    far = max(walk.ways_on(), key=lambda way: way.distance).viewpoint
    with pytest.raises(EpisodeOver) as over:
        walk.go_to(far)
    assert over.value.stopped_by == robot.stopped_by == "budget"
    assert walk.viewpoint == graph.viewpoints[0].id


def look(site: Site, x: float, y: float) -> Panorama:
    robot = SimulatedRobot(build_scene(site), site.find_route("R1").start)
    return look_around(robot, x, y)


def things(panorama: Panorama) -> list[SeenThing]:
    return [thing for outlook in panorama.outlooks for thing in outlook.things]


def test_each_thing_is_told_once_where_it_is(corridor_site: Site) -> None:
    """The bench is south of (10, 0); doors are on the north side."""
    panorama = look(corridor_site, 10.0, 0.0)
    benches = [thing for thing in things(panorama) if "bench" in thing.name]
    [bench] = benches
    assert bench in panorama.outlooks[SOUTH].things
    assert abs(turn_between(bench.heading, -math.pi / 2)) < 0.1
    assert 0.8 < bench.distance < 1.5, "from the lens, which is above it"


def test_only_things_within_3_m_are_told_with_a_distance(corridor_site: Site) -> None:
    panorama = look(corridor_site, 10.0, 0.0)
    assert things(panorama)
    assert all(thing.distance <= 3.0 for thing in things(panorama))
    north_east = panorama.outlooks[1].scene
    assert "door" in north_east, "the door at (12, 1.5) is 2.5 m away"
    assert "door" in panorama.outlooks[EAST].scene, "the next one only in the sentence"
    assert not panorama.outlooks[EAST].things


def test_what_walls_hide_is_not_seen(t_site: Site) -> None:
    """The red chair stands round the corner."""
    below = look(t_site, 0.0, -7.0)
    assert "chair" not in str(below)
    assert "chair" in str(look(t_site, 3.0, 0.0))


def test_words_on_signs_can_be_read(t_site: Site) -> None:
    assert 'white sign "Library left, lift right"' in str(look(t_site, 0.0, -2.0))


def test_words_are_told_only_where_their_side_is_seen(
    changed: Callable[..., Path],
) -> None:
    board = {
        "geometry.coordinates": [10, 0],
        "properties.category": "signboard",
        "properties.text": "← Library",
        "properties.mount": "ceiling",
        "properties.heading_deg": 180,
        "properties.size_m": [1.2, 0.1, 0.4],
        "properties.obstacle": False,
    }
    site = load_site(changed("corridor", "bench", board))
    assert 'signboard "← Library"' in str(look(site, 7.0, 0.0))
    from_behind = str(look(site, 13.0, 0.0))
    assert "signboard" in from_behind
    assert "Library" not in from_behind


def test_a_long_way_and_a_wall_are_told_apart(corridor_site: Site) -> None:
    panorama = look(corridor_site, 2.0, 0.0)
    assert panorama.outlooks[EAST].scene.startswith("A long corridor that leads on")
    assert panorama.outlooks[NORTH].scene.startswith("A plaster wall close by")
    assert "corridor with a linoleum floor" in panorama.summary
    assert panorama.described_by == "templates"


def test_the_robot_need_not_be_there(corridor_site: Site) -> None:
    robot = SimulatedRobot(build_scene(corridor_site), Pose(3.0, 0.0, 0.0))
    before = (robot.pose, robot.time, robot.calls)
    look_around(robot, 10.0, 0.0)
    assert (robot.pose, robot.time, robot.calls) == before


def test_things_left_in_the_way_are_seen(corridor_site: Site) -> None:
    """Their places are an episode's own, so they are looked at anew."""
    scene = build_scene(corridor_site, parse_obstacles("things=8,people=0"))
    robot = SimulatedRobot(
        scene, Pose(2.0, 0.0, 0.0), obstacles_rng=np.random.default_rng(1)
    )
    around = robot.surroundings
    assert around is not None
    thing = around.things[0]
    seen = look_around(robot, thing.pose.x - 1.2, 0.0)
    assert thing.record.category in str(seen)
