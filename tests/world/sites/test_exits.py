"""Ways out of turning points, as the editor, importers and makers all find them."""

import math

import pytest
from shapely import LineString, box

from memorymaze.world.sites.exits import (
    Course,
    FloorShapes,
    exits_along,
    exits_into_the_open,
    shape_of,
)
from memorymaze.world.sites.records import Exit

PLACE = box(-1, -1, 1, 1)
EAST, NORTH = 0.0, math.pi / 2


def exits(*degrees: float, to: str = "way") -> list[Exit]:
    return [Exit(to, math.radians(each)) for each in degrees]


@pytest.mark.parametrize(
    ("found", "shape"),
    [
        (exits(90), "dead_end"),
        (exits(0, 90), "corner"),
        (exits(0, 160), "corner"),
        (exits(0, 170), "opening"),
        (exits(0, 90, 180), "t_junction"),
        (exits(0, 90, 180, 270), "crossing"),
        (exits(0, 60, 120, 180, 270), "crossing"),
        (exits(0, 90) + exits(180, to="hall"), "opening"),
    ],
)
def test_the_shape_follows_from_the_ways_out(found: list[Exit], shape: str):
    assert shape_of(found, areas={"hall"}) == shape


def test_of_what_lies_ahead_a_corridor_comes_before_an_area():
    east = LineString([(0, 0), (3, 0)])
    parts = FloorShapes({"way": box(1, -1, 5, 1)}, {"hall": box(1, -3, 5, 3)}, {})
    floor = box(-1, -3, 5, 3)
    assert list(exits_along([Course(EAST, east, parts)], PLACE, floor)) == [
        Exit("way", EAST)
    ]


def test_no_way_out_leads_into_a_wall_or_to_where_nothing_touches():
    parts = FloorShapes({"way": box(1.5, -1, 5, 1)}, {}, {})
    lines = {
        EAST: LineString([(0, 0), (3, 0)]),
        NORTH: LineString([(0, 0), (0, 3)]),
    }
    courses = [Course(heading, line, parts) for heading, line in lines.items()]
    assert list(exits_along(courses, PLACE, box(-1, -1, 5, 1))) == []


def test_a_way_that_a_wall_narrows_may_be_left_a_little_aside():
    parts = FloorShapes({"way": box(1, -1, 5, 1)}, {}, {})
    course = Course(EAST, LineString([(0, 0), (3, 0)]), parts)
    floor = box(-1, -1, 5, 1) - box(1.5, -0.1, 2.5, 0.1)
    assert list(exits_along([course], PLACE, floor)) == []
    (found,) = exits_along([course], PLACE, floor, aside=(0.0, math.radians(10)))
    assert math.degrees(found.heading) == pytest.approx(10)


def test_a_hall_is_entered_square_to_the_way_where_no_other_way_out_is():
    hall = box(-1, -1, 12, 12)
    parts = FloorShapes({}, {"hall": hall}, {})
    came = exits(180)
    found = list(exits_into_the_open(math.pi, box(0, 0, 2, 2), parts, hall, came))
    assert [round(math.degrees(each.heading)) for each in found] == [0, 90]
    beside = exits(180, 60)
    found = list(exits_into_the_open(math.pi, box(0, 0, 2, 2), parts, hall, beside))
    assert [round(math.degrees(each.heading)) for each in found] == [0]
