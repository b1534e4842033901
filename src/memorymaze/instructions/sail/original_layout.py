"""The XML layout of the original distribution.

`maps/map-NAME.xml`: `<map name="Grid"><nodes><node x="0" y="5" item="hatrack"/>…
</nodes><edges><edge node1="0,5" node2="0,6" floor="blue" wall="fish"/>…</edges></map>`.
`data/Paragraph.xml`: `<example file="Cleaned-EDA_Grid0_1_2_Dirs_1.txt" map="Grid">
<instruction>…</instruction><path>[(1, 6, -1), (1, 6, 180), …]</path></example>`, sentences
ended by full stops. It tells nothing about followers.
"""

import re
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.sail.records import (
    Cell,
    Corpus,
    Hall,
    Maze,
    Node,
    Paragraph,
)

_FILE = re.compile(r"([A-Za-z]+)_[A-Za-z]+\d*_(\d+)_(\d+)_Dirs_(\d+)")
_POSE = re.compile(r"\(\s*(-?\d+)\s*,\s*(-?\d+)\s*,\s*-?\d+\s*\)")
_CELL = re.compile(r"\s*(-?\d+)\s*,\s*(-?\d+)\s*")


def has_original_layout(folder: Path) -> bool:
    """Tell whether a folder looks like the original distribution."""
    return (folder / "data" / "Paragraph.xml").exists() and (folder / "maps").is_dir()


def read_original_layout(folder: Path) -> Corpus:
    """Read the original distribution; what is in its files is not yet checked.

    A position is where most paths from or to it begin or end. A path along edges from
    the start to the goal makes a paragraph usable. Paragraphs from or to a position
    that no path tells are left out.

    Raises:
        InstructionFileError: A file cannot be read; names it and the place.
    """
    files = sorted((folder / "maps").glob("*.xml"))
    if not files:
        raise InstructionFileError(f"{folder / 'maps'}: expected *.xml, got none")
    mazes = {maze.name: maze for maze in map(_maze, files)}
    source = folder / "data" / "Paragraph.xml"
    examples = _root(source).findall("example")
    read = [_example(each, mazes, source) for each in examples]
    votes: dict[tuple[str, int], Counter[Cell]] = {}
    for each in read:
        if each.cells:
            for number, cell in (
                (each.start, each.cells[0]),
                (each.goal, each.cells[-1]),
            ):
                votes.setdefault((each.maze, number), Counter())[cell] += 1
    for (name, number), cells in sorted(votes.items()):
        mazes[name].positions[number] = cells.most_common(1)[0][0]
    paragraphs = [_paragraph(each, mazes[each.maze]) for each in read]
    kept = tuple(each for each in paragraphs if each is not None)
    return Corpus(mazes, kept, (*map(str, files), str(source)))


def _root(path: Path) -> ElementTree.Element:
    try:
        return ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise InstructionFileError(f"{path}: cannot be read as XML ({error})") from None


def _maze(path: Path) -> Maze:
    root = _root(path)
    nodes = [
        Node(
            _cell(f"{node.get('x')},{node.get('y')}", path),
            node.get("item") or None,
        )
        for node in root.iterfind("nodes/node")
    ]
    halls = [
        Hall(
            (_cell(edge.get("node1"), path), _cell(edge.get("node2"), path)),
            edge.get("floor") or "unknown",
            edge.get("wall") or "unknown",
        )
        for edge in root.iterfind("edges/edge")
    ]
    return Maze(root.get("name") or path.stem, tuple(nodes), tuple(halls), {})


def _cell(text: str | None, path: Path) -> Cell:
    match = _CELL.fullmatch(text or "")
    if match is None:
        raise InstructionFileError(
            f"{path}: expected a node as `x,y` in whole numbers, got {text!r}"
        )
    return int(match[1]), int(match[2])


class _Example(NamedTuple):
    maze: str
    writer: str
    start: int
    goal: int
    version: str
    text: str
    cells: list[Cell]


def _example(
    element: ElementTree.Element, mazes: dict[str, Maze], path: Path
) -> _Example:
    name = element.get("file") or ""
    place = f"{path}: {name or element.get('id') or 'an example'}"
    found = _FILE.search(name)
    if found is None:
        raise InstructionFileError(
            f"{place}: expected a file name such as Cleaned-EDA_Grid0_1_2_Dirs_1.txt"
        )
    maze = element.get("map") or ""
    if maze not in mazes:
        raise InstructionFileError(
            f"{place}: expected one of the maps {', '.join(mazes)}, got {maze!r}"
        )
    writer, start, goal, version = found.groups()
    told = element.findtext("instruction") or ""
    sentences = [" ".join(each.lower().split()) for each in told.split(".")]
    return _Example(
        maze,
        writer,
        int(start),
        int(goal),
        version,
        " . ".join(sentence for sentence in sentences if sentence),
        [(int(x), int(y)) for x, y in _POSE.findall(element.findtext("path") or "")],
    )


def _paragraph(example: _Example, maze: Maze) -> Paragraph | None:
    start = maze.positions.get(example.start)
    goal = maze.positions.get(example.goal)
    if start is None or goal is None or start == goal or not example.text:
        return None
    cells = example.cells
    usable = bool(cells) and (cells[0], cells[-1]) == (start, goal)
    return Paragraph(
        id=f"{example.writer}-{maze.name}-{example.start}-{example.goal}-{example.version}",
        maze=maze.name,
        writer=example.writer,
        start_position=example.start,
        goal_position=example.goal,
        start=start,
        goal=goal,
        text=example.text,
        usable=usable and _is_legal(cells, maze),
        followers=None,
        arrived=None,
    )


def _is_legal(cells: list[Cell], maze: Maze) -> bool:
    return all(
        here == there or there in maze.neighbours.get(here, ())
        for here, there in pairwise(cells)
    )
