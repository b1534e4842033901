"""How sure agents were, and what came of it: claims, calibration, risk against coverage."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.metrics.calibration import (
    BINS,
    brier_reference,
    brier_score,
    expected_calibration_error,
    risk_coverage_area,
    success_at_coverage,
)
from memorymaze.runs.metrics.success import SUCCESS_DISTANCE
from memorymaze.runs.tables.measures import (
    SUCCESS,
    Fact,
    Quantity,
    mean_fields,
)
from memorymaze.runs.tables.questions import RowGroup, TableQuestion
from memorymaze.runs.tables.reach import within_ways
from memorymaze.runs.tables.runs import (
    BY_STUDY_AND_RUN,
    MeasuredRun,
    by_study_and_run,
    place_of,
)

CLAIMS = (
    SUCCESS,
    Quantity(
        "claims", "claimed", better=None, of=lambda each: float(each.claims_arrival)
    ),
    Quantity(
        "false_arrivals",
        "false",
        better="lower",
        of=lambda each: float(each.is_false_arrival),
    ),
    Quantity(
        "admitted_failures",
        "admitted",
        better=None,
        of=lambda each: float(each.gave_up and not each.success),
    ),
    Quantity(
        "gave_up_there",
        "gave up there",
        better="lower",
        of=lambda each: float(each.gave_up and each.success),
    ),
)
WALKED = Quantity(
    "ways_walked",
    "walked",
    better="lower",
    of=lambda each: each.path_length / each.way_m if each.way_m else 0.0,
)
BRIER = Quantity(
    "brier",
    "Brier",
    better="lower",
    of=lambda each: brier_score([each.confidence or 0.0], [each.success]),
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


def _of_told(
    measure: Callable[[list[float], list[bool]], float],
) -> Callable[[Sequence[EpisodeResult]], float | None]:
    """Return what measures confidences; None where an agent tells none."""

    def measured(results: Sequence[EpisodeResult]) -> float | None:
        confidences, outcomes = told_confidences(results)
        return measure(confidences, outcomes) if confidences else None

    return measured


def _groups(runs: Sequence[MeasuredRun]) -> Iterator[RowGroup]:
    for about, run, results in by_study_and_run(runs):
        told = [each for each in results if each.confidence is not None]
        people = [each.participant for each in told]
        brier = mean_fields([BRIER], told, people) if told else {"brier": None}
        near = run.record.settings.success_distance
        means = [*CLAIMS, *within_ways(near), WALKED]
        yield RowGroup({**about, **brier}, results, means)


CONFIDENCE = TableQuestion(
    shows="false arrivals, admitted failures, how sure the agent was and whether it was "
    "right",
    title="Confidence: what agents claimed, and what came of it",
    name="confidence",
    columns=(
        *BY_STUDY_AND_RUN,
        *CLAIMS,
        *within_ways(SUCCESS_DISTANCE),
        WALKED,
        Fact("told", "told", of=lambda results: len(told_confidences(results)[0])),
        BRIER,
        Fact(
            "brier_reference",
            "of the mean",
            digits=2,
            of=_of_told(lambda _, outcomes: brier_reference(outcomes)),
        ),
        Fact(
            "ece",
            "ECE",
            digits=2,
            better="lower",
            of=_of_told(expected_calibration_error),
        ),
        *(
            Fact(
                f"sr_at_coverage_{part:g}",
                f"{100 * part:g} %",
                digits=2,
                better="higher",
                of=_of_told(partial(success_at_coverage, coverage=part)),
            )
            for part in (0.25, 0.5, 0.75, 1.0)
        ),
        Fact("aurc", "AURC", digits=2, better="lower", of=_of_told(risk_coverage_area)),
    ),
    groups=_groups,
    cell=place_of,
    key=(KEY,),
)
