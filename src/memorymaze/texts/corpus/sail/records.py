"""What the SAIL corpus holds: mazes of square cells, and paragraphs about them.

Both are checked here, whatever files they come from.
"""

from collections import Counter
from dataclasses import dataclass
from functools import cached_property

from memorymaze.basics.errors import InstructionFileError

MazeCell = tuple[int, int]
"""Column and row of a node; columns grow east, rows grow SOUTH."""


@dataclass(frozen=True, slots=True)
class MazeNode:
    """A place where one can stand and turn."""

    cell: MazeCell
    thing: str | None
    """The piece of furniture that stands there, such as `easel`."""


@dataclass(frozen=True, slots=True)
class MazeHall:
    """A way between two neighbouring nodes, of length 1."""

    ends: tuple[MazeCell, MazeCell]
    floor: str
    """Such as `brick`."""
    wall: str
    """What the pictures on its walls show, such as `fish`."""


@dataclass(frozen=True)
class Maze:
    """One map."""

    name: str
    nodes: tuple[MazeNode, ...]
    halls: tuple[MazeHall, ...]
    positions: dict[int, MazeCell]
    """The numbered starts and goals; nothing in the maze shows them."""

    @cached_property
    def neighbours(self) -> dict[MazeCell, list[MazeCell]]:
        """Cells one can walk to from each, in the order east, south, west, north."""
        found: dict[MazeCell, list[MazeCell]] = {node.cell: [] for node in self.nodes}
        for hall in self.halls:
            first, second = hall.ends
            found[first].append(second)
            found[second].append(first)
        for (x, y), cells in found.items():
            steps = [(x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)]
            cells.sort(key=steps.index)
        return found

    def shortest_way(self, start: MazeCell, goal: MazeCell) -> list[MazeCell] | None:
        """Return the cells of a shortest walk, both ends included; None without one."""
        came_from: dict[MazeCell, MazeCell] = {start: start}
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
    start: MazeCell
    goal: MazeCell
    text: str
    """Lower case; sentences with ` . ` between them."""
    usable: bool
    """Whether the corpus has a legal path for it from start to goal."""
    followers: int | None
    """People who tried to follow it; None where the corpus does not tell."""
    arrived: int | None
    """Of these those who reached the goal."""


@dataclass(frozen=True, slots=True)
class MazeTexts:
    """All that was read of a folder."""

    mazes: dict[str, Maze]
    paragraphs: tuple[Paragraph, ...]
    files: tuple[str, ...]
    """Paths of the files it was read from: mazes first, then paragraphs."""


def check_texts(texts: MazeTexts) -> None:
    """Check all that later steps rely on.

    Raises:
        InstructionFileError: Something is wrong; names map or paragraph.
    """
    for maze in texts.mazes.values():
        _check_maze(maze, texts.files[0])
    place = texts.files[-1]
    if not texts.paragraphs:
        raise InstructionFileError(f"{place}: expected instructions, got none")
    ids = Counter(each.id for each in texts.paragraphs)
    for paragraph in texts.paragraphs:
        _check_paragraph(paragraph, texts, place)
        if ids[paragraph.id] > 1:
            raise InstructionFileError(
                f"{place}: {paragraph.id}: expected an id once, got it twice"
            )


def _check_maze(maze: Maze, place: str) -> None:
    def refuse(message: str) -> InstructionFileError:
        return InstructionFileError(f"{place}: map {maze.name}: {message}")

    if not maze.name.isidentifier():
        raise refuse("expected a name of letters, digits and underscores")
    cells = Counter(node.cell for node in maze.nodes)
    if not maze.halls:
        raise refuse("expected edges, got none")
    for cell, count in cells.items():
        if count > 1:
            raise refuse(f"node {list(cell)} is there twice")
    seen: set[frozenset[tuple[int, int]]] = set()
    for hall in maze.halls:
        (ax, ay), (bx, by) = hall.ends
        if abs(ax - bx) + abs(ay - by) != 1:
            raise refuse(
                f"edge {[ax, ay]} to {[bx, by]}: expected neighbouring nodes in one "
                "row or column"
            )
        for end in hall.ends:
            if end not in cells:
                raise refuse(f"edge {[ax, ay]} to {[bx, by]}: no node {list(end)}")
        if frozenset(hall.ends) in seen:
            raise refuse(f"edge {[ax, ay]} to {[bx, by]} is there twice")
        seen.add(frozenset(hall.ends))
    first = maze.nodes[0].cell
    for cell in cells:
        if maze.shortest_way(first, cell) is None:
            raise refuse(f"no way from node {list(first)} to node {list(cell)}")
    for number, cell in maze.positions.items():
        if cell not in cells:
            raise refuse(f"position {number}: no node {list(cell)}")


def _check_paragraph(paragraph: Paragraph, texts: MazeTexts, place: str) -> None:
    def refuse(message: str) -> InstructionFileError:
        return InstructionFileError(f"{place}: {paragraph.id}: {message}")

    maze = texts.mazes.get(paragraph.maze)
    if maze is None:
        known = ", ".join(sorted(texts.mazes)) or "none"
        raise refuse(f"expected one of the maps {known}, got {paragraph.maze!r}")
    for name, number, cell in (
        ("start", paragraph.start_position, paragraph.start),
        ("goal", paragraph.goal_position, paragraph.goal),
    ):
        if maze.positions.get(number) != cell:
            raise refuse(
                f"{name} {list(cell)}: expected the place of position {number} of map "
                f"{maze.name}"
            )
    if paragraph.start == paragraph.goal:
        raise refuse("expected a goal other than the start")
    if (paragraph.followers is None) != (paragraph.arrived is None) or (
        (paragraph.arrived or 0) > (paragraph.followers or 0)
    ):
        raise refuse("expected at most as many followers who arrived as tried")
