"""Every entry of a trace: the page on formats has its fields, and it comes back as it was."""

import json
import re
from dataclasses import fields
from pathlib import Path
from typing import get_args

import pytest

from memorymaze.robot.api.control import Detection, MoveResult, SignText, TurnResult
from memorymaze.runs.episodes.trace import plain_entries
from memorymaze.runs.episodes.trace_entries import (
    AnswerEntry,
    CallEntry,
    CollisionEntry,
    EndEntry,
    NearMissEntry,
    NoteEntry,
    OpeningEntry,
    PeopleEntry,
    ThingLeft,
    ThingsEntry,
    TraceEntry,
    TrajectoryEntry,
    read_entry,
)

PAGE = Path(__file__).parents[3] / "docs" / "formats.md"
HERE = (1.0, 2.0, 0.5)
DOOR = Detection("door", (0.0, 0.0, 9.0, 9.0), 0.9, 2.0, -3.0, 1)


def test_the_page_on_formats_lists_the_entries_with_their_fields() -> None:
    _, page = PAGE.read_text(encoding="utf-8").split("| `kind` | other fields |\n")
    table, *_ = page.split("\n\n")
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", table, re.MULTILINE))
    known = {_kind(each): each for each in get_args(TraceEntry)}
    assert rows.keys() == known.keys()
    for kind, entry in known.items():
        names = {each.name.rstrip("_") for each in fields(entry)} - {"kind", "details"}
        assert names <= set(re.findall(r"`(\w+)`", rows[kind])), kind


def _kind(entry: type) -> object:
    return next(each.default for each in fields(entry) if each.name == "kind")


@pytest.mark.parametrize(
    "entry",
    [
        OpeningEntry(
            "e", "guide", "s", "R1", "r1", "Go.", "human", HERE, (3.0, 4.0), 0
        ),
        CallEntry(1.0, HERE, "detect_from_RGB_image", {"object": "door"}, [DOOR]),
        CallEntry(1.0, HERE, "detect_from_RGB_image", {"object": "'"}, {"error": "no"}),
        CallEntry(1.0, HERE, "read_signs", {}, [SignText("Exit", 2.0, 0.0, 1)]),
        CallEntry(
            1.0, HERE, "move_forward", {"distance": 1.0}, MoveResult(1.0, "done")
        ),
        CallEntry(1.0, HERE, "turn", {}, TurnResult(True, 90.0, "turned")),
        CallEntry(1.0, HERE, "turning_point_id", {}, None),
        NoteEntry(1.0, "decision", {"turning_point": 3}),
        AnswerEntry(1.0, (1.0, 2.0), "person-1", None, "wrong", "left", 3.0),
        ThingsEntry([ThingLeft("t", "cart", (1.0, 1.0, 1.0), HERE)]),
        PeopleEntry(["time", "x", "y"], {"person-1": [(0.0, 1.0, 2.0)]}),
        NearMissEntry(1.0, HERE, "person-1", 0.1),
        CollisionEntry(1.0, HERE, "wall", None),
        TrajectoryEntry(["time", "x", "y", "heading"], [(0.0, 1.0, 2.0, 0.5)]),
        EndEntry(1.0, "agent", None),
    ],
    ids=lambda entry: entry.kind,
)
def test_an_entry_comes_back_as_it_was_written(entry: TraceEntry) -> None:
    [line] = plain_entries([entry])
    assert next(iter(line)) == "kind"
    assert read_entry(json.loads(json.dumps(line))) == entry
