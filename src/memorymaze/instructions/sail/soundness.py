"""Whether mazes are mazes, and whether paragraphs speak of them."""

from collections import Counter

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.sail.records import Corpus, Maze, Paragraph


def check_corpus(corpus: Corpus) -> None:
    """Check all that later steps rely on.

    Raises:
        InstructionFileError: Something is wrong; names map or paragraph.
    """
    for maze in corpus.mazes.values():
        _check_maze(maze, corpus.files[0])
    place = corpus.files[-1]
    if not corpus.paragraphs:
        raise InstructionFileError(f"{place}: expected instructions, got none")
    ids = Counter(each.id for each in corpus.paragraphs)
    for paragraph in corpus.paragraphs:
        _check_paragraph(paragraph, corpus, place)
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


def _check_paragraph(paragraph: Paragraph, corpus: Corpus, place: str) -> None:
    def refuse(message: str) -> InstructionFileError:
        return InstructionFileError(f"{place}: {paragraph.id}: {message}")

    maze = corpus.mazes.get(paragraph.maze)
    if maze is None:
        known = ", ".join(sorted(corpus.mazes)) or "none"
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
