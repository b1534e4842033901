import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from shapely import LineString, box, union_all

from memorymaze.basics.errors import ImportFileError
from memorymaze.world.importing.centre_lines import centre_lines
from memorymaze.world.importing.imported import (
    CentreLine,
    ImportNotes,
    imported_building,
)
from memorymaze.world.importing.ways import OpenArea, plan_floor
from memorymaze.world.sites import find_site_problems


@pytest.fixture
def planned(tmp_path):
    """Make a site of lines, and see that it breaks no rule that is an error."""

    def plan(lines, floor=None, areas=()):
        notes = ImportNotes()
        made = plan_floor(lines, notes, floor, areas)
        path = tmp_path / "floor.geojson"
        site = imported_building(path, "Floor", "1", None, made.parts)
        site.save(path)
        wrong = [each for each in find_site_problems(path) if each.severity == "error"]
        assert wrong == []
        return site, notes

    return plan


def line(*points, width=2.0, name=None):
    return CentreLine(points, width, name)


def shapes(site):
    return sorted(point.shape for point in site.turning_points)


def test_two_lines_that_meet_at_a_corner_are_two_corridors_and_a_turning_point(planned):
    site, _ = planned([line((0, 0), (10, 0)), line((10, 0), (10, 8), name="Lane")])
    assert [round(each.width, 2) for each in site.corridors] == [2.0, 2.0]
    assert {each.name for each in site.corridors} == {None, "Lane"}
    (corner,) = site.turning_points
    assert corner.shape == "corner"
    headings = [round(math.degrees(way.heading)) for way in corner.exits]
    assert sorted(headings) == [90, 180]
    assert (
        site.walkable_floor.equals_exact(
            union_all([box(0, -1, 11, 1), box(9, -1, 11, 8)]).normalize(), 0.02
        )
        or site.walkable_floor.symmetric_difference(
            union_all([box(0, -1, 11, 1), box(9, -1, 11, 8)])
        ).area
        < 0.05
    )


def test_lines_that_cross_meet_though_neither_has_a_point_there(planned):
    site, _ = planned([line((-10, 0), (10, 0)), line((0, -8), (0, 8))])
    assert shapes(site) == ["crossing"]


def test_a_line_that_ends_just_short_of_another_meets_it(planned):
    site, _ = planned([line((-10, 0), (10, 0)), line((0, 0.2), (0, 8))])
    assert shapes(site) == ["t_junction"]


def test_a_bend_below_fifteen_degrees_is_no_turning_point(planned):
    site, _ = planned([line((0, 0), (10, 0), (20, 2.5))])
    assert (len(site.corridors), shapes(site)) == (2, [])


def test_two_junctions_close_together_are_one_turning_point(planned):
    site, _ = planned([
        line((-10, 0), (10, 0)), line((0, 0), (0, 8)), line((0.8, 0), (0.8, -8)),
    ])  # fmt: skip
    assert shapes(site) == ["crossing"]


def test_a_line_into_an_open_area_ends_at_an_opening(planned):
    hall = OpenArea(box(10, -6, 22, 6), "Hall")
    site, _ = planned([line((0, 0), (10, 0))], areas=[hall])
    assert [each.name for each in site.areas] == ["Hall"]
    assert shapes(site) == ["opening"]
    (opening,) = site.turning_points
    assert {way.to for way in opening.exits} == {"corridor_1", "area_1"}


def test_floor_that_does_not_hang_together_is_left_out_and_told(planned):
    site, notes = planned([line((0, 0), (20, 0)), line((0, 10), (8, 10))])
    assert site.walkable_floor.bounds[3] == pytest.approx(1.0)
    assert notes.missing == [
        "16.0 m² of floor at (4.0, 10.0): it does not hang together with the rest"
    ]


def test_a_block_within_the_floor_stays_one(planned):
    around = box(0, 0, 20, 20) - box(3, 3, 17, 17)
    site, _ = planned(centre_lines(around), around)
    assert len(site.walkable_floor.interiors) == 1
    assert shapes(site) == ["corner"] * 4


def test_no_floor_at_all_is_an_error():
    with pytest.raises(ImportFileError, match="expected some floor to walk on"):
        plan_floor([], ImportNotes())


@pytest.mark.parametrize("name", ["university", "museum_5f", "museum_7f"])
def test_a_floor_of_the_benchmark_comes_back_from_its_outline(
    name, builtin_sites, planned
):
    floor = builtin_sites[name].walkable_floor
    site, _ = planned(centre_lines(floor), floor)
    assert site.walkable_floor.symmetric_difference(floor).area < 0.005 * floor.area
    assert len(site.turning_points) >= 0.7 * len(builtin_sites[name].turning_points)


# Nearer to 0 than any file has them (1e-200), numbers make shapely warn.
metres = st.floats(-25, 25).map(lambda number: round(number, 9))
places = st.tuples(metres, metres)
drawn = st.lists(
    st.builds(
        CentreLine,
        st.lists(places, min_size=2, max_size=4, unique=True).map(tuple),
        st.floats(0.6, 7),
    ),
    min_size=1,
    max_size=7,
).filter(lambda lines: max(LineString(each.points).length for each in lines) > 3)
anything = settings(
    max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@anything
@given(drawn)
def test_whatever_lines_are_drawn_the_floor_keeps_the_rules(planned, lines):
    planned(lines)


@anything
@given(drawn, st.sampled_from(["flat", "round", "square"]))
def test_whatever_floor_is_drawn_keeps_the_rules(planned, lines, caps):
    wide = [
        LineString(each.points).buffer(each.width / 2, cap_style=caps) for each in lines
    ]
    floor = union_all(wide)
    planned(centre_lines(floor), floor)
