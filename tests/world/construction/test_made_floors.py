"""What one would notice walking through a made building."""

import math
import re

import pytest
from shapely import Point

from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.basics.signposts import signposts
from memorymaze.language.nouns import is_noun, singular
from memorymaze.testing import check_site
from memorymaze.world.construction import BUILDING_KINDS, make_building
from memorymaze.world.sites.things import kind_of_thing

ARROWS = {"left": math.pi / 2, "ahead": 0.0, "right": -math.pi / 2}


def test_sizes_and_numbers_are_those_of_large_public_floors(site):
    west, south, east, north = site.walkable_floor.bounds
    assert 40 <= max(east - west, north - south) <= 110
    assert 20 <= len(site.turning_points) <= 70
    assert len(site.doors) + len(site.landmarks) >= 70


def test_corridors_are_no_grid(site):
    headings = [
        math.degrees(exit.heading) % 90
        for point in site.turning_points
        for exit in point.exits
    ]
    assert any(10 < heading < 80 for heading in headings)
    assert len({round(corridor.width, 1) for corridor in site.corridors}) >= 3


def test_routes_take_three_to_ten_turns_to_a_named_place(site):
    names = {room.id: room.name for room in site.rooms}
    doors = {door.id: names.get(door.room) for door in site.doors}
    assert {route.route for route in site.routes} == {"R1", "R2"}
    for route in site.routes:
        assert 3 <= len(route.turns) <= 10
        assert doors[route.goal_landmark] == route.goal


def test_alternatives_go_another_way_to_the_same_place(site):
    for name in ("R1", "R2"):
        reference, *others = site.ways(name)
        for other in others:
            assert other.line.coords[0] == reference.line.coords[0]
            assert other.line.coords[-1] == reference.line.coords[-1]
            assert other.goal_landmark == reference.goal_landmark
            shared = other.line.intersection(reference.line.buffer(0.2)).length
            assert shared < 0.8 * other.line.length


def test_routes_begin_at_an_entrance(site):
    entrances = [door for door in site.doors if door.style == "automatic_glass"]
    for route in site.routes:
        start = Point(route.line.coords[0])
        assert min(start.distance(door.line) for door in entrances) < 2


def test_pointing_signs_lead_nearer_by_the_shortest_way(site):
    grid = FloorGrid.from_polygon(site.walkable_floor)
    pointing = 0
    for sign in site.landmarks:
        for post in signposts(sign.text or ""):
            if post.arrow not in ARROWS or sign.category != "hanging sign":
                continue
            for name in post.words.split(", "):
                assert _nearer(site, grid, sign, post.arrow, name), (sign, name)
                pointing += 1
    assert pointing >= 10


def _nearer(site, grid, sign, arrow, name):
    """Tell whether the way that an arrow shows is the shortest from the junction."""
    course = sign.heading + math.pi
    eye = (sign.position.x, sign.position.y)
    junction = min(
        (
            point
            for point in site.turning_points
            if abs(
                turn_between(course, heading_to(eye, point.polygon.centroid.coords[0]))
            )
            < math.radians(30)
        ),
        key=lambda point: point.polygon.distance(sign.position),
    )
    middle = junction.polygon.centroid
    places = _places(site, name)

    def left_over(leaving):
        ahead = 0.75 * math.sqrt(junction.polygon.area) + 0.8
        step = (
            middle.x + ahead * math.cos(leaving.heading),
            middle.y + ahead * math.sin(leaving.heading),
        )
        return min(grid.distance(step, place) for place in places)

    def off_arrow(leaving):
        turn = turn_between(course, leaving.heading)
        return abs(turn_between(ARROWS[arrow], turn))

    shown = min(junction.exits, key=off_arrow)
    here = min(grid.distance((middle.x, middle.y), place) for place in places)
    return off_arrow(shown) < math.radians(65) and left_over(shown) < here


def _places(site, name):
    rooms = {room.id for room in site.rooms if room.name == name}
    places = [
        (door.line.centroid.x, door.line.centroid.y)
        for door in site.doors
        if door.room in rooms
    ]
    middles = [
        area.polygon.representative_point() for area in site.areas if area.name == name
    ]
    return places + [(middle.x, middle.y) for middle in middles]


def test_signs_with_a_name_or_number_are_beside_its_door(site):
    names = {room.id: room.name for room in site.rooms}
    beside = 0
    for sign in site.landmarks:
        if sign.category not in {"sign", "room number sign"}:
            continue
        near = [door for door in site.doors if door.line.distance(sign.position) < 2.0]
        assert sign.text in {
            text for door in near for text in (door.label, names.get(door.room))
        }
        beside += 1
    assert beside >= 5


def test_numbers_are_in_order_along_each_side_of_a_corridor(site):
    for corridor in site.corridors:
        line = corridor.centre_line
        for parity in (0, 1):
            along = sorted(
                (line.project(door.line.centroid), int(found.group(1)))
                for door in site.doors
                if _is_in_wall_of(door, corridor)
                and (found := re.fullmatch(r"[A-Z]?(\d+)", door.label or ""))
                and int(found.group(1)) % 2 == parity
            )
            numbers = [number for _, number in along]
            assert numbers in (sorted(numbers), sorted(numbers, reverse=True))


def _is_in_wall_of(door, corridor):
    (ax, ay), (bx, by) = corridor.centre_line.coords
    (cx, cy), (dx, dy) = door.line.coords
    across = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    parallel = abs(across) < 0.02 * corridor.length * door.line.length
    away = corridor.centre_line.distance(door.line.centroid)
    return parallel and abs(away - corridor.width / 2) < 0.05


def test_rooms_do_not_overlap(site):
    for index, room in enumerate(site.rooms):
        for other in site.rooms[:index]:
            assert room.polygon.intersection(other.polygon).area < 0.05


def test_everything_has_a_look_and_is_called_by_a_noun(site):
    for thing in site.landmarks:
        assert kind_of_thing(thing.category) is not None, thing.category
        assert is_noun(singular(thing.category.lower().split()[-1])), thing.category


@pytest.mark.proof
@pytest.mark.parametrize("seed", range(25))
@pytest.mark.parametrize("kind", BUILDING_KINDS)
def test_the_oracle_walks_every_route_of_200_buildings_untouched(kind, seed, tmp_path):
    building = make_building(kind, seed)
    path = tmp_path / f"{building.name}.geojson"
    building.save(path)
    check_site(path)
