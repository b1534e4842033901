"""What is noted is read as a note of ours where it fits, and is kept whole anyway."""

import re
from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.notes import (
    SHIPPED_NOTES,
    ArrivalNote,
    BeliefNote,
    DecisionNote,
    MotionsNote,
    OwnNote,
    ProgramRepairNote,
    RepairNote,
    note_of,
)

PAGE = Path(__file__).parents[2] / "docs" / "formats.md"


def test_the_page_on_formats_lists_the_notes_with_their_fields() -> None:
    _, page = PAGE.read_text(encoding="utf-8").split("#### Notes\n")
    rows = [
        tuple(re.findall(r"`(\w+)`", about + told))
        for about, told in re.findall(r"^\|( `\w+` \|)( `.*?) \| ", page, re.MULTILINE)
    ]
    known = [
        (each.about, *(one.name for one in fields(each))) for each in SHIPPED_NOTES
    ]
    assert rows == known


@pytest.mark.parametrize(
    ("about", "told", "kind"),
    [
        ("decision", {"turning_point": 3, "ways": ["left"]}, OwnNote),
        ("decision", {"at": 3, "exit": 0, "why": "a hunch"}, DecisionNote),
        ("decision", {"at": "the lift", "exit": 0}, OwnNote),
        ("decision", {"step": 1, "picture": "af"}, MotionsNote),
        ("arrival", {}, ArrivalNote),
        ("arrival", {"confidence": 2}, OwnNote),
        ("repair", {"leg": 2}, RepairNote),
        ("repair", {"error": "NameError", "calls": 3}, ProgramRepairNote),
        ("belief", {"at": 1, "legs": [0.2, 0.8], "doubt": 0}, BeliefNote),
        ("belief", {"at": 1, "legs": "01", "doubt": 0}, OwnNote),
        ("belief", {"text": "the door is near"}, OwnNote),
        ("a thought", {"of": {"any": object()}}, OwnNote),
    ],
)
def test_a_note_is_ours_where_it_has_our_fields_and_an_own_one_else(
    about: str, told: dict[str, Any], kind: type
) -> None:
    note = note_of(about, told)
    assert type(note) is kind
    assert note.about == about


def test_what_is_not_told_of_a_note_is_left_out() -> None:
    assert DecisionNote(3, 0, legs_done=1).details == {
        "at": 3,
        "exit": 0,
        "legs_done": 1,
    }
