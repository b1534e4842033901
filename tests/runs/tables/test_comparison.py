import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.tables import Table
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import (
    COMPARISON,
    OVERVIEW,
    load_runs,
    paired_table,
)

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


def rows_of(table: Table, measure: str) -> dict[str, Any]:
    """Return the rows of a measure by the titles of their places."""
    return {row["place"]: row for row in table.rows if row["measure"] == measure}


def warnings_of(table: Table) -> list[str]:
    return [note for note in table.notes if note.startswith(("LEFT OUT", "NOT "))]


def change_settings(folder: Path, **changes: Any) -> None:
    """Change what a run folder says of its run."""
    path = folder / "run.json"
    content = json.loads(path.read_text(encoding="utf-8"))
    content["settings"] |= changes
    path.write_text(json.dumps(content), encoding="utf-8")


@pytest.fixture
def two_runs(write: Write, result: Make) -> list[Path]:
    """Ten people on two routes; the second agent arrives where the first did not."""
    people = [f"p{number}" for number in range(10)]
    before = [
        result(f"{one}-{route}", route=route, success=False, spd=9.0, agent="old")
        for one in people
        for route in ("R1", "R2")
    ]
    after = [
        result(f"{one}-{route}", route=route, success=route == "R1", spd=1.0)
        for one in people
        for route in ("R1", "R2")
    ]
    return [write("old", before), write("new", after)]


def test_differences_are_those_of_the_second_run_to_the_first(
    two_runs: list[Path],
) -> None:
    table = paired_table(load_runs(two_runs), COMPARISON)
    rows = rows_of(table, "sr")
    assert list(rows) == ["University R1", "University R2", "Mean over 2 routes"]
    assert [row["arrived"] for row in rows.values()] == [
        "0 / 0 / 10 / 0",
        "0 / 0 / 0 / 10",
        "0 / 0 / 10 / 10",
    ]
    assert [row["difference"] for row in rows.values()] == [1.0, 0.0, 0.5]
    assert rows["University R1"]["p"] < 0.01
    assert rows["University R2"]["p"] == 1.0
    mean = rows_of(table, "spd")["Mean over 2 routes"]
    assert (mean["a"], mean["b"], mean["difference"]) == (9.0, 1.0, -8.0)


def test_a_run_compared_with_itself_shows_no_difference(two_runs: list[Path]) -> None:
    [run] = load_runs(two_runs[:1])
    table = paired_table([run, run], COMPARISON)
    assert warnings_of(table) == []
    assert {(row["p"], row["difference"]) for row in table.rows} == {(1.0, 0.0)}


def test_only_episodes_of_both_runs_count_and_the_rest_is_told(
    write: Write, result: Make
) -> None:
    folders = [
        write("a", [result("x-1"), result("y-1"), result("z-1")]),
        write("b", [result("x-1"), result("w-1")]),
    ]
    text = paired_table(load_runs(folders), COMPARISON).text()
    assert "LEFT OUT, as only one run has them: 2 only in A, 1 only in B." in text
    with pytest.raises(RunFolderError, match=r"a and c: .* got no episode that the"):
        paired_table(load_runs([folders[0], write("c", [result("v-1")])]), COMPARISON)


def test_what_belongs_to_the_agent_raises_no_alarm(write: Write, result: Make) -> None:
    folders = [write("a", [result("x-1")]), write("b", [result("x-1")])]
    change_settings(folders[1], looks="own", needs=["camera"], isolate=True)
    assert warnings_of(paired_table(load_runs(folders), COMPARISON)) == []
    stamp = {"name": "answers.jsonl", "sha256": "12"}
    change_settings(folders[0], answers=stamp)
    assert warnings_of(paired_table(load_runs(folders), COMPARISON)) == []


def test_two_versions_of_one_agent_are_told_apart(write: Write, result: Make) -> None:
    folders = [write("a", [result("x-1")]), write("b", [result("x-1")])]
    for folder, sha in zip(folders, ("12", "34"), strict=True):
        change_settings(folder, agent_files=[{"name": "guide.py", "sha256": sha}])
    text = paired_table(load_runs(folders), COMPARISON).text()
    assert "agent.file guide.py: '12' there, '34' here." in text
    assert "\n  agent files guide.py 12\n" in text
    assert "\n  agent files guide.py 34\n" in text


def test_pictures_of_other_looks_are_an_unfair_comparison(
    write: Write, result: Make
) -> None:
    folders = [write("a", [result("x-1")]), write("b", [result("x-1")])]
    change_settings(folders[0], looks="models")
    change_settings(folders[1], looks="own")
    [warning] = warnings_of(paired_table(load_runs(folders), COMPARISON))
    assert "looks: 'models' there, 'own' here." in warning


def test_runs_over_other_sites_with_time_by_the_way_raise_no_alarm(
    write: Write, result: Make
) -> None:
    runs = [write("some", [result("a-1")]), write("more", [result("a-1")])]
    for run, sites, seconds in zip(runs, ["b", "ab"], [119.0, 529.0], strict=True):
        stamps = [{"name": name, "sha256": 64 * name} for name in sites]
        content = json.loads((run / "run.json").read_text(encoding="utf-8"))
        simulation = content["settings"]["simulation"] | {"time_budget": seconds}
        change_settings(run, sites=stamps, simulation=simulation, budget_by="way")
    assert warnings_of(paired_table(load_runs(runs), COMPARISON)) == []
    change_settings(runs[0], budget_by="longest")
    change_settings(runs[1], sites=[{"name": "b", "sha256": 64 * "c"}])
    [alarm] = warnings_of(paired_table(load_runs(runs), COMPARISON))
    assert "budget_by: 'longest' there, 'way' here" in alarm
    assert "simulation.time_budget: 119.0 there, 529.0 here" in alarm
    assert "site b: 'bbbbbbbbbbbb' there, 'cccccccccccc' here" in alarm


def test_where_no_interval_can_be_told_no_test_is_made(
    write: Write, result: Make
) -> None:
    told = [result("a-1", route="R1"), result("b-1", route="R2")]
    runs = [write(name, told) for name in ("old", "new")]
    table = paired_table(load_runs(runs), COMPARISON)
    assert {row["low"] for row in table.rows} == {None}
    assert {row["p"] for row in table.rows} == {None}


def test_one_person_allows_no_test_and_equal_values_no_interval(
    write: Write, result: Make
) -> None:
    one = [write("a", [result("x-1")]), write("b", [result("x-1", spd=9.0)])]
    table = paired_table(load_runs(one), COMPARISON)
    spd = next(row for row in table.rows if row["measure"] == "spd")
    assert (spd["difference"], spd["low"], spd["p"]) == (8.0, None, None)
    text = table.text()
    assert "+8.00 (too few)" in text
    assert "- (too few)" in text
    assert "too few: fewer than two participants" in text
    names = ("x-1", "y-1", "z-1")
    several = [
        write("c", [result(name) for name in names]),
        write("d", [result(name, spd=9.0) for name in names]),
    ]
    text = paired_table(load_runs(several), COMPARISON).text()
    assert "+8.00 (no spread)" in text
    assert "too few" not in text


def test_studies_that_the_paper_lacks_are_compared_too(
    write: Write, result: Make
) -> None:
    results = [result("x-1", study="field"), result("y-1", study="field")]
    folders = [write("a", results), write("b", results)]
    text = paired_table(load_runs(folders), COMPARISON).text()
    assert "Study field\n" in text
    assert "University R1  (n 2, arrived: 2 / 0 / 0 / 0)" in text


def test_of_very_many_routes_the_mean_alone_is_shown(
    write: Write, result: Make
) -> None:
    results = [result(f"x-{n}", study="field", route=f"R{n}") for n in range(25)]
    folders = [write("a", results), write("b", results)]
    table = paired_table(load_runs(folders), COMPARISON)
    assert list(rows_of(table, "sr")) == ["Mean over 25 routes"]


def test_every_format_says_the_same(two_runs: list[Path]) -> None:
    table = paired_table(load_runs(two_runs), COMPARISON)
    text = table.text()
    assert "University R1  (n 10, arrived: 0 / 0 / 10 / 0)\n  SR " in text
    assert max(map(len, text.splitlines())) <= 118
    assert "| Mean over 2 routes | 20 |" in table.markdown()
    rows = list(csv.DictReader(io.StringIO(table.csv())))
    assert len(rows) == 3 * 5
    [mean] = [r for r in rows if r["site"] == "mean" and r["measure"] == "sr"]
    assert (float(mean["difference"]), mean["only_b"]) == (0.5, "10")


def test_several_runs_stand_each_beside_the_first_on_what_they_share(
    two_runs: list[Path], write: Write, result: Make
) -> None:
    few = write("few", [result("p0-R1", route="R1", agent="third")])
    first, *others = load_runs([*two_runs, few])
    table = paired_table([first, *others], OVERVIEW)
    assert [(row["run"], row["episodes"]) for row in table.rows] == [
        ("new", 20),
        ("few", 1),
    ]
    assert [row["difference"] for row in table.rows] == [0.5, 1.0]
    assert [row["p"] is None for row in table.rows] == [False, True]
    assert any("LEFT OUT" in note and "19 only in A" in note for note in table.notes)


def test_of_several_runs_one_that_shares_nothing_is_told_and_the_others_are_shown(
    two_runs: list[Path], write: Write, result: Make
) -> None:
    other = write("other", [result("q0-R1", route="R1", agent="third")])
    first, *others = load_runs([*two_runs, other])
    table = paired_table([first, *others], OVERVIEW)
    assert [row["run"] for row in table.rows] == ["new"]
    [note] = [note for note in table.notes if "NOTHING IN COMMON with A" in note]
    assert note.startswith("B: third")
