from collections.abc import Callable
from pathlib import Path
from typing import Any

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.tables import load_runs, run_tables

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


def figures(folder: Path) -> dict[str, Any]:
    """Return the columns of the only row of a run's table."""
    [table] = run_tables(load_runs([folder]), "reach")
    [row] = table.rows
    return {
        column.heading: row[column.name] for column in table.columns if column.heading
    }


def test_a_shorter_distance_asks_for_more_and_a_longer_one_for_less(
    write: Write, result: Make
) -> None:
    walks = [
        result("a-1", spd=1.0, way_m=40.0),
        result("b-1", spd=2.0, way_m=40.0),
        result("c-1", spd=4.0, success=False, way_m=40.0),
        # There when the time was up, but it had not said so.
        result("d-1", spd=0.5, success=False, stopped_by="budget", way_m=40.0),
    ]
    found = figures(write("run", walks))
    assert [found[each] for each in ("1.5 m", "3 m", "5 m")] == [0.25, 0.5, 0.75]


def test_a_search_of_the_whole_floor_is_a_success_only_within_more_of_the_way(
    write: Write, result: Make
) -> None:
    walks = [
        result(
            "a-1", path_length=42.0, way_m=40.0
        ),  # within the success distance of it
        result("b-1", path_length=62.0, way_m=40.0),
        result("c-1", path_length=110.0, way_m=40.0),
        result("d-1", path_length=41.0, way_m=40.0, success=False),
    ]
    found = figures(write("run", walks))
    assert [found[each] for each in ("1x", "1.5x", "2x", "3x")] == [
        0.25,
        0.5,
        0.5,
        0.75,
    ]


def test_the_mean_is_over_routes_whatever_their_number_of_episodes(
    write: Write, result: Make
) -> None:
    walks = [result(f"{one}-1", way_m=41.0) for one in "abc"]
    lost = result("d-1", route="R2", success=False, spd=9.0, way_m=41.0)
    assert figures(write("run", [*walks, lost]))["3 m"] == 0.5
