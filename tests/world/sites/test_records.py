import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point, Polygon, box
from shapely.affinity import rotate

from memorymaze.basics.errors import SettingsError, SitePlanError
from memorymaze.world.sites import Landmark, Site
from memorymaze.world.sites.records import (
    corridor_centre_line,
    floor_pieces,
    union_of_floor,
)


def _thing(heading: float, obstacle: bool = True) -> Landmark:
    return Landmark(
        id="thing",
        position=Point(3, 1),
        category="bench",
        color=None,
        name=None,
        text=None,
        heading=heading,
        size=(2.0, 0.5, 0.4),
        mount="floor",
        obstacle=obstacle,
    )


def test_walkable_floor_keeps_the_block_one_walks_round(loop_site: Site):
    floor = loop_site.walkable_floor
    assert floor.area == pytest.approx(14 * 14 - 10 * 10)
    assert len(floor.interiors) == 1


def test_free_floor_leaves_out_the_footprints_of_obstacles(corridor_site: Site):
    free = corridor_site.free_floor
    assert free.area == pytest.approx(60 - 1.5 * 0.5)
    assert not free.contains(Point(10, -1.2))
    assert corridor_site.walkable_floor.contains(Point(10, -1.2))


def test_free_floor_keeps_what_hangs_overhead_or_on_the_wall(t_site: Site):
    assert t_site.free_floor.contains(Point(-5, 0))
    assert t_site.free_floor.area == pytest.approx(66 - 0.5 * 0.5)


@pytest.mark.parametrize(
    ("heading", "expected"),
    [
        pytest.param(0.0, box(2.75, 0, 3.25, 2), id="east"),
        pytest.param(math.pi / 2, box(2, 0.75, 4, 1.25), id="north"),
        pytest.param(math.pi, box(2.75, 0, 3.25, 2), id="west"),
    ],
)
def test_a_footprint_has_its_length_across_the_front(heading: float, expected: Polygon):
    assert _thing(heading).footprint.symmetric_difference(expected).area < 1e-9


def test_a_slanted_footprint_turns_about_its_centre():
    footprint = _thing(math.radians(30)).footprint
    assert footprint.area == pytest.approx(1.0)
    assert footprint.centroid.distance(Point(3, 1)) < 1e-9


def test_a_route_starts_where_its_line_does_with_its_own_heading(t_site: Site):
    start = t_site.find_route("route_r1_reference").start
    assert start == pytest.approx((0, -9, math.pi / 2))


def test_an_unknown_route_is_answered_with_those_there_are(loop_site: Site):
    with pytest.raises(SettingsError, match=r"R1 \(route_r1_reference\), route_r1_alt"):
        loop_site.find_route("R2")


def test_a_sliver_between_overlapping_parts_is_no_hole():
    parts = [box(0, 0, 4, 2), box(3.9, 0, 8, 0.5), box(4.0015, 0.4, 8, 2)]
    assert len(union_of_floor(parts).interiors) == 0


@pytest.mark.parametrize(
    "other",
    [
        pytest.param(box(4.01, 0, 8, 2), id="gap of a centimetre"),
        pytest.param(box(4, 2, 8, 4), id="corners that touch"),
    ],
)
def test_parts_a_robot_cannot_pass_between_stay_apart(other: object):
    parts = [box(0, 0, 4, 2), other]
    assert len(floor_pieces(parts)) == 2
    with pytest.raises(SitePlanError, match="got 2 pieces"):
        union_of_floor(parts)


def test_no_part_is_no_floor():
    assert floor_pieces([]) == []
    with pytest.raises(SitePlanError, match="got 0 pieces"):
        union_of_floor([])


@pytest.mark.parametrize(
    ("corners", "expected"),
    [
        pytest.param([(0, 0), (8, 0), (8, 2), (0, 2)], [(0, 1), (8, 1)], id="east"),
        pytest.param([(0, 2), (0, 0), (8, 0), (8, 2)], [(0, 1), (8, 1)], id="rolled"),
        pytest.param([(0, 0), (2, 0), (2, 9), (0, 9)], [(1, 0), (1, 9)], id="north"),
        pytest.param(
            [(0, 0), (10, 0), (8, 2), (2, 2)], [(1, 1), (9, 1)], id="trapezium"
        ),
        pytest.param(
            [(0, 2), (8, 2), (8, 0), (0, 0)], [(0, 1), (8, 1)], id="clockwise"
        ),
    ],
)
def test_the_centre_line_joins_the_middles_of_the_short_ends(
    corners: list[tuple[float, float]], expected: list[tuple[float, float]]
):
    assert list(corridor_centre_line(Polygon(corners)).coords) == expected


@given(
    length=st.floats(3, 50),
    width=st.floats(0.5, 2.9),
    angle=st.floats(-math.pi, math.pi),
)
def test_the_centre_line_turns_with_the_corridor(
    length: float, width: float, angle: float
):
    upright = Polygon([(0, 0), (length, 0), (length, width), (0, width)])
    turned = rotate(upright, angle, origin=(0, 0), use_radians=True)
    line = corridor_centre_line(turned)
    back = rotate(line, -angle, origin=(0, 0), use_radians=True)
    ends = sorted(back.coords)
    assert line.length == pytest.approx(length)
    assert [*ends[0], *ends[1]] == pytest.approx(
        [0, width / 2, length, width / 2], abs=1e-6
    )


def test_a_shape_with_other_than_four_corners_has_no_centre_line():
    with pytest.raises(ValueError, match="4 corners, got 3"):
        corridor_centre_line(Polygon([(0, 0), (1, 0), (0, 1)]))
