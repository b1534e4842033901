import csv
import io
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Literal

import pytest

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import RunRecord, open_run_folder
from memorymaze.evaluation.table_formats import format_tables
from memorymaze.evaluation.tables import MeasuredRun, load_runs, table_rows

Make = Callable[..., EpisodeResult]


@pytest.fixture
def runs(tmp_path: Path, record: RunRecord, result: Make) -> list[MeasuredRun]:
    """A run on two routes that lacks one of its six episodes."""
    settings = replace(record.settings, episodes=6, limit=6)
    results = [
        result("a-1", spd=1 / 3),
        result("a-2", iteration=2, success=False, spd=160.25),
        result("b-1", route="R2", cls=0.123456),
        result("c-1", study="onsite", source="human"),
        result("d-1", study="onsite", success=False),
    ]
    folder = tmp_path / "look|at"
    with open_run_folder(folder, replace(record, settings=settings), resume=False) as r:
        for one in results:
            r.add(one)
    return load_runs([folder])


@pytest.mark.parametrize("style", ["text", "md"])
def test_a_table_says_how_its_figures_came_about(
    runs: list[MeasuredRun], style: Literal["text", "md"]
) -> None:
    table = " ".join(format_tables(runs, ["II"], style).split())
    for part in (
        "4 written by a LANGUAGE MODEL, not by people",
        "1 written by people",
        "success distance 3 m, time budget 529 s, call budget 10000, seed 0",
        "memorymaze 0.1.0 (0123456789ab)",
        "INCOMPLETE: 1 of 6 episodes are missing",
        "A SAMPLE of 6 episodes",
        "Mean over 2 routes",
        "paper: NavGPT",
    ):
        assert part in table


def test_text_stands_in_columns_of_at_most_118_characters(
    runs: list[MeasuredRun],
) -> None:
    lines = format_tables(runs, ["II", "III"], "text").splitlines()
    assert max(map(len, lines)) <= 118
    heading = next(line for line in lines if "parser" in line)
    columns = [heading.index(name) for name in ("SR", "OSR", "SPD (m)", "CLS")]
    rows = [line for line in lines if line.startswith(("  rules", "  paper"))]
    assert len(rows) > 20
    for row in rows:
        assert all(row[at - 1] == " " and row[at].isdigit() for at in columns)


def test_markdown_has_the_same_number_of_cells_in_every_row(
    runs: list[MeasuredRun],
) -> None:
    lines = format_tables(runs, ["II", "III"], "md").splitlines()
    rows = [line for line in lines if line.startswith("|")]
    assert {line.count("|") for line in rows} == {10}
    assert r"run look\|at" in "\n".join(lines)


def test_csv_gives_back_every_row_unrounded(runs: list[MeasuredRun]) -> None:
    text = format_tables(runs, ["II", "III"], "csv")
    read = list(csv.DictReader(io.StringIO(text)))
    rows = [row for table in ("II", "III") for row in table_rows(runs, table)]
    assert len(read) == len(rows)
    for line, row in zip(read, rows, strict=True):
        assert float(line["spd"]) == row.values["spd"].mean
        low = row.values["cls"].low
        assert line["cls_low"] == ("" if low is None else repr(low))
        assert line["figures"] == ("published" if row.run is None else "measured")
        assert line["instructions_written_by"] == (
            "human" if row.run is None else "human+llm"
        )
        assert line["time_budget_s"] == ("" if row.run is None else "529.0")


def test_turning_points_by_lidar_are_stated_above_the_table(
    tmp_path: Path, record: RunRecord, result: Make
) -> None:
    sensing = replace(record.settings.simulation, turning_points="lidar")
    settings = replace(record.settings, simulation=sensing)
    folder = tmp_path / "sensing"
    with open_run_folder(folder, replace(record, settings=settings), resume=False) as r:
        r.add(result("a-1"))
    runs = load_runs([folder])
    assert runs[0].label == "rules, turning points by LiDAR"
    assert "TURNING POINTS BY LIDAR" in format_tables(runs, ["II"], "text")
    [line, *_] = csv.DictReader(io.StringIO(format_tables(runs, ["II"], "csv")))
    assert line["turning_points"] == "lidar"
