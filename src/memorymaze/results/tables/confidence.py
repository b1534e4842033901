"""How sure agents were, and what came of it: claims, calibration, risk against coverage."""

from collections.abc import Iterator, Sequence
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
from memorymaze.results.tables.measures import (
    SUCCESS,
    Quantity,
    mean_fields,
    participant_of,
)
from memorymaze.results.tables.questions import RowGroup, TableQuestion
from memorymaze.results.tables.reach import within_ways
from memorymaze.results.tables.runs import (
    BY_STUDY_AND_RUN,
    MeasuredRun,
    by_study_and_run,
    place_of,
)
from memorymaze.tables import Column

COVERAGES = (0.25, 0.5, 0.75, 1.0)
"""Parts of the episodes, the most confident first."""
CLAIMS: tuple[Quantity[EpisodeResult], ...] = (
    SUCCESS,
    Quantity("claims", "claimed", lambda each: float(each.claims_arrival), None),
    Quantity(
        "false_arrivals", "false", lambda each: float(each.is_false_arrival), "lower"
    ),
    Quantity(
        "admitted_failures",
        "admitted",
        lambda each: float(each.gave_up and not each.success),
        None,
    ),
    Quantity(
        "gave_up_there",
        "gave up there",
        lambda each: float(each.gave_up and each.success),
        "lower",
    ),
)
WALKED: Quantity[EpisodeResult] = Quantity(
    "ways_walked",
    "walked",
    lambda each: each.path_length / each.way_m if each.way_m else 0.0,
    "lower",
)
BRIER: Quantity[EpisodeResult] = Quantity(
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


def told_confidences(
    results: Sequence[EpisodeResult],
) -> tuple[list[float], list[bool]]:
    """Return confidence and success of the episodes that tell a confidence."""
    told = [each for each in results if each.confidence is not None]
    return [each.confidence or 0.0 for each in told], [each.success for each in told]


def _at(coverage: float) -> str:
    return f"sr_at_coverage_{coverage:g}"


def _groups(runs: Sequence[MeasuredRun]) -> Iterator[RowGroup[EpisodeResult]]:
    for about, run, results in by_study_and_run(runs):
        near = run.record.settings.success_distance
        yield RowGroup(
            {**about, **_calibration(results)},
            [*CLAIMS, *within_ways(near), WALKED],
            results,
        )


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
        **mean_fields([BRIER], told, [each.participant for each in told]),
        "brier_reference": brier_reference(outcomes),
        "ece": expected_calibration_error(confidences, outcomes),
        "aurc": risk_coverage_area(confidences, outcomes),
    }


CONFIDENCE = TableQuestion(
    shows="false arrivals, admitted failures, how sure the agent was and whether it was "
    "right",
    title="Confidence: what agents claimed, and what came of it",
    name="confidence",
    columns=(
        *BY_STUDY_AND_RUN,
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
    ),
    groups=_groups,
    unit=participant_of,
    cell=place_of,
    key=(KEY,),
)
