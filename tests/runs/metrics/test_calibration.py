from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import UndefinedMetricError
from memorymaze.runs.metrics.calibration import (
    ReliabilityBin,
    brier_reference,
    brier_score,
    expected_calibration_error,
    reliability,
    risk_coverage,
    risk_coverage_area,
    success_at_coverage,
)

CONFIDENCES = [0.95, 0.85, 0.85, 0.4, 0.1]
OUTCOMES = [1, 1, 0, 1, 0]
"""Five episodes; the values below are worked out by hand."""

Episodes = list[tuple[float, int]]

episodes = st.lists(
    st.tuples(st.floats(0, 1), st.integers(0, 1)), min_size=1, max_size=30
)


def columns(walks: Episodes) -> tuple[list[float], list[int]]:
    told, came = zip(*walks, strict=True)
    return list(told), list(came)


def test_the_brier_score_is_the_mean_squared_error() -> None:
    assert brier_score(CONFIDENCES, OUTCOMES) == pytest.approx(
        (0.0025 + 0.0225 + 0.7225 + 0.36 + 0.01) / 5
    )
    assert brier_reference(OUTCOMES) == pytest.approx(0.6 * 0.4)


def test_the_calibration_error_weighs_bins_by_their_episodes() -> None:
    bins = reliability(CONFIDENCES, OUTCOMES)
    assert [(each.low, each.high, each.count) for each in bins] == [
        (0.0, 0.1, 1),
        (0.3, 0.4, 1),
        (0.8, 0.9, 2),
        (0.9, 1.0, 1),
    ]
    assert bins[2] == ReliabilityBin(0.8, 0.9, 2, 0.85, 0.5)
    error = (0.1 + 0.6 + 2 * 0.35 + 0.05) / 5
    assert expected_calibration_error(CONFIDENCES, OUTCOMES) == pytest.approx(error)


def test_risk_grows_with_coverage_and_ties_share_it() -> None:
    risks = risk_coverage(CONFIDENCES, OUTCOMES)
    assert risks.tolist() == pytest.approx([0, 0.5 / 2, 1 / 3, 1 / 4, 2 / 5])
    assert risk_coverage_area(CONFIDENCES, OUTCOMES) == pytest.approx(
        (0.25 + 1 / 3 + 0.25 + 0.4) / 5
    )


@pytest.mark.parametrize(
    ("coverage", "success"),
    [
        pytest.param(0.2, 1.0, id="the one most confident"),
        pytest.param(0.25, 0.75, id="begun episodes count whole"),
        pytest.param(0.8, 0.75, id="four"),
        pytest.param(1.0, 0.6, id="all"),
    ],
)
def test_success_among_the_most_confident(coverage: float, success: float) -> None:
    found = success_at_coverage(CONFIDENCES, OUTCOMES, coverage)
    assert found == pytest.approx(success)


@given(episodes)
def test_the_scores_stay_between_0_and_1(walks: Episodes) -> None:
    told, came = columns(walks)
    for score in (brier_score, expected_calibration_error, risk_coverage_area):
        assert 0 <= score(told, came) <= 1 + 1e-12


@given(episodes)
def test_who_always_tells_the_mean_is_calibrated_and_knows_nothing(
    walks: Episodes,
) -> None:
    _, came = columns(walks)
    always = [float(np.mean(came))] * len(came)
    assert brier_score(always, came) == pytest.approx(brier_reference(came))
    assert expected_calibration_error(always, came) == pytest.approx(0)
    assert risk_coverage_area(always, came) == pytest.approx(1 - np.mean(came))


@given(episodes)
def test_who_is_sure_and_right_is_perfect(walks: Episodes) -> None:
    _, came = columns(walks)
    assert brier_score(came, came) == expected_calibration_error(came, came) == 0
    assert success_at_coverage(came, came, np.mean(came) or 1.0) == max(came)


@given(episodes)
def test_no_order_has_less_risk_than_that_of_the_outcomes(walks: Episodes) -> None:
    told, came = columns(walks)
    best = risk_coverage_area(came, came)
    worst = risk_coverage_area([1 - each for each in came], came)
    assert best - 1e-9 <= risk_coverage_area(told, came) <= worst + 1e-9


@given(episodes, st.randoms(use_true_random=False))
def test_the_order_of_episodes_changes_nothing(walks: Episodes, random: Random) -> None:
    mixed = random.sample(walks, len(walks))
    one, other = columns(walks), columns(mixed)
    assert risk_coverage(*one).tolist() == pytest.approx(risk_coverage(*other).tolist())
    assert expected_calibration_error(*one) == pytest.approx(
        expected_calibration_error(*other)
    )


@given(st.lists(st.tuples(st.integers(0, 10), st.integers(0, 1)), min_size=1))
def test_the_brier_score_is_reliability_less_resolution_and_uncertainty(
    walks: list[tuple[int, int]],
) -> None:
    """Murphy's partition; whole tenths, so that a bin has one confidence."""
    told, came = np.array([(c / 10, o) for c, o in walks]).T
    parts = [(told == c, c) for c in np.unique(told)]
    unreliable = sum(m.sum() * (came[m].mean() - c) ** 2 for m, c in parts)
    resolved = sum(m.sum() * (came[m].mean() - came.mean()) ** 2 for m, _ in parts)
    assert brier_score(told, came) == pytest.approx(
        (unreliable - resolved) / len(came) + brier_reference(came)
    )


@pytest.mark.parametrize(
    ("told", "came", "said"),
    [
        pytest.param([], [], "at least one episode", id="none"),
        pytest.param([0.5], [1, 0], "at least one episode", id="unlike lengths"),
        pytest.param([1.5], [1], "from 0 to 1, got 1.5", id="no probability"),
        pytest.param([float("nan")], [1], "from 0 to 1, got nan", id="no number"),
        pytest.param([0.5], [0.5], "0 or 1", id="half a success"),
    ],
)
def test_what_has_no_meaning_is_undefined(
    told: list[float], came: list[float], said: str
) -> None:
    with pytest.raises(UndefinedMetricError, match=said):
        brier_score(told, came)


def test_no_episode_has_no_mean_to_tell() -> None:
    with pytest.raises(UndefinedMetricError, match="at least one episode"):
        brier_reference([])
