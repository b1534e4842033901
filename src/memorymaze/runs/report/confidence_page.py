"""What the page on confidence shows: calibration, and risk against coverage."""

from collections.abc import Sequence
from dataclasses import dataclass

from memorymaze.runs.metrics.calibration import (
    ReliabilityBin,
    expected_calibration_error,
    reliability,
    risk_coverage,
    risk_coverage_area,
    success_at_coverage,
)
from memorymaze.runs.report.sources import ReportRun
from memorymaze.runs.tables.confidence import told_confidences
from memorymaze.runs.tables.runs import studies_of
from memorymaze.world.drawing.svg import path_data


@dataclass(frozen=True, slots=True)
class ConfidencePlots:
    """A run in a study, whose agent told how sure it was; plots are 100 wide and high."""

    run: ReportRun
    study: str
    told: int
    """Episodes with a confidence."""
    bins: tuple[ReliabilityBin, ...]
    ece: float
    risk_line: str
    """Path of the risk against coverage."""
    best_line: str
    """That of the best possible order of the episodes."""
    aurc: float
    risk: float
    """Share of failures among all of them."""
    risk_of_half: float
    """The same among the more confident half."""


def plot_confidence(runs: Sequence[ReportRun]) -> list[ConfidencePlots]:
    """Return the plots study by study, of the runs whose agents tell a confidence."""
    studies = studies_of(each for run in runs for each in run.results)
    found = (_plots(run, study) for study in studies for run in runs)
    return [each for each in found if each is not None]


def _plots(run: ReportRun, study: str) -> ConfidencePlots | None:
    own = [each for each in run.results if each.study == study]
    confidences, outcomes = told_confidences(own)
    if not confidences:
        return None
    return ConfidencePlots(
        run=run,
        study=study,
        told=len(outcomes),
        bins=tuple(reliability(confidences, outcomes)),
        ece=expected_calibration_error(confidences, outcomes),
        risk_line=_risk_line(confidences, outcomes),
        best_line=_risk_line(outcomes, outcomes),
        aurc=risk_coverage_area(confidences, outcomes),
        risk=1 - sum(outcomes) / len(outcomes),
        risk_of_half=1 - success_at_coverage(confidences, outcomes, 0.5),
    )


def _risk_line(confidences: Sequence[float], outcomes: Sequence[bool]) -> str:
    risks = risk_coverage(confidences, outcomes)
    # The first risk holds from no coverage on, so that one episode has a line as well.
    return path_data([
        (100 * number / len(risks), 100 * risk)
        for number, risk in enumerate([risks[0], *risks])
    ])
