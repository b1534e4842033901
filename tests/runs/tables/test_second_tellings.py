"""Success on the first, the second and both tellings of the same people."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.input_files import stamp_file
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import load_runs, run_tables
from memorymaze.texts.corpus.files import BUILTIN_CORPUS
from memorymaze.texts.corpus.records import was_developed_on

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]

PEOPLE = {
    # first, second and both tellings arrive; errors in each telling
    "a": (False, True, True, (0, 0)),
    "b": (False, False, True, (1, 0)),
    "c": (True, False, True, (1, 0)),
    "d": (True, True, False, (2, 1)),
}


@pytest.fixture
def single(keep: Write, result: Make) -> Path:
    """Four people who told a way twice."""
    return keep("single", single_results(result))


def single_results(result: Make) -> list[EpisodeResult]:
    return [
        result(f"{name}-{number + 1}", success=success[number], iteration=number + 1)
        for name, success in PEOPLE.items()
        for number in (0, 1)
    ]


def both_results(result: Make) -> list[EpisodeResult]:
    return [
        result(
            f"{name}-2",
            instruction_id=f"{name}-1+{name}-2",
            success=both,
            iteration=2,
            errors_of_tellings=errors,
        )
        for name, (_, _, both, errors) in PEOPLE.items()
    ]


def rows_of(*folders: Path) -> list[dict[str, Any]]:
    [table] = run_tables(load_runs(folders), "second_tellings")
    assert table.text()
    return table.records()


def test_rows_equal_those_worked_by_hand(
    single: Path, keep: Write, result: Make
) -> None:
    both = keep("both", both_results(result), second_telling=True)
    whole, *_ = rows_of(single, both)
    assert (whole["errors"], whole["pairs"], whole["participants"]) == ("all", 4, 4)
    assert (whole["first"], whole["second"], whole["both"]) == (0.5, 0.5, 0.75)
    assert (whole["both_first"], whole["both_second"]) == (0.25, 0.25)
    assert whole["both_first_low"] < 0.25 < whole["both_first_high"]


def test_pairs_are_told_apart_by_how_many_tellings_have_an_error(
    single: Path, keep: Write, result: Make
) -> None:
    both = keep("both", both_results(result), second_telling=True)
    found = {row["errors"]: row for row in rows_of(single, both)}
    assert {key: row["pairs"] for key, row in found.items()} == {
        "all": 4,
        0: 1,
        1: 2,
        2: 1,
    }
    assert (found[1]["first"], found[1]["second"], found[1]["both"]) == (0.5, 0, 1)


def test_of_the_shipped_corpus_people_not_read_come_first(
    keep: Write, result: Make
) -> None:
    shipped = {"instructions": (stamp_file(BUILTIN_CORPUS),)}
    single = keep("single", single_results(result), **shipped)
    both = keep("both", both_results(result), **shipped, second_telling=True)
    unread = sum(not was_developed_on(name) for name in PEOPLE)
    rows = [row for row in rows_of(single, both) if row["errors"] == "all"]
    assert [(row["half"], row["pairs"]) for row in rows] == [
        ("held_out", unread),
        ("all", 4),
    ]


def test_a_run_with_both_tellings_needs_its_counterpart(
    single: Path, keep: Write, result: Make
) -> None:
    both = keep("both", both_results(result), second_telling=True, seed=7)
    with pytest.raises(RunFolderError, match="seed: 0 there, 7 here"):
        rows_of(single, both)
    with pytest.raises(RunFolderError, match="got none with it"):
        rows_of(single)


def test_pairs_that_the_single_run_lacks_are_counted_out(
    keep: Write, result: Make
) -> None:
    single = keep("single", single_results(result)[1:])
    both = keep("both", both_results(result), second_telling=True)
    [table] = run_tables(load_runs([single, both]), "second_tellings")
    assert table.rows[0]["pairs"] == 3
    assert any("lacks one of their tellings: 1" in note for note in table.notes)


def test_runs_read_apart_find_their_counterpart_by_what_they_are(
    keep: Write, result: Make
) -> None:
    folders = [
        keep("mine/run", single_results(result)),
        keep("other/run", single_results(result), seed=7),
        keep("both", both_results(result), second_telling=True),
    ]
    runs = [run for folder in folders for run in load_runs([folder])]
    [table] = run_tables(runs, "second_tellings")
    assert table.rows[0]["pairs"] == 4
