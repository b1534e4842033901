"""What each kind of error costs, from pairs of texts."""

import csv
import io
from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.basics.tables import Table
from memorymaze.runs.episodes.results import (
    EpisodeResult,
    result_from_line,
    result_to_line,
)
from memorymaze.runs.tables import load_runs, run_tables

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


@pytest.fixture
def run(write: Write, result: Make) -> Path:
    """Three pairs with a missing turn, one with an extra turn, one text alone."""
    results: list[EpisodeResult] = []
    for name, kind, wrong, right in (
        ("a", "missing_turn", False, True),
        ("b", "missing_turn", False, True),
        ("c", "missing_turn", True, True),
        ("d", "extra_turn", False, False),
    ):
        episode = f"{name}-1"
        results += [
            result(episode, success=wrong, error_kinds=(kind,), pair=episode),
            result(
                f"{episode}-right",
                success=right,
                pair=episode,
                participant=name,
                error_kinds=(),
            ),
        ]
    return write("run", [*results, result("e-1", success=True, error_kinds=())])


def table_of(folder: Path) -> Table:
    [table] = run_tables(load_runs([folder]), "errors")
    return table


def test_rows_equal_those_worked_by_hand(run: Path) -> None:
    rows = {row["error"]: row for row in table_of(run).records()}
    assert list(rows) == ["none", "extra_turn", "missing_turn", "any"]
    missing = rows["missing_turn"]
    assert (missing["texts"], missing["pairs"]) == (3, 3)
    assert missing["sr"] == pytest.approx(1 / 3)
    assert missing["sr_right"] == 1.0
    assert missing["difference"] == pytest.approx(-2 / 3)
    assert missing["difference_low"] is not None
    assert (rows["none"]["texts"], rows["none"]["difference"]) == (1, None)
    assert rows["any"]["difference"] == pytest.approx(-0.5)


def test_several_kinds_in_one_text_are_a_row_of_their_own(
    write: Write, result: Make
) -> None:
    both = result("a-1", error_kinds=("extra_turn", "missing_turn"), success=False)
    (row,) = table_of(write("run", [both])).rows
    assert (row["error"], row["pairs"], row["p"]) == ("several", 0, None)


def test_the_table_says_who_wrote_the_texts(write: Write, result: Make) -> None:
    folder = write("run", [result("a-1", error_kinds=("x",), source="synthetic")])
    table = table_of(folder)
    for shown in (table.text(), table.markdown(), table.latex()):
        assert "written by a program (synthetic), not by people" in shown


def test_numbers_of_the_csv_are_not_rounded(run: Path) -> None:
    rows = list(csv.DictReader(io.StringIO(table_of(run).csv())))
    missing = next(row for row in rows if row["error"] == "missing_turn")
    assert float(missing["difference"]) == -2 / 3
    assert rows[0]["difference"] == ""


def test_errors_and_pair_are_kept_in_a_line(result: Make) -> None:
    told = result(error_kinds=("extra_turn", "missing_turn"), pair="a-1")
    assert result_from_line(result_to_line(told), "file:1") == told
