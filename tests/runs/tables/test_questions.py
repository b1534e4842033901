"""Tables as questions: those that can be chosen, and one of one's own."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import (
    COMPARISON,
    load_runs,
    means_table,
    paired_table,
    run_tables,
)

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]
PAGE = Path(__file__).parents[3] / "docs" / "runs.md"


def test_the_table_of_ones_own_on_the_page_is_one(
    write: Write,
    result: Make,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    results = [
        result(f"{one}-{telling}", iteration=telling, turns_in_order=1 / telling)
        for one in "abc"
        for telling in (1, 2)
    ]
    write("runs/guide", results)
    section = PAGE.read_text("utf-8").split("## A table of your own")[1]
    [code] = re.findall(r"```python\n(.*?)```", section.split("\n## ")[0], re.DOTALL)
    monkeypatch.chdir(tmp_path)
    told: dict[str, Any] = {}
    exec(code, told)
    assert "run guide, 6 episodes" in capsys.readouterr().out
    table = means_table(load_runs([tmp_path / "runs/guide"]), told["TELLINGS"])
    found = {row["telling"]: row["turns"] for row in table.records()}
    assert found == {1: 1.0, 2: 0.5}


def test_a_table_that_there_is_not_is_refused_with_those_there_are(
    write: Write, result: Make
) -> None:
    runs = load_runs([write("run", [result("a-1")])])
    with pytest.raises(SettingsError, match="did you mean 'reach'"):
        run_tables(runs, "reac")


def test_titles_with_braces_stay_as_they_are(write: Write, result: Make) -> None:
    runs = load_runs([write(name, [result("a-1")]) for name in ("one", "two")])
    question = replace(COMPARISON, title="{odd} and {0}")
    assert paired_table(runs, question).title == "{odd} and {0}"
