from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.basics.tables import Row, Table
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import load_runs, paper_table, run_tables

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


PAPER = ("sr", "osr", "spd", "cls")


def measured(table: Table) -> dict[tuple[str, str], Row]:
    """Return the rows of runs by study and title of their places."""
    rows = [row for row in table.rows if row["figures"] == "measured"]
    return {(row["study"], row["place"]): row for row in rows}


def published(table: Table) -> list[Row]:
    return [row for row in table.rows if row["figures"] == "published"]


def test_table_two_equals_one_worked_by_hand(write: Write, result: Make) -> None:
    folder = write(
        "run",
        [
            result("a-1", spd=1.0, cls=0.5),
            result("a-2", iteration=2, success=False, spd=4.0, cls=0.3),
            result("b-1", route="R2", success=False, oracle_success=False, spd=50.0),
            result("c-1", study="onsite", spd=0.5),
        ],
    )
    rows = measured(paper_table(load_runs([folder]), "II"))
    assert list(rows) == [
        ("online", "University R1"),
        ("online", "University R2"),
        ("online", "Mean over 2 routes"),
        ("onsite", "University R1"),
    ]
    first = rows["online", "University R1"]
    assert (first["episodes"], first["participants"]) == (2, 1)
    assert [first[name] for name in PAPER] == [0.5, 1.0, 2.5, 0.4]
    mean = rows["online", "Mean over 2 routes"]
    assert [mean[name] for name in PAPER] == [0.25, 0.5, 26.25, 0.45]
    assert (mean["episodes"], mean["participants"]) == (3, 2)


def test_table_three_tells_iterations_apart(write: Write, result: Make) -> None:
    folder = write(
        "run",
        [result("a-1", spd=1.0), result("a-2", iteration=2, success=False, spd=4.0)],
    )
    rows = measured(paper_table(load_runs([folder]), "III"))
    assert rows["online", "University R1, iteration 1"]["spd"] == 1.0
    assert rows["online", "University R1, iteration 2"]["sr"] == 0.0


def test_the_papers_figures_stand_beside_routes_that_it_has(
    write: Write, result: Make
) -> None:
    folder = write("run", [result("a-1"), result("b-1", site="annex", route="R1")])
    paper = published(paper_table(load_runs([folder]), "II"))
    assert {(row["site"], row["route"]) for row in paper} == {("university", "R1")}
    best = next(row for row in paper if row["parser"])
    assert best["method"] == "paper: proposed"
    assert [best[name] for name in PAPER] == [0.30, 0.35, 19.66, 0.49]
    assert "sr_low" not in best


def test_the_papers_mean_is_over_the_same_routes(write: Write, result: Make) -> None:
    folder = write("run", [result("a-1"), result("b-1", route="R2")])
    paper = published(paper_table(load_runs([folder]), "II"))
    mean = next(row for row in paper if row["site"] == "mean" and row["parser"])
    assert mean["sr"] == pytest.approx((0.30 + 0.04) / 2)


def test_routes_come_in_the_papers_order_then_by_name(
    write: Write, result: Make
) -> None:
    sites = ["annex", "museum_7f", "university", "museum_5f"]
    results = [result(f"p{n}-1", site=site) for n, site in enumerate(sites)]
    rows = measured(paper_table(load_runs([write("run", results)]), "II")).values()
    places = [row["site"] for row in rows]
    assert places == ["university", "museum_5f", "museum_7f", "annex", "mean"]


def test_studies_that_the_paper_lacks_stand_after_its_own(
    write: Write, result: Make
) -> None:
    results = [result("a-1", study="field"), result("b-1")]
    [table] = run_tables(load_runs([write("run", results)]))
    assert table.text().index("Online instructions") < table.text().index("Study field")


def test_development_texts_can_be_left_out(write: Write, result: Make) -> None:
    folder = write("run", [result("a-1", split="dev"), result("b-1")])
    [run] = load_runs([folder], exclude_dev=True)
    assert [one.episode_id for one in run.results] == ["b-1"]
    assert (run.left_out, run.missing) == (1, 0)


def test_missing_episodes_are_counted(write: Write, result: Make) -> None:
    [run] = load_runs([write("run", [result("a-1")], episodes=5)])
    assert run.missing == 4


def test_a_run_without_results_is_an_error(write: Write, result: Make) -> None:
    with pytest.raises(RunFolderError, match="no results to show"):
        load_runs([write("empty", [], episodes=5)])
    with pytest.raises(RunFolderError, match="no results to show"):
        load_runs([write("dev", [result("a-1", split="dev")])], exclude_dev=True)


def test_runs_of_one_method_are_told_apart_by_their_folders(
    write: Write, result: Make
) -> None:
    folders = [
        write("one", [result("a-1")]),
        write("two", [result("a-1")]),
        write("three", [result("a-1", agent="oracle")]),
    ]
    labels = [run.label for run in load_runs(folders)]
    assert labels == ["guide (one)", "guide (two)", "oracle"]


def test_runs_in_folders_of_one_name_are_told_apart_by_their_paths(
    write: Write, result: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("seed0/guide", "seed1/guide", "stop"):
        write(name, [result("a-1")])
    monkeypatch.chdir(tmp_path)
    runs = load_runs(["seed0/guide", "seed1/guide", "stop"])
    assert [run.name for run in runs] == ["seed0/guide", "seed1/guide", "stop"]
    assert [run.label for run in runs] == [f"guide ({run.name})" for run in runs]


def test_a_run_is_named_once(
    write: Write, result: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = write("run", [result("a-1")])
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SettingsError, match="every run once, got it twice"):
        load_runs([folder, "run"])


def test_a_method_without_a_run_has_a_row_that_says_so_and_a_note_how_to_get_one(
    write: Write, result: Make
) -> None:
    runs = load_runs([write("run", [result("a-1"), result("b-1", route="R2")])])
    [table] = run_tables(runs, "II", {"navid": "Ask a vision model."})
    [row] = [row for row in table.rows if row["figures"] == "not recorded"]
    assert (row["method"], row["site"]) == ("navid (not recorded)", "mean")
    text = table.text()
    assert "navid: NOT RECORDED. Ask a vision model." in text
    [line] = [line for line in text.splitlines() if line.lstrip().startswith("navid (")]
    assert line.split()[-5:] == ["-"] * 5
