"""Two runs side by side on the same instructions, with a paired test."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.settings import differences
from memorymaze.metrics.aggregate import Estimate, participant_bootstrap
from memorymaze.metrics.paired import sign_flip_test
from memorymaze.results.tables.rows import MeasuredRun, Place, places_of

COMPARED = ("sr", "osr", "spd", "cls", "ndtw")
"""Measures that are compared."""


@dataclass(frozen=True, slots=True)
class Outcomes:
    """How often both, one or none of two agents arrived."""

    both: int
    only_first: int
    only_second: int
    neither: int


@dataclass(frozen=True, slots=True)
class ComparisonRow:
    """Two agents on a route, or on the mean over the routes of a study."""

    study: str
    places: tuple[Place, ...]
    episodes: int
    participants: int
    outcomes: Outcomes
    first: dict[str, float]
    """Means of the first run, by the names in `COMPARED`."""
    second: dict[str, float]
    """Means of the second run."""
    difference: dict[str, Estimate]
    """Second minus first, with 95 % intervals of a paired bootstrap."""
    p_value: dict[str, float]
    """Two-sided, by flipping the signs of whole participants."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """All there is to say of two runs."""

    first: MeasuredRun
    second: MeasuredRun
    rows: tuple[ComparisonRow, ...]
    only_in_first: int
    """Episodes that the second run lacks; left out."""
    only_in_second: int
    settings: tuple[str, ...]
    """In what the runs differ besides the agent; empty for a fair comparison."""


def compare_runs(first: MeasuredRun, second: MeasuredRun, seed: int = 0) -> Comparison:
    """Compare two runs on the episodes that both have.

    Raises:
        RunFolderError: No episode is in both runs.
    """
    there = {result.episode_id: result for result in first.results}
    here = {result.episode_id: result for result in second.results}
    shared = sorted(there.keys() & here.keys())
    if not shared:
        raise RunFolderError(
            f"{first.name} and {second.name}: expected runs over the same instructions, "
            "got no episode that both have"
        )
    pairs = [(there[key], here[key]) for key in shared]
    rows: list[ComparisonRow] = []
    for study in ("online", "onsite"):
        places = places_of((one for one, _ in pairs), study)
        groups = [[place] for place in places]
        if len(places) > 1:
            groups.append(places)
        rows += [_row(pairs, study, group, seed) for group in groups]
    return Comparison(
        first=first,
        second=second,
        rows=tuple(rows),
        only_in_first=len(there) - len(shared),
        only_in_second=len(here) - len(shared),
        settings=tuple(
            line
            for line in differences(first.record.settings, second.record.settings)
            if not line.startswith(("agent.", "limit:", "episodes:"))
        ),
    )


def _row(
    pairs: Sequence[tuple[EpisodeResult, EpisodeResult]],
    study: str,
    places: Sequence[Place],
    seed: int,
) -> ComparisonRow:
    chosen = [
        (one, two)
        for one, two in pairs
        if one.study == study and Place(one.site, one.route) in places
    ]
    cells = [Place(one.site, one.route) for one, _ in chosen]
    participants = [one.participant for one, _ in chosen]
    before = np.array([_values(one) for one, _ in chosen])
    after = np.array([_values(two) for _, two in chosen])
    rng = np.random.default_rng(seed)
    estimates = participant_bootstrap(after - before, participants, rng, cells=cells)
    p_values = sign_flip_test(after - before, participants, rng, cells=cells)
    counts = Counter((one.success, two.success) for one, two in chosen)
    return ComparisonRow(
        study=study,
        places=tuple(places),
        episodes=len(chosen),
        participants=len(set(participants)),
        outcomes=Outcomes(
            both=counts[True, True],
            only_first=counts[True, False],
            only_second=counts[False, True],
            neither=counts[False, False],
        ),
        first=_means(before, cells),
        second=_means(after, cells),
        difference=dict(zip(COMPARED, estimates, strict=True)),
        p_value=dict(zip(COMPARED, p_values, strict=True)),
    )


def _values(result: EpisodeResult) -> tuple[float, ...]:
    return (
        float(result.success),
        float(result.oracle_success),
        result.spd,
        result.cls,
        result.ndtw,
    )


def _means(values: np.ndarray, cells: Sequence[Place]) -> dict[str, float]:
    """Return the unweighted mean over cells of the means within them."""
    by_cell = [
        values[[index for index, each in enumerate(cells) if each == cell]].mean(axis=0)
        for cell in dict.fromkeys(cells)
    ]
    means = np.mean(by_cell, axis=0).tolist()
    return dict(zip(COMPARED, means, strict=True))
