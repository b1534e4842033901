import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import Polygon

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.grid import FloorGrid

ROOT = np.sqrt(2)


def node(grid: FloorGrid, x: float, y: float) -> int:
    [found] = grid.map_points([(x, y)])
    assert grid.centres[found].tolist() == [x, y]
    return int(found)


def test_centres_lie_on_multiples_of_the_cell_and_on_the_floor() -> None:
    grid = FloorGrid.from_polygon(shapely.box(0.1, 0.1, 1.6, 0.9))
    assert grid.centres.tolist() == [[0.5, 0.5], [1.0, 0.5], [1.5, 0.5]]


def test_a_floor_with_too_many_cells_is_refused_before_they_are_made() -> None:
    hall = shapely.box(0, 0, 1900, 1900)
    with pytest.raises(ValueError, match=r"at most 50,000 m² .* got 3,610,000 m²"):
        FloorGrid.from_polygon(hall)


def test_neighbours_are_joined_in_eight_directions() -> None:
    grid = FloorGrid.from_polygon(shapely.box(0, 0, 1, 1))
    middle = node(grid, 0.5, 0.5)
    steps = grid.graph[[middle]].toarray()[0]
    assert sorted(steps[steps > 0]) == pytest.approx([0.5] * 4 + [0.5 * ROOT] * 4)


def test_no_corner_is_cut() -> None:
    floor = shapely.box(0, 0, 1, 1) - shapely.box(0.4, -0.1, 1.1, 0.1)
    grid = FloorGrid.from_polygon(floor)
    start, end = node(grid, 0, 0), node(grid, 0.5, 0.5)
    assert grid.between([start], [end])[0, 0] == 1.0


def test_a_wall_thinner_than_a_cell_is_not_walked_through(
    screen_grid: FloorGrid,
) -> None:
    west, east = node(screen_grid, 5, 4), node(screen_grid, 5.5, 4)
    assert screen_grid.between([west], [east])[0, 0] == pytest.approx(4.5)


def test_only_the_largest_connected_piece_is_kept() -> None:
    pieces = shapely.union_all([shapely.box(0, 0, 4, 4), shapely.box(9, 0, 10, 1)])
    grid = FloorGrid.from_polygon(pieces)
    assert grid.centres[:, 0].max() == 4.0
    with pytest.raises(UndefinedMetricError, match="nearest cell of the main floor"):
        grid.map_points([(9.5, 0.5)])


def test_a_point_goes_to_the_nearest_node_that_no_wall_hides(
    screen_grid: FloorGrid,
) -> None:
    """At (5.35, 4.05) the node at 5.5 is nearer; at 5.19 the node at 5 is."""
    east, west = screen_grid.map_points([(5.35, 4.05), (5.19, 4.05)])
    assert screen_grid.centres[[east, west]].tolist() == [[5.5, 4], [5.0, 4]]


def test_a_nearer_node_behind_a_wall_is_passed_over() -> None:
    floor = shapely.box(0, 0, 10, 6) - shapely.box(5.35, 2, 5.4, 6)
    grid = FloorGrid.from_polygon(floor)
    [found] = grid.map_points([(5.34, 4.0)])
    assert grid.centres[found].tolist() == [5.0, 4.0]


@pytest.mark.parametrize(
    ("path", "nodes"),
    [
        pytest.param([(1, 1)], [(1, 1)], id="one place"),
        pytest.param(
            [(0, 0.1), (1.5, 0.1)], [(0, 0), (0.5, 0), (1, 0), (1.5, 0)], id="straight"
        ),
        pytest.param(
            [(0, 0), (1, 1)], [(0, 0), (0.5, 0.5), (1, 1)], id="diagonal without steps"
        ),
        pytest.param(
            [(1, 1), (1, 1), (1.1, 1), (1, 1)], [(1, 1)], id="repeats removed"
        ),
    ],
)
def test_paths_are_mapped_as_drawn_by_hand(
    pillar_grid: FloorGrid,
    path: list[tuple[float, float]],
    nodes: list[tuple[float, float]],
) -> None:
    found = pillar_grid.centres[pillar_grid.map_path(path)]
    assert found.tolist() == [list(place) for place in nodes]


def test_a_path_there_and_back_passes_its_nodes_twice(pillar_grid: FloorGrid) -> None:
    nodes = pillar_grid.map_path([(0, 0), (2, 0), (0, 0)])
    assert nodes.tolist() == nodes[::-1].tolist()
    assert len(nodes) == 9


@given(st.floats(0, 2 * np.pi), st.floats(0.5, 2.4))
def test_a_straight_path_grows_by_at_most_a_tenth_and_a_cell(
    angle: float, length: float
) -> None:
    grid = OPEN_GRID
    end = 2.5 + length * np.array([np.cos(angle), np.sin(angle)])
    nodes = grid.map_path([(2.5, 2.5), end])
    assert grid.along(nodes).sum() <= 1.1 * length + 0.5 * ROOT


OPEN_GRID = FloorGrid.from_polygon(shapely.box(0, 0, 5, 5))


def test_a_path_through_the_wall_far_from_the_floor_is_an_error(
    pillar_grid: FloorGrid,
) -> None:
    with pytest.raises(UndefinedMetricError, match="off the floor"):
        pillar_grid.map_path([(1, 5), (9, 5)])


def test_a_path_off_the_floor_within_the_tolerance_is_mapped(
    pillar_grid: FloorGrid,
) -> None:
    nodes = pillar_grid.map_path([(0, -0.4), (2, -0.4)])
    assert pillar_grid.centres[nodes][:, 1].tolist() == [0.0] * 5


def test_an_empty_path_has_no_nodes_to_give(pillar_grid: FloorGrid) -> None:
    with pytest.raises(UndefinedMetricError, match="at least one point"):
        pillar_grid.map_path(np.empty((0, 2)))


def test_distances_between_nodes_are_a_metric_above_the_straight_line(
    pillar_grid: FloorGrid,
) -> None:
    every = np.arange(0, len(pillar_grid), 7)
    table = pillar_grid.between(every, every)
    places = pillar_grid.centres[every]
    straight = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
    np.testing.assert_allclose(table, table.T, atol=1e-12)
    assert (np.diag(table) == 0).all()
    assert (table >= straight - 1e-12).all()
    assert (table[:, None] <= table[:, :, None] + table[None] + 1e-12).all()


def test_steps_along_a_path_need_not_join_neighbours(pillar_grid: FloorGrid) -> None:
    far = [node(pillar_grid, *place) for place in [(0, 0), (0.5, 0.5), (10, 0.5)]]
    far.append(far[-1])
    assert pillar_grid.along(far) == pytest.approx([0.5 * ROOT, 9.5, 0])
    assert pillar_grid.along(far[:1]).tolist() == []


@pytest.mark.parametrize("nodes", [[-1], [0, 10_000]])
def test_a_node_outside_the_grid_is_refused(
    pillar_grid: FloorGrid, nodes: list[int]
) -> None:
    with pytest.raises(UndefinedMetricError, match="expected nodes from 0 to"):
        pillar_grid.distances_from(nodes)


def test_node_ids_are_whole_numbers(pillar_grid: FloorGrid) -> None:
    with pytest.raises(ValueError, match="node ids"):
        pillar_grid.distances_from([0.5])


def test_the_distance_between_points_is_not_rounded_to_cells(
    pillar_grid: FloorGrid,
) -> None:
    assert pillar_grid.distance((0.1, 1.13), (2.3, 2.07)) == pytest.approx(
        np.hypot(2.2, 0.94)
    )


def test_the_length_of_a_path_on_the_grid_is_near_its_own(
    pillar_grid: FloorGrid,
) -> None:
    around = [(1.5, 1.5), (8.5, 1.5), (8.5, 8.5), (1.5, 8.5), (1.5, 1.5)]
    mapped = pillar_grid.along(pillar_grid.map_path(around)).sum()
    assert mapped == pytest.approx(polyline.length(around))


def test_a_floor_too_small_for_any_cell_is_refused() -> None:
    with pytest.raises(ValueError, match=r"no centre of a 0\.5 m cell"):
        FloorGrid.from_polygon(shapely.box(0.1, 0.1, 0.4, 0.4))


@pytest.mark.parametrize("cell", [0, -0.5, float("nan")])
def test_a_cell_size_without_meaning_is_refused(u_floor: Polygon, cell: float) -> None:
    with pytest.raises(ValueError, match="cell size"):
        FloorGrid.from_polygon(u_floor, cell)
