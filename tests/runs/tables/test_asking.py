"""What asking people is worth, beside the first run."""

from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.tables import Row
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import load_runs, run_tables

Make = Callable[..., EpisodeResult]
Keep = Callable[..., Path]


@pytest.fixture
def rows(keep: Keep, result: Make) -> dict[str, Row]:
    """Four people's texts without questions, and with one question each for three of them."""
    silent = [result(f"{name}-1", success=name == "a") for name in "abcd"]
    asked = [
        result("a-1", questions=1, strangers_s=20.0, answers_left_m=(10.0,)),
        result("b-1", questions=1, strangers_s=30.0, answers_left_m=(50.0,)),
        result(
            "c-1",
            success=False,
            questions=1,
            strangers_s=10.0,
            answers_left_m=(90.0,),
        ),
        result("d-1", success=False),
    ]
    folders = [keep("silent", silent, ask=0), keep("asks", asked, ask=1)]
    (table,) = run_tables(load_runs(folders), "asking")
    return {str(row["run"]): row for row in table.rows}


def test_success_is_set_beside_that_of_the_first_run(rows: dict[str, Row]) -> None:
    assert (rows["silent"]["sr"], rows["asks"]["sr"]) == (0.25, 0.5)
    assert (rows["silent"]["difference"], rows["asks"]["difference"]) == (0, 0.25)


def test_questions_and_the_time_of_strangers_are_counted(rows: dict[str, Row]) -> None:
    assert rows["asks"]["questions"] == 0.75
    assert rows["asks"]["strangers_s"] == 15.0


def test_success_counts_less_the_more_was_asked(rows: dict[str, Row]) -> None:
    assert rows["silent"]["per_question"] == 0.25
    assert rows["asks"]["per_question"] == 0.25


def test_success_is_told_by_the_metres_left_when_the_answer_came(
    rows: dict[str, Row],
) -> None:
    asked = rows["asks"]
    assert [asked[name] for name in ("near", "middle", "far")] == [
        "1.00 (1)",
        "1.00 (1)",
        "0.00 (1)",
    ]


def test_a_run_of_another_track_is_refused(keep: Keep, result: Make) -> None:
    folder = keep("plain", [result("a-1")])
    with pytest.raises(RunFolderError, match="people one can ask"):
        run_tables(load_runs([folder]), "asking")


def test_runs_over_other_episodes_are_refused(keep: Keep, result: Make) -> None:
    folders = [
        keep("silent", [result("a-1")], ask=0),
        keep("asks", [result("b-1")], ask=1),
    ]
    with pytest.raises(RunFolderError, match="same episodes"):
        run_tables(load_runs(folders), "asking")
