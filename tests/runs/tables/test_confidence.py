"""What the table of confidence says, with values worked out by hand."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import load_runs, run_tables

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


@pytest.fixture
def walks(result: Make) -> list[EpisodeResult]:
    """Of five people: there, falsely there, gave up twice, cut off."""
    told = {"way_m": 40.0, "gave_up": False}
    lost = told | {"success": False, "spd": 9.0}
    return [
        result("a-1", **told, path_length=42.0, confidence=0.9),
        result("b-1", **lost, path_length=50.0, confidence=0.8),
        result("c-1", **(lost | {"gave_up": True}), path_length=118.0, confidence=0.1),
        result("d-1", **(told | {"gave_up": True}), path_length=70.0, confidence=0.4),
        result("e-1", **lost, path_length=120.0, stopped_by="budget"),
    ]


def row_of(folder: Path) -> dict[str, Any]:
    """Return the only row of a run's table."""
    [table] = run_tables(load_runs([folder]), "confidence")
    [row] = table.records()
    return row


def test_claims_and_admissions_are_told_apart(
    write: Write, walks: list[EpisodeResult]
) -> None:
    row = row_of(write("run", walks))
    assert (row["sr"], row["claims"], row["false_arrivals"]) == (0.4, 0.4, 0.2)
    assert (row["admitted_failures"], row["gave_up_there"]) == (0.2, 0.2)


def test_metres_count_whatever_came_of_them(
    write: Write, walks: list[EpisodeResult]
) -> None:
    row = row_of(write("run", walks))
    assert row["ways_walked"] == pytest.approx(400 / 40 / 5)
    assert [row[f"sr_within_{times}_ways"] for times in ("1", "1.5", "2", "3")] == [
        0.2,
        0.2,
        0.4,
        0.4,
    ]


def test_confidence_is_held_against_success_where_it_is_told(
    write: Write, walks: list[EpisodeResult]
) -> None:
    row = row_of(write("run", walks))
    assert row["told"] == 4
    assert row["brier"] == pytest.approx((0.01 + 0.64 + 0.01 + 0.36) / 4)
    assert row["brier_reference"] == pytest.approx(0.25)
    assert row["ece"] == pytest.approx((0.1 + 0.8 + 0.1 + 0.6) / 4)
    # Most confident first: there, not there, there, not there.
    assert [row[f"sr_at_coverage_{part}"] for part in ("0.25", "0.5", "0.75", "1")] == [
        1.0,
        0.5,
        pytest.approx(2 / 3),
        0.5,
    ]
    assert row["aurc"] == pytest.approx((0 + 1 / 2 + 1 / 3 + 1 / 2) / 4)


def test_an_agent_that_tells_nothing_claims_what_it_stops_at(
    write: Write, walks: list[EpisodeResult]
) -> None:
    silent = [replace(each, confidence=None, gave_up=False) for each in walks]
    row = row_of(write("run", silent))
    assert (row["claims"], row["false_arrivals"]) == (0.8, 0.4)
    assert (row["told"], row["brier"], row["ece"], row["aurc"]) == (0, None, None, None)
