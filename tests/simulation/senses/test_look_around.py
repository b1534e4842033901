import math

import numpy as np

from memorymaze.geometry.pose import Pose, turn_between
from memorymaze.robot.viewpoints import Panorama, SeenThing
from memorymaze.simulation import SimulatedRobot, build_scene
from memorymaze.simulation.obstacles import parse_obstacles
from memorymaze.simulation.senses.look_around import look_around, sector_headings
from memorymaze.sites import Site

NORTH, EAST, SOUTH, WEST = 0, 2, 4, 6


def look(site: Site, x: float, y: float) -> Panorama:
    robot = SimulatedRobot(build_scene(site), site.reference_route("R1").start)
    return look_around(robot, x, y)


def things(panorama: Panorama) -> list[SeenThing]:
    return [thing for outlook in panorama.outlooks for thing in outlook.things]


def test_directions_go_clockwise_from_north() -> None:
    headings = sector_headings()
    assert headings[NORTH] == math.pi / 2
    assert abs(turn_between(headings[EAST], 0.0)) < 1e-9
    assert abs(turn_between(headings[SOUTH], -math.pi / 2)) < 1e-9


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
