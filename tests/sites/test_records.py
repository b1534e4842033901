import math

import pytest
from shapely import Point, Polygon, box

from memorymaze.sites import Landmark, Site


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
    start = t_site.route("route_r1_reference").start
    assert start == pytest.approx((0, -9, math.pi / 2))


def test_reference_route_finds_routes_by_their_short_name(loop_site: Site):
    assert loop_site.reference_route("R1") is loop_site.route("route_r1_reference")


def test_an_unknown_route_is_answered_with_those_there_are(loop_site: Site):
    with pytest.raises(KeyError, match=r"route_r1_reference, route_r1_alternative"):
        loop_site.route("route_r9")
    with pytest.raises(KeyError, match=r"'R2'; there are: R1"):
        loop_site.reference_route("R2")


def test_a_corridor_knows_its_length_and_width(corridor_site: Site):
    [corridor] = corridor_site.corridors
    assert (corridor.length, corridor.width) == pytest.approx((20, 3))


def test_sites_read_from_the_same_plan_are_equal(
    l_site: Site, tiny_sites: dict[str, Site]
):
    assert tiny_sites["l_shape"] == l_site
    assert tiny_sites["loop"] != l_site
