import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Polygon
from shapely.affinity import rotate

from memorymaze.sites import Site
from memorymaze.sites.centre_lines import corridor_centre_line


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


def test_a_centre_line_runs_down_the_middle_of_every_corridor(
    builtin_sites: dict[str, Site],
):
    for site in builtin_sites.values():
        for corridor in site.corridors:
            middle = corridor.centre_line.interpolate(0.5, normalized=True)
            assert corridor.polygon.contains(middle), corridor.id
            assert corridor.length >= corridor.width * 0.9, corridor.id


def test_a_shape_with_other_than_four_corners_has_no_centre_line():
    with pytest.raises(ValueError, match="4 corners, got 3"):
        corridor_centre_line(Polygon([(0, 0), (1, 0), (0, 1)]))
