"""Means of results over cells of a table, with participant-bootstrap intervals."""

from collections.abc import Sequence

import numpy as np

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.metrics.aggregate import Estimate, participant_bootstrap

MEASURES = ("sr", "osr", "spd", "cls")
"""What the paper's tables show of an episode."""


def estimate_means(
    cells: Sequence[Sequence[EpisodeResult]], seed: int = 0
) -> dict[str, Estimate]:
    """Return the mean of every measure over cells, with participant-bootstrap intervals.

    The mean is the unweighted mean of the cells' means, as the paper averages over
    routes; for one cell it is the cell's mean. The intervals hold 95 % of 10,000 draws;
    see `metrics.aggregate.participant_bootstrap`.

    Args:
        cells: Results that belong together, such as those of one route; none empty.
        seed: Of the draws.

    Raises:
        ValueError: There is no cell, or one is empty.
    """
    if not cells or not all(cells):
        raise ValueError("expected at least one episode in every cell")
    rows = [(result, number) for number, cell in enumerate(cells) for result in cell]
    estimates = participant_bootstrap(
        [
            (result.success, result.oracle_success, result.spd, result.cls)
            for result, _ in rows
        ],
        [result.participant for result, _ in rows],
        np.random.default_rng(seed),
        cells=[number for _, number in rows],
    )
    return dict(zip(MEASURES, estimates, strict=True))
