import csv
import io
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import pandas
import pytest

from memorymaze.basics.tables import TableFormat, write_tables
from memorymaze.language.models.model_settings import InferenceTime, ModelSettings
from memorymaze.language.models.spending import TokenPrice
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.tables import (
    MeasuredRun,
    load_runs,
    paper_table,
    run_tables,
)
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder

Make = Callable[..., EpisodeResult]


def shown(runs: Sequence[MeasuredRun], style: TableFormat, choice: str = "II") -> str:
    return write_tables(run_tables(runs, choice), style).decode()


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
    table = " ".join(shown(runs, style).split())
    for part in (
        "4 written by a LANGUAGE MODEL, not by people",
        "1 written by people",
        "success distance 3 m, time budget 3 times a perfect walk of the way described (at "
        "most 529 s), call budget 10000, seed 0",
        "memorymaze 0.1.0 (0123456789ab)",
        "INCOMPLETE: 1 of 6 episodes missing",
        "A SAMPLE of 6 episodes",
        "Mean over 2 routes",
        "paper: NavGPT",
    ):
        assert part in table


def test_a_mean_over_one_route_is_said_of_one_route(
    write: Callable[..., Path], result: Make
) -> None:
    folders = [
        write("both", [result("a-1"), result("b-1", route="R2")]),
        write("one", [result("b-1", route="R2", agent="other")]),
    ]
    text = shown(load_runs(folders), "text")
    assert "Mean over 2 routes" in text
    assert "Mean over 1 route\n" in text


def test_text_stands_in_columns_of_at_most_118_characters(
    runs: list[MeasuredRun],
) -> None:
    lines = shown(runs, "text", "both").splitlines()
    assert max(map(len, lines)) <= 118
    rows = [line for line in lines if line.startswith(("  guide", "  paper"))]
    assert len(rows) > 20
    means = [re.sub(r"\[.*?\]", lambda found: " " * len(found[0]), row) for row in rows]
    for table in (means[:12], means[12:]):
        assert len({tuple(i for i, c in enumerate(m) if c == ".") for m in table}) == 1


def test_markdown_has_the_same_number_of_cells_in_every_row(
    runs: list[MeasuredRun],
) -> None:
    lines = shown(runs, "md", "both").splitlines()
    rows = [line for line in lines if line.startswith("|")]
    assert {line.count("|") for line in rows} == {9}
    assert r"run look\|at" in "\n".join(lines)


def test_csv_gives_back_every_row_unrounded(runs: list[MeasuredRun]) -> None:
    text = shown(runs, "csv", "both")
    read = list(csv.DictReader(io.StringIO(text)))
    rows = [*paper_table(runs, "II").rows, *paper_table(runs, "III").rows]
    assert len(read) == len(rows)
    for line, row in zip(read, rows, strict=True):
        assert float(line["spd"]) == row["spd"]
        low = row.get("cls_low")
        assert line["cls_low"] == ("" if low is None else repr(low))
        assert line["figures"] == row["figures"]
        is_published = row["figures"] == "published"
        assert line["instructions_written_by"] == (
            "human" if is_published else "human+llm"
        )
        assert line["time_budget_s"] == ("" if is_published else "529.0")


@pytest.mark.parametrize(
    ("name", "value", "label", "note"),
    [
        (
            "turning_points",
            "lidar",
            "turning points by LiDAR",
            "TURNING POINTS BY LIDAR",
        ),
        ("motion", "kinematic", "kinematic", "KINEMATIC MOTION"),
    ],
)
def test_what_the_simulation_does_otherwise_is_stated_above_the_table(
    tmp_path: Path,
    record: RunRecord,
    result: Make,
    name: str,
    value: Any,
    label: str,
    note: str,
) -> None:
    changed = replace(record.settings.simulation, **{name: value})
    settings = replace(record.settings, simulation=changed)
    folder = tmp_path / "otherwise"
    with open_run_folder(folder, replace(record, settings=settings), resume=False) as r:
        r.add(result("a-1"))
    runs = load_runs([folder])
    assert runs[0].label == f"guide, {label}"
    assert note in shown(runs, "text")
    [line, *_] = csv.DictReader(io.StringIO(shown(runs, "csv")))
    assert line[name] == value


@pytest.fixture
def asking(tmp_path: Path, record: RunRecord, result: Make) -> MeasuredRun:
    """A run that asked a language model: three times on R1, and seven on R2."""
    agent = AgentSettings(
        "code_generation",
        language_model=ModelSettings(
            model="small",
            inference_time=InferenceTime(measured=False, start_s=2.0),
            price=TokenPrice(1.0, 2.0),
        ),
    )
    settings = replace(record.settings, agent=agent, episodes=3)
    spent = {"tokens": 1000, "inference_s": 0.75}
    results = [
        result("a-1", model_calls=2, cost_usd=0.5, standing_s=4.0, **spent),
        result("a-2", model_calls=4, cost_usd=0.25, standing_s=8.0, **spent),
        result("b-1", route="R2", model_calls=7, standing_s=14.0, **spent),
    ]
    folder = tmp_path / "asking"
    with open_run_folder(folder, replace(record, settings=settings), resume=False) as r:
        for one in results:
            r.add(replace(one, agent="code_generation[small]"))
    return load_runs([folder])[0]


def test_what_inference_costs_stands_beside_the_success_rate(
    runs: list[MeasuredRun], asking: MeasuredRun
) -> None:
    text = shown([*runs, asking], "text")
    assert max(map(len, text.splitlines())) <= 118
    lines = shown([*runs, asking], "md").splitlines()
    rows = [line.strip("| ").split(" | ") for line in lines if "[small] |" in line]
    assert [row[-5:] for row in rows] == [
        ["3.0", "1000", "0.3750", "0.8", "6.0"],
        ["7.0", "1000", "0.0000", "0.8", "14.0"],
        ["5.0", "1000", "0.1875", "0.8", "10.0"],
    ]
    assert any(line.endswith("| 0.0 | 0 | 0.0000 | 0.0 | 0.0 |") for line in lines)
    told = " ".join(text.split())
    assert "standing time per reply is 2 s, not the latency measured" in told
    assert "prices as given: 1 US$ per million tokens read, 2 written" in told


def test_markdown_and_csv_have_columns_for_inference(
    runs: list[MeasuredRun], asking: MeasuredRun
) -> None:
    lines = shown([*runs, asking], "md").splitlines()
    rows = [line for line in lines if line.startswith("|")]
    assert {line.replace(r"\|", "").count("|") for line in rows} == {14}
    assert rows[0].endswith("calls | tokens | US$ | inference s | standing s |")
    read = csv.DictReader(io.StringIO(shown([asking], "csv")))
    measured = [row for row in read if row["figures"] == "measured"]
    assert [row["standing_s_per_episode"] for row in measured] == [
        "6.0",
        "14.0",
        "10.0",
    ]
    assert [row["cost_usd_per_episode"] for row in measured] == [
        "0.375",
        "0.0",
        "0.1875",
    ]


@pytest.mark.parametrize("style", ["text", "md", "csv"])
def test_tables_of_agents_without_a_model_say_nothing_of_inference(
    runs: list[MeasuredRun], style: Literal["text", "md", "csv"]
) -> None:
    assert "inference" not in shown(runs, style, "both")


def test_a_cost_without_a_price_is_left_open(
    record: RunRecord, result: Make, tmp_path: Path
) -> None:
    with open_run_folder(tmp_path / "free", record, resume=False) as folder:
        folder.add(result(model_calls=2, tokens=10))
    runs = load_runs([tmp_path / "free"])
    [table] = run_tables(runs)
    assert table.rows[0]["cost_usd_per_episode"] is None
    assert "| 2.0 | 10 | - |" in table.markdown()


def test_latex_is_whole_and_special_characters_are_escaped(
    write: Callable[..., Path], result: Make
) -> None:
    folders = [
        write("mine", [result("a-1", agent="my_agent & co", spd=0.5)]),
        write("theirs", [result("a-1", agent="theirs", spd=2.5)]),
    ]
    text = shown(load_runs(folders), "latex")
    assert text.count(r"\begin{") == text.count(r"\end{") == 2
    assert r"\quad my\_agent \& co & - & 1 & \textbf{1.00}" in text
    assert r"\textbf{0.50}" in text
    assert r"\textbf{2.50}" not in text
    assert r"95 \% interval" in text
    body = text[text.index(r"\toprule") : text.index(r"\bottomrule")]
    widths = {line.count(" & ") for line in body.splitlines() if " & " in line}
    assert widths == {6}


def test_parquet_holds_what_the_csv_holds(
    tmp_path: Path, write: Callable[..., Path], result: Make
) -> None:
    runs = load_runs([write("mine", [result("a-1"), result("b-1", success=False)])])
    path = tmp_path / "tables.parquet"
    path.write_bytes(write_tables(run_tables(runs, "both"), "parquet"))
    frame = pandas.read_parquet(path)
    table = csv.DictReader(io.StringIO(shown(runs, "csv", "both")))
    assert list(frame.columns) == table.fieldnames
    rows = list(table)
    assert len(frame) == len(rows)
    for name in ("sr", "spd_low"):
        there = [float(row[name]) if row[name] else None for row in rows]
        assert [None if math.isnan(x) else x for x in frame[name]] == there
