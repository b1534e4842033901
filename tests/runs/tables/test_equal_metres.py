from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import EQUAL_METRES, load_runs, paired_table

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]

PEOPLE = "abcdef"


@pytest.fixture
def texts(result: Make) -> list[EpisodeResult]:
    """A right text of each of six people, one that leaves out a turn, one that adds one."""
    kinds = {1: (), 2: ("missing_turn",), 3: ("extra_turn",)}
    return [
        result(
            f"{one}-{number}",
            error_kinds=kind,
            way_m=40.0,
            path_length=75.0,
            study="online" if number < 3 else "onsite",
        )
        for one in PEOPLE
        for number, kind in kinds.items()
    ]


def rows_of(first: Path, second: Path) -> dict[tuple[str, str, float], dict[str, Any]]:
    table = paired_table(load_runs([first, second]), EQUAL_METRES)
    return {(row["study"], row["error"], row["ways"]): row for row in table.records()}


def test_a_shorter_walk_is_worth_more_only_where_few_metres_are_allowed(
    write: Write, texts: list[EpisodeResult]
) -> None:
    faster = [replace(each, path_length=42.0) for each in texts]
    rows = rows_of(write("explorer", texts), write("guide", faster))
    figures = {
        ways: (row["a"], row["b"], row["difference"])
        for (study, kind, ways), row in rows.items()
        if (study, kind) == ("all", "any")
    }
    assert figures == {
        1.0: (0.0, 1.0, 1.0),
        1.5: (0.0, 1.0, 1.0),
        2.0: (1.0, 1.0, 0.0),
        3.0: (1.0, 1.0, 0.0),
    }
    # Six people who all gain: 2 of 64 patterns of signs are as far from zero.
    assert rows["all", "any", 1.0]["p"] == 2 / 64


def test_kinds_of_errors_stand_apart_and_right_texts_are_left_out(
    write: Write, texts: list[EpisodeResult]
) -> None:
    lost = [
        replace(each, success=each.error_kinds != ("missing_turn",)) for each in texts
    ]
    rows = rows_of(write("explorer", texts), write("guide", lost))
    found = {
        (study, kind): (row["texts"], row["difference"])
        for (study, kind, ways), row in rows.items()
        if ways == 3
    }
    assert found == {
        ("all", "extra_turn"): (6, 0.0),
        ("all", "missing_turn"): (6, -1.0),
        ("all", "any"): (12, -0.5),
        ("online", "missing_turn"): (6, -1.0),
        ("onsite", "extra_turn"): (6, 0.0),
    }


def test_texts_without_labelled_errors_are_refused(
    write: Write, texts: list[EpisodeResult]
) -> None:
    right = [replace(each, error_kinds=()) for each in texts]
    runs = [write(name, right) for name in ("a", "b")]
    with pytest.raises(
        RunFolderError, match="expected texts whose errors are labelled"
    ):
        rows_of(*runs)
