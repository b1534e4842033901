"""Runs as figures: the success rate of every route, with intervals."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from memorymaze.basics.tables import Row
from memorymaze.runs.tables.measures import SUCCESS, mean_fields
from memorymaze.runs.tables.runs import (
    MeasuredRun,
    groups_of_places,
    place_of,
    place_title,
    places_of,
    studies_of,
    study_title,
)


def success_figure(runs: Sequence[MeasuredRun]) -> Figure:
    """Draw the success rate of every route of each run, with 95 % intervals.

    A panel for each study; within it the routes, and after them their mean. A run has
    a bar only where it has episodes.
    """
    results = [result for run in runs for result in run.results]
    studies = studies_of(results)
    figure = Figure(figsize=(8, 0.6 + 3.0 * len(studies)), layout="constrained")
    panels = figure.subplots(len(studies), squeeze=False)[:, 0]
    for panel, study in zip(panels, studies, strict=True):
        _draw(panel, runs, study)
    panels[0].legend(frameon=False)
    return figure


def _draw(panel: Axes, runs: Sequence[MeasuredRun], study: str) -> None:
    places = places_of((result for run in runs for result in run.results), study)
    groups = groups_of_places(places)
    width = 0.8 / len(runs)
    for number, run in enumerate(runs):
        bars: dict[float, Row] = {}
        for index, group in enumerate(groups):
            own = [r for r in run.results if r.study == study and place_of(r) in group]
            if own:
                people, cells = [r.participant for r in own], [*map(place_of, own)]
                found = mean_fields([SUCCESS], own, people, cells)
                bars[index + (number + 0.5) * width - 0.4] = found
        means = [each["sr"] for each in bars.values()]
        # Where no interval can be told, none is drawn.
        low = [_end(each["sr_low"], each["sr"]) for each in bars.values()]
        high = [_end(each["sr_high"], each["sr"]) for each in bars.values()]
        error = [np.subtract(means, low), np.subtract(high, means)]
        panel.bar([*bars], means, width, yerr=error, capsize=3, label=run.label)
    titles = ["Mean" if len(group) > 1 else place_title(group) for group in groups]
    panel.set_xticks(range(len(titles)), titles, rotation=15, ha="right")
    panel.set_ylim(0, 1)
    panel.set_ylabel("success rate")
    panel.set_title(study_title(study))


def _end(end: float | None, mean: float) -> float:
    return mean if end is None else end
