import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, MultiPolygon, Polygon, box, union_all
from shapely.affinity import rotate, translate

from memorymaze.world.importing.centre_lines import centre_lines
from memorymaze.world.importing.imported import CentreLine
from memorymaze.world.sites import load_site

CORRIDOR = box(0, 0, 20, 2)
BESIDE = box(9, 2, 11, 12)
BEYOND = box(9, -10, 11, 0)


def ends(line: CentreLine) -> list[tuple[float, float]]:
    return sorted([line.points[0], line.points[-1]])


def test_a_corridor_has_one_line_from_wall_to_wall() -> None:
    (line,) = centre_lines(CORRIDOR)

    assert line.width == pytest.approx(2, abs=0.05)
    assert ends(line) == [
        pytest.approx((0, 1), abs=0.1),
        pytest.approx((20, 1), abs=0.1),
    ]


def test_a_corner_is_where_the_middle_lines_cross() -> None:
    (line,) = centre_lines(CORRIDOR | box(18, 0, 20, 15))

    corner = line.points[1]
    assert len(line.points) == 3
    assert corner == pytest.approx((19, 1), abs=0.1)


@pytest.mark.parametrize("degrees", [0, 17, 45, 90])
@pytest.mark.parametrize(
    ("floor", "arms"),
    [
        pytest.param(CORRIDOR | BESIDE, 3, id="t junction"),
        pytest.param(CORRIDOR | BESIDE | BEYOND, 4, id="crossing"),
    ],
)
def test_lines_that_meet_share_one_end_in_the_middle(
    floor: Polygon, arms: int, degrees: float
) -> None:
    lines = centre_lines(rotate(floor, degrees, origin=(10, 1)))

    middle = [
        end for line in lines for end in ends(line) if math.dist(end, (10, 1)) < 1
    ]
    assert len(lines) == arms
    assert len(middle) == arms
    assert len(set(middle)) == 1
    assert middle[0] == pytest.approx((10, 1), abs=0.15)


def test_a_line_ends_where_a_hall_begins() -> None:
    (line,) = centre_lines(CORRIDOR | box(20, -8, 40, 12))

    assert ends(line)[0] == pytest.approx((0, 1), abs=0.1)
    assert ends(line)[1] == pytest.approx((20, 1), abs=0.7)


@pytest.mark.parametrize(
    "floor",
    [
        pytest.param(box(0, 0, 9, 9), id="hall"),
        pytest.param(box(0, 0, 4, 5), id="room"),
        pytest.param(box(0, 0, 0.1, 5), id="slit"),
        pytest.param(Polygon([(0, 0), (0.4, 0), (0, 0.4)]), id="speck"),
    ],
)
def test_open_floor_has_no_lines(floor: Polygon) -> None:
    assert centre_lines(floor) == []


@pytest.mark.parametrize(
    "beside",
    [
        pytest.param(box(5, 2, 7, 3), id="niche"),
        pytest.param(box(5, 2, 5.9, 2.2) | box(3, 2.2, 7, 6), id="room with a door"),
        pytest.param(box(5, 2, 5.2, 2.2), id="uneven wall"),
    ],
)
def test_what_lies_beside_a_corridor_leaves_its_line_whole(beside: Polygon) -> None:
    (line,) = centre_lines(CORRIDOR | beside)

    assert ends(line) == [
        pytest.approx((0, 1), abs=0.1),
        pytest.approx((20, 1), abs=0.1),
    ]


def test_a_door_in_a_corridor_does_not_end_it() -> None:
    door = box(10, 0, 10.2, 0.5) | box(10, 1.4, 10.2, 2)

    (line,) = centre_lines(CORRIDOR - door)

    assert ends(line) == [
        pytest.approx((0, 1), abs=0.1),
        pytest.approx((20, 1), abs=0.1),
    ]


def test_a_ring_ends_where_it_begins() -> None:
    (line,) = centre_lines(box(0, 0, 20, 12) - box(2, 2, 18, 10))

    assert line.points[0] == line.points[-1]
    assert LineString(line.points).length == pytest.approx(2 * (18 + 10), rel=0.03)


def test_a_way_that_becomes_twice_as_wide_is_two_lines() -> None:
    lines = centre_lines(CORRIDOR | box(20, -1, 40, 3))

    assert sorted(line.width for line in lines) == pytest.approx([2, 4], abs=0.1)
    assert len({end for line in lines for end in ends(line)}) == 3


def test_every_piece_of_a_floor_is_looked_at() -> None:
    floor = MultiPolygon([CORRIDOR, translate(CORRIDOR, 0, 10)])

    assert len(centre_lines(floor)) == 2


@pytest.mark.parametrize(
    ("name", "share"),
    [("university", 0.93), ("museum_5f", 0.8), ("museum_7f", 0.9)],
)
def test_corridors_of_the_benchmarks_floors_are_found(name: str, share: float) -> None:
    site = load_site(name)

    lines = centre_lines(site.walkable_floor)

    found = union_all([LineString(line.points).buffer(0.6) for line in lines])
    middles = union_all([corridor.centre_line for corridor in site.corridors])
    assert middles.intersection(found).length > share * middles.length
    for line in lines:
        for step in pairwise(line.points):
            assert LineString(step).difference(site.walkable_floor).length < 0.3


def test_a_floor_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="expected a valid floor"):
        centre_lines(Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]))


@st.composite
def any_floors(draw: st.DrawFn) -> Polygon:
    """Return rectangles on and over each other, some cut out, turned by any angle."""
    number = st.integers(0, 60)
    side = st.integers(1, 40)
    parts = draw(
        st.lists(st.tuples(number, number, side, side), min_size=1, max_size=8)
    )
    blocks = draw(st.lists(st.tuples(number, number, side, side), max_size=4))
    floor, cut = (
        union_all([box(x / 2, y / 2, (x + w) / 2, (y + d) / 2) for x, y, w, d in each])
        for each in (parts, blocks)
    )
    return rotate(floor - cut, draw(st.integers(0, 90)), origin=(0, 0))


@given(any_floors())
def test_lines_on_any_floor_lie_on_it(floor: Polygon) -> None:
    if floor.is_empty:
        return
    around = floor.buffer(0.3)

    for line in centre_lines(floor):
        assert len(set(line.points)) > 1
        assert 0 < line.width <= 8.5
        assert around.covers(LineString(line.points))
