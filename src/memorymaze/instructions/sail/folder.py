"""Reading SAIL from a folder, in either of its two layouts.

`maps.json` with `instructions.jsonl`, or the XML files of the original distribution
(`original_layout.py`).
"""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, TypeVar

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.sail.original_layout import (
    has_original_layout,
    read_original_layout,
)
from memorymaze.instructions.sail.records import (
    Cell,
    Corpus,
    Hall,
    Maze,
    Node,
    Paragraph,
)
from memorymaze.instructions.sail.soundness import check_corpus

Read = TypeVar("Read")

MAZES, PARAGRAPHS = "maps.json", "instructions.jsonl"

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


def load_sail(folder: str | Path) -> Corpus:
    """Read mazes and paragraphs, and check that they fit together.

    Args:
        folder: Holds `maps.json` and `instructions.jsonl`, or the original
            distribution's `maps/*.xml` and `data/Paragraph.xml`.

    Raises:
        InstructionFileError: It does not, or something in it is wrong; names the
            first fault's file and place.
    """
    folder = Path(folder)
    if (folder / MAZES).exists() or (folder / PARAGRAPHS).exists():
        corpus = Corpus(
            _mazes(folder / MAZES),
            _paragraphs(folder / PARAGRAPHS),
            (str(folder / MAZES), str(folder / PARAGRAPHS)),
        )
    elif has_original_layout(folder):
        corpus = read_original_layout(folder)
    else:
        what = "there is no such folder" if not folder.is_dir() else "it has neither"
        raise InstructionFileError(
            f"{folder}: expected {MAZES} and {PARAGRAPHS}, or maps/*.xml and "
            f"data/Paragraph.xml of the SAIL corpus; {what} (see docs/sail.md)"
        )
    check_corpus(corpus)
    return corpus


def _mazes(path: Path) -> dict[str, Maze]:
    read = _valid(TypeAdapter(_Maps).validate_json, _text(path), str(path))
    return {name: _maze(name, each, path) for name, each in read.maps.items()}


def _maze(name: str, read: _Map, path: Path) -> Maze:
    positions: dict[int, Cell] = {}
    for number, cell in read.positions.items():
        if not number.isdecimal():
            raise InstructionFileError(
                f"{path}: map {name}: positions: expected whole numbers as names, got "
                f"{number!r}"
            )
        positions[int(number)] = cell
    return Maze(
        name,
        tuple(Node((node.x, node.y), node.object) for node in read.nodes),
        tuple(Hall((edge.a, edge.b), edge.floor, edge.wall) for edge in read.edges),
        positions,
    )


def _paragraphs(path: Path) -> tuple[Paragraph, ...]:
    adapter = TypeAdapter(_Line)
    paragraphs: list[Paragraph] = []
    for number, line in enumerate(_text(path).splitlines(), start=1):
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


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InstructionFileError(
            f"{path}: expected a file of the SAIL corpus, got none (see docs/sail.md)"
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        raise InstructionFileError(f"{path}: cannot be read ({error})") from None


def _valid(read: Callable[[str], Read], text: str, place: str) -> Read:
    try:
        return read(text)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]) or "the whole"
        got = json.dumps(first["input"], default=repr)[:60]
        raise InstructionFileError(
            f"{place}: {field}: {first['msg']}, got {got}"
        ) from None
