from collections.abc import Callable

import pytest

from memorymaze.runs.episodes.in_words import result_lines
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.runs.episodes.summary import collision_rates, summarise

Make = Callable[..., EpisodeResult]


def test_counts_means_and_sums_equal_those_worked_by_hand(
    result: Make, settings: RunDefinition
) -> None:
    results = [
        result("a-1", collisions=2, spd=1.0),
        result("b-1", study="onsite", success=False, stopped_by="crash", spd=4.0),
    ]
    summary = summarise(results, settings)
    assert (summary["episodes"], summary["episodes_missing"]) == (2, 0)
    assert summary["stopped_by"] == {"agent": 1, "crash": 1}
    assert (summary["mean"]["success"], summary["mean"]["spd"]) == (0.5, 2.5)
    assert summary["sum"]["collisions"] == 2
    assert [cell["study"] for cell in summary["by_study_and_route"]] == [
        "online",
        "onsite",
    ]


def test_the_lines_say_who_wrote_the_instructions(
    result: Make, settings: RunDefinition
) -> None:
    results = [result("a-1"), result("b-1", model_calls=2, tokens=90, cost_usd=0.5)]
    text = "\n".join(result_lines(settings, results))
    assert "2 written by a LANGUAGE MODEL, not by people" in text
    assert "2 calls, 90 tokens, 0.5000 USD" in text


def test_the_lines_say_what_went_wrong_most_often(
    result: Make, settings: RunDefinition
) -> None:
    results = [
        result(f"{name}-1", stopped_by="model_error", success=False, error=error)
        for name, error in zip("abcd", ("rare", "often", "often", None), strict=True)
    ]
    summary = summarise(results, settings)
    assert summary["errors"] == {"often": 2, "rare": 1}
    assert "3 ended with an error, 2 of them with: often" in result_lines(
        settings, results
    )


def test_the_lines_leave_crashes_to_those_that_tell_of_them(
    result: Make, settings: RunDefinition
) -> None:
    crash = result("a-1", stopped_by="crash", success=False, error="ValueError: no way")
    said = "\n".join(result_lines(settings, [crash]))
    assert "crashed 1" in said
    assert "no way" not in said


def test_endings_add_up_to_the_episodes(result: Make, settings: RunDefinition) -> None:
    results = [
        result("a-1"),
        result("b-1", success=False),
        result("c-1", success=False, gave_up=True),
        result("d-1", success=False, gave_up=True),
        result("e-1", success=False, stopped_by="budget"),
    ]
    [line] = [x for x in result_lines(settings, results) if x.startswith("endings: ")]
    assert line.partition(";")[0] == (
        "endings: gave up 2, arrived 1, stopped elsewhere 1, budget spent 1"
    )


def test_no_results_are_an_error(settings: RunDefinition) -> None:
    with pytest.raises(ValueError, match="at least one result"):
        summarise([], settings)


def test_rates_are_sums_over_sums_per_hundred_metres(result: Make) -> None:
    results = [
        result("a", path_length=50.0, collisions=2, person_collisions=1, waiting_s=3.0),
        result("b", path_length=150.0, near_misses=5, waiting_s=0.0),
    ]
    assert [*collision_rates(results).values()] == [1.0, 0.5, 2.5, 1.5]


def test_who_does_not_drive_hits_nothing(result: Make) -> None:
    assert set(collision_rates([result(path_length=0.0)]).values()) == {0.0}


def test_there_are_no_rates_of_no_results() -> None:
    with pytest.raises(ValueError, match="at least one"):
        collision_rates([])
