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
from memorymaze.results.tables.measures import (
    EpisodeValue,
    value_fields,
    with_interval_notes,
)
from memorymaze.results.tables.reach import check_ways, within_ways
from memorymaze.results.tables.runs import (
    MeasuredRun,
    check_told,
    place_of,
    run_notes,
    studies_of,
    study_title,
)
from memorymaze.tables import Column, Row, Table

COVERAGES = (0.25, 0.5, 0.75, 1.0)
"""Parts of the episodes, the most confident first."""
CLAIMS = (
    EpisodeValue("sr", "SR", lambda each: float(each.success)),
    EpisodeValue("claims", "claimed", lambda each: float(each.claims_arrival), None),
    EpisodeValue(
        "false_arrivals", "false", lambda each: float(each.is_false_arrival), "lower"
    ),
    EpisodeValue(
        "admitted_failures",
        "admitted",
        lambda each: float(bool(each.gave_up) and not each.success),
        None,
    ),
    EpisodeValue(
        "gave_up_there",
        "gave up there",
        lambda each: float(bool(each.gave_up) and each.success),
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
    """Return claims, calibration and risk by study and run.

    Raises:
        RunFolderError: A run was made before results told whether the agent gave up.
    """
    results = [result for run in runs for result in run.results]
    table = Table(
        "Confidence: what agents claimed, and what came of it",
        (
            Column(
                "study", "Study", "group", show=lambda row: study_title(row["study"])
            ),
            Column("method", "Method", "label"),
            Column("run"),
            Column("episodes", "n"),
            *(
                each.column
                for each in (*CLAIMS, *within_ways(SUCCESS_DISTANCE), WALKED)
            ),
            Column("told", "told"),
            BRIER.column,
            Column("brier_reference", "of the mean", digits=2),
            Column("ece", "ECE", digits=2, better="lower"),
            *(
                Column(_at(part), f"{part:.0%}".replace("%", " %"), digits=2)
                for part in COVERAGES
            ),
            Column("aurc", "AURC", digits=2, better="lower"),
        ),
        tuple(
            _row(run, study)
            for study in studies_of(results)
            for run in runs
            if any(result.study == study for result in run.results)
        ),
        (*("\n".join(run_notes(run)) for run in runs), KEY),
        "confidence",
    )
    return with_interval_notes(table)


def told_confidences(
    results: Sequence[EpisodeResult],
) -> tuple[list[float], list[bool]]:
    """Return confidence and success of the episodes that tell a confidence."""
    told = [each for each in results if each.confidence is not None]
    return [each.confidence or 0.0 for each in told], [each.success for each in told]


def _at(coverage: float) -> str:
    return f"sr_at_coverage_{coverage:g}"


def _row(run: MeasuredRun, study: str) -> Row:
    check_told(run, "gave_up", "whether the agent gave up")
    check_ways(run)
    chosen = [result for result in run.results if result.study == study]
    near = run.record.settings.success_distance
    return {
        "study": study,
        "method": run.label,
        "run": run.name,
        "episodes": len(chosen),
        **value_fields(
            chosen,
            [*CLAIMS, *within_ways(near), WALKED],
            [place_of(result) for result in chosen],
        ),
        **_calibration(chosen),
    }


def _calibration(results: Sequence[EpisodeResult]) -> dict[str, Any]:
    """Return what can be said of confidences; nothing where an agent tells none."""
    told = [each for each in results if each.confidence is not None]
    confidences, outcomes = told_confidences(results)
    if not told:
        values = ("brier", "brier_reference", "ece", *map(_at, COVERAGES), "aurc")
        return {"told": 0} | dict.fromkeys(values)
    return {
        "told": len(told),
        **value_fields(told, [BRIER]),
        "brier_reference": brier_reference(outcomes),
        "ece": expected_calibration_error(confidences, outcomes),
        **{
            _at(part): success_at_coverage(confidences, outcomes, part)
            for part in COVERAGES
        },
        "aurc": risk_coverage_area(confidences, outcomes),
    }
