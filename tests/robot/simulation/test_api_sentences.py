"""What the control API says of the building and the robot is so."""

import math
import re
from collections.abc import Callable, Iterator
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from shapely import Point, Polygon, box
from shapely.affinity import rotate
from shapely.ops import unary_union
from tests.robot.simulation.conftest import PutRobot

import memorymaze as mm
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.api.control import DIRECTIONS, Robot
from memorymaze.robot.perception.matching import points_elsewhere
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.steering.commands import direction_of, exit_meant
from memorymaze.world.sites import Site, load_site
from memorymaze.world.sites.records import Route

Scenes = dict[str, Scene]
ApiSays = Callable[[str], None]


def walk(robot: SimulatedRobot) -> Iterator[list[str]]:
    """Go ahead to the end, and tell the ways at each step."""
    yield list(robot.detect_turning_point())
    while robot.move_forward(0.5).reason == "done":
        yield list(robot.detect_turning_point())


def routes_of(sites: dict[str, Site]) -> Iterator[tuple[Site, Route]]:
    for site in sites.values():
        for route in site.routes:
            if route.turns:
                yield site, route


# At the start.


def test_every_turn_that_is_told_is_still_to_be_made_at_the_start(
    tiny_sites: dict[str, Site], builtin_sites: dict[str, Site], api_says: ApiSays
) -> None:
    api_says("every turn that is told is still to be made")
    for site, route in (*routes_of(tiny_sites), *routes_of(builtin_sites)):
        first = route.turns[0]
        place = next(each for each in site.turning_points if each.id == first.at)
        robot = SimulatedRobot(build_scene(site), route.start)
        ways = [
            way
            for told in walk(robot)
            if place.polygon.covers(Point(robot.pose[:2]))
            for way in told
        ]
        assert any(way.endswith(first.direction) for way in ways), route.id


def test_what_one_comes_from_is_behind_the_robot(
    builtin_sites: dict[str, Site], api_says: ApiSays
) -> None:
    api_says('what one comes from ("from the lifts") is behind it')
    route = builtin_sites["museum_5f"].find_route("R1")
    x, y, heading = route.start
    lifts = [
        each.line.interpolate(0.5, normalized=True)
        for each in builtin_sites["museum_5f"].doors
        if each.style == "elevator"
    ]
    nearest = min(lifts, key=Point(x, y).distance)
    bearing = math.atan2(nearest.y - y, nearest.x - x)
    assert abs(turn_between(heading, bearing)) > math.pi / 2


def test_the_robot_may_start_inside_the_turning_point_of_the_first_turn(
    put_robot: PutRobot, builtin_sites: dict[str, Site], api_says: ApiSays
) -> None:
    api_says("It may stand inside a turning point already, that of the first turn.")
    robot = put_robot("t_junction", 0, 0, 90)
    assert robot.turning_point_id() == 1
    assert robot.turn("right").turned
    inside = {
        route.start: SimulatedRobot(build_scene(site), route.start).turning_point_id()
        for site, route in routes_of(builtin_sites)
    }
    assert set(inside.values()) == {None, 1}


# Turning points.


@pytest.mark.parametrize("side", [1, -1])
def test_the_words_end_at_the_angles_told(api_says: ApiSays, side: int) -> None:
    api_says("`forward` up to 15 degrees off it, `slight_left` and `slight_right`")
    api_says("up to 60, `left` and `right` up to 120, `sharp_left` and `sharp_right`")
    name = "left" if side > 0 else "right"
    words = ["forward", f"slight_{name}", name, f"sharp_{name}", None]
    for limit, below, above in zip((15, 60, 120, 160), words, words[1:], strict=False):
        assert direction_of(side * math.radians(limit - 0.5)) == below
        assert direction_of(side * math.radians(limit + 0.5)) == above


def test_doors_of_rooms_lifts_and_stairs_are_no_ways(
    changed: Callable[..., Path], put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("doors of rooms, lifts and stairs are none")
    automatic = {"properties.style": "automatic_glass", "properties.state": "open"}
    opened = build_scene(load_site(changed("corridor", "door_2", automatic)))
    assert list(filter(None, walk(put_robot(opened, 1, 0)))) == []
    at_the_lift = put_robot("t_junction", 5, 0, 0)
    assert list(filter(None, walk(at_the_lift))) == []


def test_an_automatic_door_to_open_floor_is_a_way(
    builtin_sites: dict[str, Site], api_says: ApiSays
) -> None:
    api_says("also where automatic doors stand open to it")
    site = builtin_sites["museum_7f"]
    terrace = next(each for each in site.areas if each.id == "a_terrace")
    robot = SimulatedRobot(build_scene(site), Pose(66.0, 19.5, math.radians(38)))
    assert any("right" in told for told in walk_to(robot, "right"))
    assert robot.turn("right").turned
    robot.move_forward(6)
    assert terrace.polygon.covers(Point(robot.pose[:2]))


def walk_to(robot: SimulatedRobot, way: str) -> Iterator[list[str]]:
    for told in walk(robot):
        yield told
        if way in told:
            return


def test_where_a_hall_begins_is_a_turning_point(
    put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("where a hall begins")
    api_says('a place that only leads straight on `["forward"]`')
    told = list(walk(put_robot("two_rooms", 1, 3.3)))
    assert [each for each in told if each] == [["forward"]] * sum(map(bool, told))
    assert sum(map(bool, told)) > 3


def fork(plans: Any) -> Site:
    """A corridor from the west that parts into two, 35 degrees to either side."""
    arms = [rotate(box(-1.2, -1.5, 14, 1.5), a, origin=(0, 0)) for a in (35, -35)]
    mouth = Polygon([(-1, -1.5), (1.5, -2.2), (3, -1.6), (3, 1.6), (1.5, 2.2)])
    return plans.site(
        plans.corridor("stem", -14, -1.5, 1, 1.5),
        plans.slanted_corridor("north", arms[0]),
        plans.slanted_corridor("south", arms[1]),
        plans.turning_point(
            "fork",
            mouth.union(Point(-1, 1.5)).convex_hull,
            [("stem", 180), ("north", 35), ("south", -35)],
        ),
    )


@pytest.mark.parametrize(("word", "degrees"), [("left", 35), ("slight_right", -35)])
def test_a_fork_has_no_way_ahead(
    plans: Any, put_robot: PutRobot, api_says: ApiSays, word: str, degrees: float
) -> None:
    api_says('a fork `["slight_left", "slight_right"]` without `forward`')
    robot = put_robot(build_scene(fork(plans)), -9, 0)
    assert list(walk_to(robot, "slight_left"))[-1] == ["slight_left", "slight_right"]
    assert robot.turn(word).turned
    assert robot.move_forward(6).reason == "done"
    assert math.degrees(robot.pose.heading) == pytest.approx(degrees, abs=2)


def test_at_a_dead_end_the_list_is_empty_inside_a_turning_point(
    put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("Elsewhere, and at dead ends, the list is empty.")
    robot = put_robot("t_junction", 5, 0)
    assert robot.turning_point_id() is None
    assert list(walk(robot))[-1] == []
    assert robot.turning_point_id() == 1


def test_the_way_in_is_not_told_although_the_robot_faces_it(
    put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("never in the list, even when it has turned there and faces it")
    robot = put_robot("t_junction", 0, -5, 90)
    assert list(walk_to(robot, "left"))[-1] == ["left", "right"]
    robot.turn("around")
    assert robot.detect_turning_point() in (["left", "right"], ["right", "left"])
    assert robot.turn("forward").turned
    assert robot.move_forward(4).reason == "done"
    assert robot.pose[:2] == pytest.approx((0, -4), abs=0.4)


def test_opposite_ways_of_one_turning_point_face_each_other(
    builtin_sites: dict[str, Site], api_says: ApiSays
) -> None:
    api_says("A way on the left and one on the right that do not face each other")
    compared = 0
    for site in builtin_sites.values():
        floors = {each.id: each.polygon for each in site.corridors}
        for point in site.turning_points:
            ways = [each for each in point.exits if each.to in floors]
            for a in ways:
                for b in ways:
                    apart = abs(turn_between(a.heading, b.heading))
                    if a.to < b.to and apart > math.radians(165):
                        compared += 1
                        assert shared_width(floors[a.to], floors[b.to], a.heading) > 1
    assert compared >= 4


def shared_width(first: Polygon, second: Polygon, heading: float) -> float:
    """Return how much of two corridors lies in line, metres across a heading."""
    spans = [
        [y * math.cos(heading) - x * math.sin(heading) for x, y in each.exterior.coords]
        for each in (first, second)
    ]
    return min(map(max, spans)) - max(map(min, spans))


def test_corridors_meet_in_turning_points(
    builtin_sites: dict[str, Site], api_says: ApiSays
) -> None:
    api_says("sharper ones are turning points, in which it halts")
    for site in builtin_sites.values():
        points = unary_union([each.polygon for each in site.turning_points])
        for first, second in combinations(site.corridors, 2):
            shared = first.polygon & second.polygon
            assert shared.is_empty or points.distance(shared.centroid) < 0.3


# Turning.


@pytest.mark.parametrize(
    ("word", "least", "most", "sentence"),
    [
        ("left", 30, 150, "`left` finds one from 30 to 150 degrees"),
        ("slight_left", 10, 75, "`slight_left` from 10 to 75"),
        (
            "sharp_left",
            105,
            165,
            "`sharp_left` from 105 to 165 (the same to the right)",
        ),
    ],
)
def test_a_word_falls_back_as_far_as_is_told(
    api_says: ApiSays, word: Any, least: float, most: float, sentence: str
) -> None:
    api_says(sentence)
    right = word.replace("left", "right")
    for degrees, found in ((least - 1, None), (least, 0), (most, 0), (most + 1, None)):
        assert exit_meant(word, [math.radians(degrees)]) == found
        assert exit_meant(right, [-math.radians(degrees)]) == found


def test_forward_bends_up_to_60_degrees(api_says: ApiSays) -> None:
    api_says("`forward` the one that bends least, up to 60")
    assert exit_meant("forward", [math.radians(59), math.radians(-58)]) == 1
    assert exit_meant("forward", [math.radians(61)]) is None


def test_between_a_left_and_a_right_way_nothing_else_is_taken(
    put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("between just a left and a right way it is refused")
    robot = put_robot("t_junction", 0, 0, 90)
    for word in set(DIRECTIONS) - {"left", "right", "around"}:
        assert not robot.turn(word).turned
    assert robot.turn("left").turned


# Looking and reading.


@pytest.mark.parametrize("words", ["wall", "corridor", "hall", "plaster"])
def test_walls_corridors_and_halls_are_not_found(
    scenes: Scenes, put_robot: PutRobot, api_says: ApiSays, words: str
) -> None:
    api_says("walls, corridors and halls are not")
    for name in ("corridor", "two_rooms", "t_junction"):
        robot = put_robot(name, *scenes[name].site.routes[0].start[:2], 0)
        assert not any(robot.detect_from_RGB_image(words) for _ in walk(robot))


@pytest.mark.parametrize(
    ("words", "found"),
    [("linoleum", True), ("the floor", True), ("lino floor", True), ("carpet", False)],
)
def test_a_floor_is_found_by_what_covers_it(
    put_robot: PutRobot, api_says: ApiSays, words: str, found: bool
) -> None:
    api_says('floors by what covers them ("carpet", "tiled floor")')
    robot = put_robot("t_junction", -9, 0, 0)
    assert bool(robot.detect_from_RGB_image(words)) is found


def test_a_room_is_found_by_its_door(put_robot: PutRobot, api_says: ApiSays) -> None:
    api_says('Rooms are found by their doors ("library", "room 12")')
    (found,) = put_robot("t_junction", -9, 0, 180).detect_from_RGB_image("library")
    assert "door" in found.label


@pytest.mark.parametrize(("words", "doors"), [("102", 1), ("10", 0), ("1025", 0)])
def test_numbers_match_whole(
    put_robot: PutRobot, api_says: ApiSays, words: str, doors: int
) -> None:
    api_says("Numbers match whole")
    robot = put_robot("corridor", 1, 0)
    found = {
        each.track_id
        for _ in walk(robot)
        for each in robot.detect_from_RGB_image(f"sign that says {words}")
    }
    assert len(found) == doors


def test_no_threshold_is_needed_and_a_high_one_would_lose_what_was_meant(
    put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("What fits badly is left out already: no threshold is needed.")
    robot = put_robot("t_junction", -9, 0, 180)
    (door,) = robot.detect_from_RGB_image("sign that says Library")
    assert 0.5 <= door.score < 0.7
    assert robot.detect_from_RGB_image("door")[0].score == 1
    assert robot.detect_from_RGB_image("bench") == []


def test_a_sign_that_is_found_may_point_the_way(
    put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("A sign may bear the words and only point the way: read it.")
    robot = put_robot("t_junction", 0, -2.5, 90)
    (sign,) = robot.detect_from_RGB_image("sign that says Library")
    (text,) = robot.read_signs()
    assert sign.distance == pytest.approx(text.distance, abs=0.1)
    assert "left" in text.text.lower()


def test_door_signs_are_read_before_the_robot_is_beside_them(
    put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("for a few steps of 0.5 m before the robot is beside it")
    robot = put_robot("corridor", 1, 0)
    ahead: dict[str, list[float]] = {}
    doors = {"101": 3.0, "102": 7.5, "103": 12.0, "104": 16.5}
    for _ in walk(robot):
        for sign in robot.read_signs():
            ahead.setdefault(sign.text, []).append(doors[sign.text] - robot.pose.x)
    assert set(ahead) == set(doors)
    assert all(len(set(map(round, each))) <= 3 for each in ahead.values())
    assert min(min(each) for each in ahead.values()) > 0.5
    assert max(max(each) for each in ahead.values()) < 3.5


def test_signs_that_do_not_point_are_mostly_at_the_place(
    builtin_sites: dict[str, Site], api_says: ApiSays
) -> None:
    api_says("points the way; one without is mostly at the place.")
    distances: list[float] = []
    for site in builtin_sites.values():
        places = [
            (each.name.lower(), each.polygon)
            for each in (*site.rooms, *site.areas, *site.corridors)
            if each.name and len(each.name) > 3
        ]
        for thing in site.landmarks:
            if thing.text is None or points_elsewhere(thing.text):
                continue
            for name in {name for name, _ in places}:
                if re.search(rf"\b{re.escape(name)}\b", thing.text.lower()):
                    distances.append(
                        min(p.distance(thing.position) for n, p in places if n == name)
                    )
    assert len(distances) > 30
    assert sum(each < 5 for each in distances) > 0.9 * len(distances)


# The end.


class Walker:
    """Goes so far and stops."""

    name = "walker"

    def __init__(self, distance: float) -> None:
        self.distance = distance

    def follow(self, instruction: str, robot: Robot, journal: Any, rng: Any) -> None:
        robot.move_forward(self.distance)


@pytest.mark.parametrize(("short_of_it", "arrived"), [(2.7, True), (3.3, False)])
def test_less_than_3_m_from_the_destination_is_there(
    corridor_site: Site, api_says: ApiSays, short_of_it: float, arrived: bool
) -> None:
    api_says("It counts as arrived less than 3 m from the destination, as one walks.")
    length = corridor_site.find_route("R1").length
    walked = mm.follow("Go.", Walker(length - short_of_it), site=corridor_site)
    assert walked.success == arrived
