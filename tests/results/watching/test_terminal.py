from dataclasses import replace
from io import BytesIO, StringIO, TextIOWrapper

import pytest
from rich.console import Console

from memorymaze.drawing.cells import Extent, cell_map
from memorymaze.geometry.pose import Pose
from memorymaze.results.watching import Present
from memorymaze.results.watching.terminal import ASCII, TerminalMap, TerminalView
from memorymaze.sites import Site


def drawn(plan: TerminalMap, present: Present, columns: int = 60) -> list[str]:
    """Return the lines of a map without colours."""
    lines = plan.draw(present, columns, 24)
    return ["".join(piece.text for piece in line) for line in lines]


def place_of(sign: str, lines: list[str]) -> tuple[int, int]:
    [found] = [(r, line.index(sign)) for r, line in enumerate(lines) if sign in line]
    return found


def test_robot_start_goal_and_people_are_told_without_colours(
    t_site: Site, present: Present
) -> None:
    lines = drawn(TerminalMap(t_site, t_site.reference_route("R1")), present)
    assert all(len(line) == 60 for line in lines)
    robot, start, goal, person = (place_of(sign, lines) for sign in "↑SGo")
    assert start[0] > robot[0] > person[0] >= goal[0]
    assert start[1] == robot[1] == person[1]
    assert goal[1] < robot[1]
    assert any("•" in line for line in lines)
    assert any("·" in line for line in lines)


@pytest.mark.parametrize(
    ("heading", "arrow"), [(0.0, "→"), (1.6, "↑"), (3.1, "←"), (-0.8, "↘")]
)
def test_the_robot_is_an_arrow_that_points_where_it_looks(
    t_site: Site, present: Present, heading: float, arrow: str
) -> None:
    turned = replace(present, pose=Pose(0.0, -5.0, heading))
    lines = drawn(TerminalMap(t_site, t_site.reference_route("R1")), turned)
    assert sum(line.count(arrow) for line in lines) == 1


def test_a_robot_that_leaves_the_part_shown_is_not_lost(
    loop_site: Site, present: Present
) -> None:
    west, south, east, north = loop_site.walkable_floor.bounds
    plan = TerminalMap(loop_site, loop_site.reference_route("R1"))
    for corner in ((west, south), (east, south), (east, north), (west, north)):
        there = replace(present, pose=Pose(*corner, 0.0))
        assert any("→" in line for line in drawn(plan, there))


def test_corridors_stay_open_however_small_the_map(t_site: Site) -> None:
    west, south, east, north = t_site.walkable_floor.bounds
    cells = cell_map(t_site, Extent(west, south, east, north), 8, 4)
    for corridor in t_site.corridors:
        x, y = corridor.centre_line.centroid.coords[0]
        row, column = cells.cell(x, y)
        assert not cells.solid[2 * row : 2 * row + 2, column].all()


def test_terminals_without_unicode_get_a_map_they_can_show(
    t_site: Site, present: Present
) -> None:
    plan = TerminalMap(t_site, t_site.reference_route("R1"), ASCII)
    text = "\n".join([*drawn(plan, present), plan.legend()])
    assert text.isascii()
    assert "^" in text
    stream = TextIOWrapper(BytesIO(), encoding="ascii", errors="strict")
    console = Console(file=stream, width=90, height=30, force_terminal=True)
    view = TerminalView(t_site, t_site.reference_route("R1"), "Go.", "A", console)
    console.print(view.page(present))


@pytest.mark.parametrize(("width", "height"), [(80, 24), (200, 60), (40, 12)])
def test_the_page_fits_the_terminal(
    t_site: Site, present: Present, width: int, height: int
) -> None:
    console = Console(file=StringIO(), width=width, height=height, color_system=None)
    view = TerminalView(t_site, t_site.reference_route("R1"), "Go.", "A walk", console)
    console.print(view.page(present), end="")
    lines = console.file.getvalue().splitlines()  # type: ignore[attr-defined]
    assert len(lines) <= height
    assert all(len(line) <= width for line in lines)
