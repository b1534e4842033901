"""A plan with a robot on it, drawn with characters.

Solid parts are half blocks, so that a cell shows two; everything that matters has a
character of its own and is told by it also without colours.
"""

import math
from collections.abc import Iterator
from itertools import groupby
from operator import itemgetter
from typing import NamedTuple

from rich.segment import Segment
from rich.style import Style
from shapely import get_coordinates, segmentize

from memorymaze.drawing.cells import (
    CellMap,
    Extent,
    cell_map,
    plan_extent,
)
from memorymaze.results.watching.present import Present
from memorymaze.sites import Route, Site

AROUND = 8.0
"""Metres shown round the way described."""


class Signs(NamedTuple):
    """Characters of a map."""

    blocks: tuple[str, str, str, str]
    """Nothing solid, the upper half, the lower half, both."""
    arrows: str
    """The robot, facing east and on, counter-clockwise in eighths of a turn."""
    walked: str
    way: str
    start: str = "S"
    goal: str = "G"
    person: str = "o"
    thing: str = "x"


UNICODE = Signs((" ", "▀", "▄", "█"), "→↗↑↖←↙↓↘", "•", "·")
ASCII = Signs((" ", "#", "#", "#"), ">/^\\</v\\", "*", ".")
STYLES = {
    name: Style.parse(words)
    for name, words in {
        "solid": "grey42",
        "way": "bold red",
        "walked": "bold cyan",
        "ends": "bold white on red",
        "person": "bold magenta",
        "thing": "bold yellow",
        "robot": "bold black on bright_yellow",
    }.items()
}


class TerminalMap:
    """Draws one episode's plan at any size."""

    def __init__(self, site: Site, route: Route, signs: Signs = UNICODE) -> None:
        """Stand for a plan."""
        self._site, self._signs = site, signs
        west, south, east, north = route.line.bounds
        self._extent = Extent(
            west - AROUND, south - AROUND, east + AROUND, north + AROUND
        )
        self._way = route.line
        self._cells: CellMap | None = None
        self._size = (0, 0)

    def draw(self, present: Present, columns: int, rows: int) -> list[list[Segment]]:
        """Draw how things stand.

        A robot that leaves the part shown makes the whole plan be shown.

        Args:
            present: The episode at this moment.
            columns: Of the terminal, at least 1.
            rows: Of the terminal, at least 1.
        """
        if not self._extent.holds(present.pose.x, present.pose.y):
            self._extent, self._cells = plan_extent(self._site), None
        if self._cells is None or self._size != (columns, rows):
            self._size = (columns, rows)
            self._cells = cell_map(self._site, self._extent, columns, rows)
        marks = dict(self._marks(self._cells, present))
        solid = self._cells.solid
        numbers = (solid[::2] + 2 * solid[1::2]).tolist()
        blocks = self._signs.blocks
        lines: list[list[Segment]] = []
        for row, cells in enumerate(numbers):
            line: list[Segment] = []
            signed = (
                marks.get((row, column), (blocks[number], "solid"))
                for column, number in enumerate(cells)
            )
            # Terminals are slow where every character has a style of its own.
            for style, group in groupby(signed, key=itemgetter(1)):
                text = "".join(sign for sign, _ in group)
                line.append(Segment(text, STYLES[style]))
            lines.append(line)
        return lines

    def legend(self) -> str:
        """Say what the characters mean."""
        signs = self._signs
        return (
            f"{signs.arrows[0]} robot  {signs.walked} driven  {signs.way} way described  "
            f"{signs.start} start  {signs.goal} goal  {signs.person} person  "
            f"{signs.thing} thing in the way"
        )

    def _marks(
        self, cells: CellMap, present: Present
    ) -> Iterator[tuple[tuple[int, int], tuple[str, str]]]:
        """Return sign and name of its style by cell; later ones lie on top."""
        signs = self._signs
        for x, y in get_coordinates(segmentize(self._way, cells.metres)).tolist():
            yield cells.cell(x, y), (signs.way, "way")
        for place in present.path:
            yield cells.cell(*place), (signs.walked, "walked")
        ends = get_coordinates(self._way)[[0, -1]].tolist()
        for (x, y), sign in zip(ends, (signs.start, signs.goal), strict=True):
            yield cells.cell(x, y), (sign, "ends")
        for pose in present.things.values():
            yield cells.cell(pose.x, pose.y), (signs.thing, "thing")
        for pose in present.people.values():
            yield cells.cell(pose.x, pose.y), (signs.person, "person")
        eighth = round(present.pose.heading / (math.pi / 4)) % 8
        robot = signs.arrows[eighth]
        yield cells.cell(present.pose.x, present.pose.y), (robot, "robot")
