"""A made-up maze in the layout of the SAIL folder: a T of five nodes.

  1,1 -brick- 2,1 -brick- 3,1 (sofa)
position 1     |
             grass
               |
              2,2 (easel)
               |
             grass
               |
              2,3 position 2
"""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


def _edge(a: list[int], b: list[int], floor: str, wall: str) -> dict[str, Any]:
    return {"a": a, "b": b, "floor": floor, "wall": wall}


@pytest.fixture
def small_maps() -> dict[str, Any]:
    """The content of `maps.json`."""
    cells = {(1, 1): None, (2, 1): None, (3, 1): "sofa", (2, 2): "easel", (2, 3): None}
    positions = {(1, 1): 1, (2, 3): 2}
    return {
        "headings": {},
        "maps": {
            "Small": {
                "nodes": [
                    {"x": x, "y": y, "object": thing, "position": positions.get((x, y))}
                    for (x, y), thing in cells.items()
                ],
                "edges": [
                    _edge([1, 1], [2, 1], "brick", "fish"),
                    _edge([2, 1], [3, 1], "brick", "fish"),
                    _edge([2, 1], [2, 2], "grass", "tower"),
                    _edge([2, 2], [2, 3], "grass", "tower"),
                ],
                "positions": {"1": [1, 1], "2": [2, 3]},
            }
        },
    }


def _line(**changes: Any) -> dict[str, Any]:
    return {
        "id": "ANN-Small-1-2-1",
        "map": "Small",
        "writer": "ANN",
        "start_position": 1,
        "goal_position": 2,
        "start_pose": [1, 1, None],
        "goal": [2, 3],
        "text": "go forward one segment to the grassy hall . turn right . go forward "
        "two segments",
        "usable": True,
        "human_trials": 4,
        "human_found": 3,
        **changes,
    }


@pytest.fixture
def small_line() -> Callable[..., dict[str, Any]]:
    """Make one instruction; name the fields that differ."""
    return _line


@pytest.fixture
def write_folder(tmp_path: Path) -> Callable[..., Path]:
    """Write mazes and instructions to a folder in the layout of SAIL's."""

    def write(maps: dict[str, Any], *lines: dict[str, Any]) -> Path:
        folder = tmp_path / "sail"
        folder.mkdir(exist_ok=True)
        (folder / "maps.json").write_text(json.dumps(maps), encoding="utf-8")
        text = "".join(json.dumps(line) + "\n" for line in lines)
        (folder / "instructions.jsonl").write_text(text, encoding="utf-8")
        return folder

    return write


@pytest.fixture
def small_folder(small_maps: dict[str, Any], write_folder: Callable[..., Path]) -> Path:
    """A folder with the maze and two instructions, there and back."""
    back = _line(
        id="BOB-Small-2-1-1",
        writer="BOB",
        start_position=2,
        goal_position=1,
        start_pose=[2, 3, None],
        goal=[1, 1],
        text="take the green path past the easel to the red brick hall . turn left . "
        "walk forward once",
        usable=False,
        human_found=1,
    )
    return write_folder(small_maps, _line(), back)
