"""Runs as figures: the success rate of every route, with intervals."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from memorymaze.results.tables.paper_tables import table_rows
from memorymaze.results.tables.runs import STUDY_TITLES, MeasuredRun, place_title


def success_figure(runs: Sequence[MeasuredRun]) -> Figure:
    """Draw the success rate of every route of each run, with 95 % intervals.

    A panel for each study; within it the routes, and after them their mean.
    """
    rows = [row for row in table_rows(runs, "II") if row.run is not None]
    studies = list(dict.fromkeys(row.study for row in rows))
    figure = Figure(figsize=(8, 0.6 + 3.0 * len(studies)), layout="constrained")
    panels = figure.subplots(len(studies), squeeze=False)[:, 0]
    for panel, study in zip(panels, studies, strict=True):
        shown = [row for row in rows if row.study == study]
        titles = list(
            dict.fromkeys(
                "Mean" if row.is_mean else place_title(row.places) for row in shown
            )
        )
        width = 0.8 / len(runs)
        for number, run in enumerate(runs):
            own = [row.values["sr"] for row in shown if row.run is run]
            places = [index + (number + 0.5) * width - 0.4 for index in range(len(own))]
            means = [each.mean for each in own]
            below = [each.mean - _end(each.low, each.mean) for each in own]
            above = [_end(each.high, each.mean) - each.mean for each in own]
            panel.bar(
                places, means, width, yerr=[below, above], capsize=3, label=run.label
            )
        panel.set_xticks(range(len(titles)), titles, rotation=15, ha="right")
        panel.set_ylim(0, 1)
        panel.set_ylabel("success rate")
        panel.set_title(STUDY_TITLES.get(study, study))
    panels[0].legend(frameon=False)
    return figure


def _end(end: float | None, mean: float) -> float:
    """Return an interval's end; the mean where there is no interval."""
    return mean if end is None else end
