from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.runs.episodes.results import (
    EpisodeResult,
)
from memorymaze.runs.tables import load_runs, run_tables
from memorymaze.texts.corpus.records import Followers

NOBODY = Followers(usable=True, tried=None, arrived=None)
Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


@pytest.fixture
def followed(result: Make) -> Callable[..., EpisodeResult]:
    """Make the result of a paragraph of SAIL from one of its start headings."""

    def make(paragraph: str, heading: int, **changes: Any) -> EpisodeResult:
        return result(
            f"{paragraph}@{heading}",
            instruction_id=paragraph,
            study="sail",
            **({"site": "sail_grid", "source": "human", "followers": NOBODY} | changes),
        )

    return make


def test_every_paragraph_counts_the_same_however_many_headings_were_run(
    write: Write, followed: Make
) -> None:
    people = {"followers": Followers(usable=True, tried=4, arrived=3)}
    results = [
        followed("one", 0, success=True, **people),
        followed("one", 90, success=True, **people),
        followed("one", 180, success=False, **people),
        followed("two", 0, success=False, followers=Followers(False, None, None)),
    ]
    [table] = run_tables(load_runs([write("run", results)]))
    everything = next(row for row in table.rows if row["paragraphs"] == "all")
    assert (everything["texts"], everything["episodes"]) == (2, 4)
    assert everything["success"] == pytest.approx((2 / 3 + 0) / 2)
    assert (everything["followers"], everything["people"]) == (4, 0.75)
    usable = next(row for row in table.rows if row["paragraphs"] == "usable")
    assert (usable["texts"], usable["success"]) == (1, pytest.approx(2 / 3))
    assert "0.67 (too few)" in table.text()


def test_maps_have_rows_of_their_own_and_one_together(
    write: Write, followed: Make
) -> None:
    results = [followed("one", 0), followed("two", 0, site="sail_jelly")]
    [table] = run_tables(load_runs([write("run", results)]))
    maps = [row["map"] for row in table.rows if row["paragraphs"] == "all"]
    assert maps == ["Grid", "Jelly", "all"]


def test_one_follower_is_one_trial(write: Write, followed: Make) -> None:
    results = [followed("one", 0, followers=Followers(True, 1, 1))]
    [table] = run_tables(load_runs([write("run", results)]))
    assert "1.00 (1 trial)" in table.text()


def test_sail_and_other_runs_do_not_stand_in_one_table(
    write: Write, followed: Make, result: Make
) -> None:
    folders = [write("sail", [followed("one", 0)]), write("other", [result("a-1")])]
    with pytest.raises(SettingsError, match="make a table of each"):
        run_tables(load_runs(folders))
