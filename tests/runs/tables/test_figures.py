from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import load_runs
from memorymaze.runs.tables.figures import success_figure

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


def test_bars_stand_above_their_routes_also_where_a_run_lacks_one(
    write: Write, result: Make
) -> None:
    folders = [
        write("both", [result("a-1"), result("b-1", route="R2", success=False)]),
        write("second", [result("b-1", route="R2", agent="other")]),
    ]
    [panel] = success_figure(load_runs(folders)).get_axes()
    titles = [each.get_text() for each in panel.get_xticklabels()]
    assert titles == ["University R1", "University R2", "Mean"]
    first, second = (
        {round(bar.get_x() + bar.get_width() / 2): bar.get_height() for bar in bars}
        for bars in panel.containers
        if hasattr(bars, "patches")
    )
    assert first == {0: 1.0, 1: 0.0, 2: 0.5}
    assert second == {1: 1.0, 2: 1.0}


def test_every_study_has_a_panel_also_those_that_the_paper_lacks(
    write: Write, result: Make
) -> None:
    folder = write("run", [result("a-1", study="sail", site="sail_grid")])
    [panel] = success_figure(load_runs([folder])).get_axes()
    assert panel.get_title() == "Study sail"


def test_an_interval_is_drawn_from_its_lower_to_its_upper_end(
    write: Write, result: Make
) -> None:
    results = [result(f"{name}-1", success=name < "c") for name in "abcd"]
    [panel] = success_figure(load_runs([write("run", results)])).get_axes()
    [[low, high]] = [
        [y for _, y in path.vertices]
        for bars in panel.containers
        if hasattr(bars, "has_yerr")
        for path in bars.lines[2][0].get_paths()
    ]
    assert (low, high) == (pytest.approx(0.0), pytest.approx(1.0))
