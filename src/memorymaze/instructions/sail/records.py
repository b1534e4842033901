"""What the SAIL corpus holds: mazes of square cells, and paragraphs about them."""

from dataclasses import dataclass
from functools import cached_property

Cell = tuple[int, int]
"""Column and row of a node; columns grow east, rows grow SOUTH."""


@dataclass(frozen=True, slots=True)
class Node:
    """A place where one can stand and turn."""

    cell: Cell
    thing: str | None
    """The piece of furniture that stands there, such as `easel`."""


@dataclass(frozen=True, slots=True)
class Hall:
    """A way between two neighbouring nodes, of length 1."""

    ends: tuple[Cell, Cell]
    floor: str
    """Such as `brick`."""
    wall: str
    """What the pictures on its walls show, such as `fish`."""


@dataclass(frozen=True)
class Maze:
    """One map."""

    name: str
    nodes: tuple[Node, ...]
    halls: tuple[Hall, ...]
    positions: dict[int, Cell]
    """The numbered starts and goals; nothing in the maze shows them."""

    @cached_property
    def neighbours(self) -> dict[Cell, list[Cell]]:
        """Cells one can walk to from each, in the order east, south, west, north."""
        found: dict[Cell, list[Cell]] = {node.cell: [] for node in self.nodes}
        for hall in self.halls:
            first, second = hall.ends
            found[first].append(second)
            found[second].append(first)
        for (x, y), cells in found.items():
            steps = [(x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)]
            cells.sort(key=steps.index)
        return found

    def shortest_way(self, start: Cell, goal: Cell) -> list[Cell] | None:
        """Return the cells of a shortest walk, both ends included; None without one."""
        came_from: dict[Cell, Cell] = {start: start}
        queue = [start]
        for cell in queue:
            for following in self.neighbours[cell]:
                if following not in came_from:
                    came_from[following] = cell
                    queue.append(following)
        if goal not in came_from:
            return None
        way = [goal]
        while way[-1] != start:
            way.append(came_from[way[-1]])
        return way[::-1]


@dataclass(frozen=True, slots=True)
class Paragraph:
    """One person's instruction from one position to another."""

    id: str
    """WRITER-MAP-START-GOAL-VERSION."""
    maze: str
    writer: str
    start_position: int
    goal_position: int
    start: Cell
    goal: Cell
    text: str
    """Lower case; sentences with ` . ` between them."""
    usable: bool
    """Whether the corpus has a legal path for it from start to goal."""
    followers: int | None
    """People who tried to follow it; None where the corpus does not tell."""
    arrived: int | None
    """Of these those who reached the goal."""


@dataclass(frozen=True, slots=True)
class Corpus:
    """All that was read of a folder."""

    mazes: dict[str, Maze]
    paragraphs: tuple[Paragraph, ...]
    files: tuple[str, ...]
    """Paths of the files it was read from: mazes first, then paragraphs."""
