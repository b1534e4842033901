from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.results.tables import Place, TableRow, load_runs, run_tables, table_rows

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


def measured(rows: Sequence[TableRow]) -> dict[tuple[object, ...], TableRow]:
    return {
        (r.study, r.places if r.is_mean else r.places[0], r.iteration): r
        for r in rows
        if r.run is not None
    }


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
    rows = measured(table_rows(load_runs([folder]), "II"))
    one, two = Place("university", "R1"), Place("university", "R2")
    assert list(rows) == [
        ("online", one, None),
        ("online", two, None),
        ("online", (one, two), None),
        ("onsite", one, None),
    ]
    first = rows["online", one, None]
    assert (first.episodes, first.participants) == (2, 1)
    assert [each.mean for each in first.values.values()] == [0.5, 1.0, 2.5, 0.4]
    mean = rows["online", (one, two), None]
    assert [each.mean for each in mean.values.values()] == [0.25, 0.5, 26.25, 0.45]
    assert (mean.episodes, mean.participants) == (3, 2)


def test_table_three_tells_iterations_apart(write: Write, result: Make) -> None:
    folder = write(
        "run",
        [result("a-1", spd=1.0), result("a-2", iteration=2, success=False, spd=4.0)],
    )
    rows = measured(table_rows(load_runs([folder]), "III"))
    place = Place("university", "R1")
    assert rows["online", place, 1].values["spd"].mean == 1.0
    assert rows["online", place, 2].values["sr"].mean == 0.0


def test_the_papers_figures_stand_beside_routes_that_it_has(
    write: Write, result: Make
) -> None:
    folder = write("run", [result("a-1"), result("b-1", site="annex", route="R1")])
    rows = table_rows(load_runs([folder]), "II")
    paper = [row for row in rows if row.run is None]
    assert {row.places for row in paper} == {(Place("university", "R1"),)}
    best = next(row for row in paper if row.parser)
    assert best.method == "paper: proposed"
    assert [each.mean for each in best.values.values()] == [0.30, 0.35, 19.66, 0.49]
    assert best.values["sr"].low is None


def test_the_papers_mean_is_over_the_same_routes(write: Write, result: Make) -> None:
    folder = write("run", [result("a-1"), result("b-1", route="R2")])
    rows = table_rows(load_runs([folder]), "II")
    mean = next(row for row in rows if row.is_mean and row.run is None and row.parser)
    assert mean.values["sr"].mean == pytest.approx((0.30 + 0.04) / 2)


def test_routes_come_in_the_papers_order_then_by_name(
    write: Write, result: Make
) -> None:
    sites = ["annex", "museum_7f", "university", "museum_5f"]
    results = [result(f"p{n}-1", site=site) for n, site in enumerate(sites)]
    rows = table_rows(load_runs([write("run", results)]), "II")
    places = [row.places[0].site for row in rows if row.run and not row.is_mean]
    assert places == ["university", "museum_5f", "museum_7f", "annex"]


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
    assert labels == ["rules (one)", "rules (two)", "oracle"]
