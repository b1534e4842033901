import pytest
from shapely import box

from memorymaze.errors import SitePlanError
from memorymaze.sites.floor import floor_pieces, union_of_floor


def test_parts_that_share_an_edge_become_one_floor():
    assert union_of_floor([box(0, 0, 4, 2), box(4, 0, 8, 2)]).area == pytest.approx(16)


def test_a_seam_open_by_a_millimetre_is_closed():
    floor = union_of_floor([box(0, 0, 4, 2), box(4.001, 0, 8, 2)])
    assert floor.area == pytest.approx(16, abs=0.01)
    assert len(floor.exterior.coords) == 5


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
