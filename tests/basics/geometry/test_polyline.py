import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from memorymaze.basics.geometry import polyline

L_SHAPE = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)]

coordinates = st.floats(-100, 100).map(lambda x: round(x, 3))
lines = st.integers(1, 8).flatmap(
    lambda count: arrays(np.float64, (count, 2), elements=coordinates)
)


@pytest.mark.parametrize(
    ("s", "point"),
    [(0, (0, 0)), (1.5, (1.5, 0)), (4, (4, 0)), (5, (4, 1)), (7, (4, 3))],
)
def test_points_lie_at_their_arc_length(s: float, point: tuple[float, float]) -> None:
    assert polyline.point_at(L_SHAPE, s).tolist() == list(point)


@pytest.mark.parametrize("s", [-0.1, 7.1, float("nan")])
def test_beyond_the_ends_there_is_no_point(s: float) -> None:
    with pytest.raises(ValueError, match="from 0 to 7 m"):
        polyline.point_at(L_SHAPE, s)


def test_vertices_that_repeat_add_no_length() -> None:
    twice = [(0, 0), (0, 0), (4, 0), (4, 0), (4, 3)]
    assert polyline.length(twice) == 7
    assert polyline.point_at(twice, 4).tolist() == [4, 0]


@pytest.mark.parametrize(
    ("p", "s", "distance"),
    [
        pytest.param((1, 2), 1, 2, id="beside"),
        pytest.param((-3, 4), 0, 5, id="before the start"),
        pytest.param((4, 9), 7, 6, id="after the end"),
        pytest.param((5, -1), 4, np.sqrt(2), id="outside the corner"),
        pytest.param((3, 1), 3, 1, id="as near to both pieces"),
    ],
)
def test_projection_finds_the_nearest_place(
    p: tuple[float, float], s: float, distance: float
) -> None:
    found = polyline.project(L_SHAPE, p)
    assert found == pytest.approx((s, distance))


@given(lines, st.tuples(coordinates, coordinates))
def test_no_sample_is_nearer_than_the_projection(
    line: np.ndarray, p: tuple[float, float]
) -> None:
    s, distance = polyline.project(line, p)
    there = polyline.point_at(line, s)
    assert np.hypot(*(there - p)) == pytest.approx(distance, abs=1e-6)
    samples = polyline.resample(line, 1.0)
    assert np.hypot(*(samples - p).T).min() >= distance - 1e-6


@given(lines, st.floats(0.5, 50))
def test_samples_keep_ends_stay_on_the_line_and_lie_close_enough(
    line: np.ndarray, spacing: float
) -> None:
    samples = polyline.resample(line, spacing)
    assert samples[0].tolist() == line[0].tolist()
    if polyline.length(line) > 0:
        assert samples[-1].tolist() == line[-1].tolist()
    assert np.hypot(*np.diff(samples, axis=0).T).max(initial=0) <= spacing * (1 + 1e-6)
    assert polyline.length(samples) <= polyline.length(line) * (1 + 1e-9)
    assert all(polyline.project(line, each).distance < 1e-6 for each in samples[:20])


def test_a_line_that_divides_evenly_has_no_extra_sample() -> None:
    assert len(polyline.resample([(0, 0), (3 * 0.1, 0)], 0.1)) == 4


def test_a_line_of_no_length_has_one_sample() -> None:
    assert polyline.resample([(1, 2), (1, 2)], 0.5).tolist() == [[1, 2]]


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([], r"shape \(0,\)"),
        ([(1, 2, 3)], r"shape \(1, 3\)"),
        ([(0, 0), (float("nan"), 1)], "index 1"),
        ([(0, 0), (float("inf"), 1)], "index 1"),
    ],
)
def test_what_is_no_line_is_refused(points: list[object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        polyline.length(points)


@pytest.mark.parametrize("spacing", [0, -1, float("nan"), float("inf")])
def test_a_spacing_without_meaning_is_refused(spacing: float) -> None:
    with pytest.raises(ValueError, match="spacing"):
        polyline.resample(L_SHAPE, spacing)


def test_only_one_finite_point_can_be_projected() -> None:
    with pytest.raises(ValueError, match="one finite point"):
        polyline.project(L_SHAPE, (float("nan"), 0))


def test_smoothing_rounds_a_corner_and_keeps_both_ends() -> None:
    corner = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)])

    smooth = polyline.smoothed_rows(corner, 3)

    assert smooth[[0, 2]].tolist() == corner[[0, 2]].tolist()
    assert 0.5 < smooth[1, 0] < 1.0
    assert corner[1].tolist() == [1.0, 0.0]


def test_normals_are_unit_vectors_to_the_left() -> None:
    north = polyline.left_normals(np.array([(2.0, 0.0), (2.0, 1.0), (2.0, 5.0)]))

    assert north == pytest.approx(np.array([(-1.0, 0.0)] * 3))
