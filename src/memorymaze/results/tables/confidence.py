"""How sure agents were, and what came of it: claims, calibration, risk against coverage."""

from collections.abc import Sequence
from typing import Any

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.metrics.calibration import (
    BINS,
    brier_reference,
    brier_score,
    expected_calibration_error,
    risk_coverage_area,
    success_at_coverage,
)
from memorymaze.metrics.success import SUCCESS_DISTANCE
from memorymaze.results.tables.measures import SUCCESS, EpisodeValue, value_fields
from memorymaze.results.tables.reach import study_table, within_ways
from memorymaze.results.tables.runs import MeasuredRun, place_of
from memorymaze.tables import Column, Table

COVERAGES = (0.25, 0.5, 0.75, 1.0)
"""Parts of the episodes, the most confident first."""
CLAIMS = (
    SUCCESS,
    EpisodeValue("claims", "claimed", lambda each: float(each.claims_arrival), None),
    EpisodeValue(
        "false_arrivals", "false", lambda each: float(each.is_false_arrival), "lower"
    ),
    EpisodeValue(
        "admitted_failures",
        "admitted",
        lambda each: float(each.gave_up and not each.success),
        None,
    ),
    EpisodeValue(
        "gave_up_there",
        "gave up there",
        lambda each: float(each.gave_up and each.success),
        "lower",
    ),
)
WALKED = EpisodeValue(
    "ways_walked",
    "walked",
    lambda each: each.path_length / each.way_m if each.way_m else 0.0,
    "lower",
)
BRIER = EpisodeValue(
    "brier",
    "Brier",
    lambda each: brier_score([each.confidence or 0.0], [each.success]),
    "lower",
)
KEY = (
    "Shares of all episodes, unweighted means over routes: claimed: stopped as one that is "
    "there; false: claimed and was not; admitted: gave up and was not there; gave up there: "
    "gave up though it was; 1x to 3x: success within so many times the way, as in the table "
    "reach. walked: metres walked over those of the way, of all episodes, whatever came of "
    "them.\n"
    "Of the episodes that tell a confidence (told), each counting alike: Brier: mean squared "
    "error of the confidence, against success; of the mean: the Brier score of who always "
    f"tells the mean, to stay below; ECE: expected calibration error, {BINS} bins; 25 % to "
    "100 %: success among the most confident; AURC: area under the curve of risk against "
    "coverage, 1 - SR for a confidence that knows nothing.\n"
    "[95 % interval], bootstrap over participants."
)


def confidence_table(runs: Sequence[MeasuredRun]) -> Table:
    """Return claims, calibration and risk by study and run."""
    columns = (
        *(each.column for each in (*CLAIMS, *within_ways(SUCCESS_DISTANCE), WALKED)),
        Column("told", "told"),
        BRIER.column,
        Column("brier_reference", "of the mean", digits=2),
        Column("ece", "ECE", digits=2, better="lower"),
        *(
            Column(_at(part), f"{100 * part:g} %", digits=2, better="higher")
            for part in COVERAGES
        ),
        Column("aurc", "AURC", digits=2, better="lower"),
    )
    title = "Confidence: what agents claimed, and what came of it"
    return study_table(runs, title, columns, _fields, KEY, "confidence")


def told_confidences(
    results: Sequence[EpisodeResult],
) -> tuple[list[float], list[bool]]:
    """Return confidence and success of the episodes that tell a confidence."""
    told = [each for each in results if each.confidence is not None]
    return [each.confidence or 0.0 for each in told], [each.success for each in told]


def _at(coverage: float) -> str:
    return f"sr_at_coverage_{coverage:g}"


def _fields(run: MeasuredRun, results: Sequence[EpisodeResult]) -> dict[str, Any]:
    values = [*CLAIMS, *within_ways(run.record.settings.success_distance), WALKED]
    places = [place_of(result) for result in results]
    return value_fields(results, values, places) | _calibration(results)


def _calibration(results: Sequence[EpisodeResult]) -> dict[str, Any]:
    """Return what can be said of confidences; nothing where an agent tells none."""
    told = [each for each in results if each.confidence is not None]
    if not told:
        values = ("brier", "brier_reference", "ece", *map(_at, COVERAGES), "aurc")
        return {"told": 0} | dict.fromkeys(values)
    confidences, outcomes = told_confidences(told)
    covered = {
        _at(part): success_at_coverage(confidences, outcomes, part)
        for part in COVERAGES
    }
    return covered | {
        "told": len(told),
        **value_fields(told, [BRIER]),
        "brier_reference": brier_reference(outcomes),
        "ece": expected_calibration_error(confidences, outcomes),
        "aurc": risk_coverage_area(confidences, outcomes),
    }
