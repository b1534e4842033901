"""Reading SAIL from a folder, in either of its two layouts.

`maps.json` with `instructions.jsonl`; or the XML files of the original distribution:
`maps/map-NAME.xml`: `<map name="Grid"><nodes><node x="0" y="5" item="hatrack"/>…
</nodes><edges><edge node1="0,5" node2="0,6" floor="blue" wall="fish"/>…</edges></map>`,
and `data/Paragraph.xml`: `<example file="Cleaned-EDA_Grid0_1_2_Dirs_1.txt" map="Grid">
<instruction>…</instruction><path>[(1, 6, -1), (1, 6, 180), …]</path></example>`, sentences
ended by full stops. The latter tells nothing about followers.
"""

import re
from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Annotated, NamedTuple, TypeVar
from xml.etree import ElementTree

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from memorymaze.basics.errors import InstructionFileError
from memorymaze.basics.input_files import mistakes, read_file, read_text
from memorymaze.texts.corpus.sail.records import (
    Maze,
    MazeCell,
    MazeHall,
    MazeNode,
    MazeTexts,
    Paragraph,
    check_texts,
)

_Read = TypeVar("_Read")

MAZES, PARAGRAPHS = "maps.json", "instructions.jsonl"

_FILE = re.compile(r"([A-Za-z]+)_[A-Za-z]+\d*_(\d+)_(\d+)_Dirs_(\d+)")
_POSE = re.compile(r"\(\s*(-?\d+)\s*,\s*(-?\d+)\s*,\s*-?\d+\s*\)")
_CELL = re.compile(r"\s*(-?\d+)\s*,\s*(-?\d+)\s*")

_Word = Annotated[str, Field(min_length=1)]


class _Strict(BaseModel):
    model_config = ConfigDict(strict=True, frozen=True, extra="ignore")


class _Node(_Strict):
    x: int
    y: int
    object: _Word | None


class _Edge(_Strict):
    a: tuple[int, int]
    b: tuple[int, int]
    floor: _Word
    wall: _Word


class _Map(_Strict):
    nodes: list[_Node]
    edges: list[_Edge]
    positions: dict[str, tuple[int, int]]


class _Maps(_Strict):
    maps: dict[str, _Map]


class _Line(_Strict):
    id: _Word
    map: _Word
    writer: _Word
    start_position: int
    goal_position: int
    start_pose: tuple[int, int, int | None]
    goal: tuple[int, int]
    text: _Word
    usable: bool
    human_trials: Annotated[int, Field(ge=0)] | None = None
    human_found: Annotated[int, Field(ge=0)] | None = None


def is_sail_folder(folder: Path) -> bool:
    """Tell whether a folder looks like one of SAIL, in either layout."""
    return (folder / MAZES).exists() or _has_original_layout(folder)


def _has_original_layout(folder: Path) -> bool:
    return (folder / "data" / "Paragraph.xml").exists() and (folder / "maps").is_dir()


def load_sail(folder: str | Path) -> MazeTexts:
    """Read mazes and paragraphs, and check that they fit together.

    Args:
        folder: Holds `maps.json` and `instructions.jsonl`, or the original
            distribution's `maps/*.xml` and `data/Paragraph.xml`.

    Raises:
        InstructionFileError: It does not, or something in it is wrong; names the
            first fault's file and place.
    """
    folder = Path(folder)
    if (folder / MAZES).exists():
        texts = MazeTexts(
            _mazes(folder / MAZES),
            _paragraphs(folder / PARAGRAPHS),
            (str(folder / MAZES), str(folder / PARAGRAPHS)),
        )
    elif _has_original_layout(folder):
        texts = _read_original_layout(folder)
    else:
        what = "there is no such folder" if not folder.is_dir() else "it has neither"
        raise InstructionFileError(
            f"{folder}: expected {MAZES} and {PARAGRAPHS}, or maps/*.xml and "
            f"data/Paragraph.xml of the SAIL corpus; {what} (see docs/texts.md)"
        )
    check_texts(texts)
    return texts


def _mazes(path: Path) -> dict[str, Maze]:
    text = read_text(path, InstructionFileError)
    read = _valid(TypeAdapter(_Maps).validate_json, text, str(path))
    return {name: _maze(name, each, path) for name, each in read.maps.items()}


def _maze(name: str, read: _Map, path: Path) -> Maze:
    positions: dict[int, MazeCell] = {}
    for number, cell in read.positions.items():
        if not number.isdecimal():
            raise InstructionFileError(
                f"{path}: map {name}: positions: expected whole numbers as names, got "
                f"{number!r}"
            )
        positions[int(number)] = cell
    return Maze(
        name,
        tuple(MazeNode((node.x, node.y), node.object) for node in read.nodes),
        tuple(MazeHall((edge.a, edge.b), edge.floor, edge.wall) for edge in read.edges),
        positions,
    )


def _paragraphs(path: Path) -> tuple[Paragraph, ...]:
    adapter = TypeAdapter(_Line)
    paragraphs: list[Paragraph] = []
    text = read_text(path, InstructionFileError)
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip():
            continue
        read = _valid(adapter.validate_json, line, f"{path}:{number}")
        paragraphs.append(
            Paragraph(
                id=read.id,
                maze=read.map,
                writer=read.writer,
                start_position=read.start_position,
                goal_position=read.goal_position,
                start=read.start_pose[:2],
                goal=read.goal,
                text=read.text,
                usable=read.usable,
                followers=read.human_trials,
                arrived=read.human_found,
            )
        )
    return tuple(paragraphs)


def _valid(read: Callable[[str], _Read], text: str, place: str) -> _Read:
    try:
        return read(text)
    except ValidationError as error:
        where, said = next(mistakes(error))
        raise InstructionFileError(f"{place}: {where or 'the whole'}: {said}") from None


def _read_original_layout(folder: Path) -> MazeTexts:
    """Read the original distribution.

    A position is where most paths from or to it begin or end. A path along edges from
    the start to the goal makes a paragraph usable. Paragraphs from or to a position
    that no path tells are left out.
    """
    files = sorted((folder / "maps").glob("*.xml"))
    if not files:
        raise InstructionFileError(f"{folder / 'maps'}: expected *.xml, got none")
    mazes = {maze.name: maze for maze in map(_original_maze, files)}
    source = folder / "data" / "Paragraph.xml"
    examples = _root(source).findall("example")
    read = [_example(each, mazes, source) for each in examples]
    votes: dict[tuple[str, int], Counter[MazeCell]] = {}
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
    return MazeTexts(mazes, kept, (*map(str, files), str(source)))


def _root(path: Path) -> ElementTree.Element:
    try:
        return ElementTree.fromstring(read_file(path, InstructionFileError))
    except ElementTree.ParseError as error:
        raise InstructionFileError(f"{path}: cannot be read as XML ({error})") from None


def _original_maze(path: Path) -> Maze:
    root = _root(path)
    nodes = [
        MazeNode(
            _cell(f"{node.get('x')},{node.get('y')}", path),
            node.get("item") or None,
        )
        for node in root.iterfind("nodes/node")
    ]
    halls = [
        MazeHall(
            (_cell(edge.get("node1"), path), _cell(edge.get("node2"), path)),
            edge.get("floor") or "unknown",
            edge.get("wall") or "unknown",
        )
        for edge in root.iterfind("edges/edge")
    ]
    return Maze(root.get("name") or path.stem, tuple(nodes), tuple(halls), {})


def _cell(text: str | None, path: Path) -> MazeCell:
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
    cells: list[MazeCell]


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


def _is_legal(cells: list[MazeCell], maze: Maze) -> bool:
    return all(
        here == there or there in maze.neighbours.get(here, ())
        for here, there in pairwise(cells)
    )
