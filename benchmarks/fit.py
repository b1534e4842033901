"""The guide's parameters, fitted on SAIL: the only descriptions here that people wrote.

Every usable paragraph is read by the grammar and followed in the mind on the true map of
its maze, from every heading. What is maximised is the mean logarithm of the share of the
belief at the goal: `python -m benchmarks.fit --sail DIR` (docs/guide_fit.md).

The shipped texts are a check only: they were written to a brief that drew their errors by
a rule, so that a fit on them would return the rule.
"""

import argparse
import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import expit, logit

from benchmarks.reading import recorded_plans
from benchmarks.true_maps import TrueMaps, ends_at, follow, in_frame, phrases_of
from memorymaze.agents.agent import Journal
from memorymaze.agents.guide.alignments import Start
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.starts import starts_ahead, starts_any_way
from memorymaze.agents.plan_readers import GrammarReader
from memorymaze.agents.walking.floor_map import FloorMap, Point
from memorymaze.geometry.pose import Pose
from memorymaze.instructions import Episode, load_corpus
from memorymaze.instructions.records import DEVELOPED, HELD_OUT, is_of_split
from memorymaze.instructions.sail import sail_corpus
from memorymaze.metrics.success import SUCCESS_DISTANCE
from memorymaze.robot.api import DETECTION_RANGE
from memorymaze.routes import RoutePlan
from memorymaze.sites import Site
from memorymaze.tables import Column, Table

FITTED = (
    *("pass_untold", "pass_fitting", "corner_untold", "choice_untold", "turn_untold"),
    *("wrong_side", "no_turn", "wrong_place", "again", "count_right", "one_side"),
    *("kind_right", "invented", "detected", "side_right", "mistaken"),
    *("common_rate", "rare_rate", "passed_by", "arrival_open"),
)
"""What SAIL can tell. It has no bends and no signs, and its lengths are counted in places."""
ABOVE_ZERO = frozenset({"again", "common_rate", "rare_rate"})
"""Those that are no probabilities."""
FLOOR = 1e-3
"""Share of the belief that every place has, so that unreadable texts do not rule."""
PRIOR_SD = 0.3
"""Of each parameter about its value set by hand, as a log odds ratio or a logarithm."""
STEP = 0.3
"""Of the differences, on that scale."""
ROUNDS = (1.0, 0.5)
"""How far parameters may go on that scale from where the likelihood was made linear."""
LEAST_WEIGHT = 3e-3
"""Of alignments followed: a fit follows each text dozens of times."""
MATTERS = 0.02
"""Slope of a paragraph's objective from which on a parameter matters to it."""

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Case:
    """A plan, the true map it is told on, and where it should lead."""

    id: str
    writer: str
    site: str
    half: str
    has_error: bool
    plan: RoutePlan
    floor: FloorMap
    starts: list[Start]
    goal: Point
    within: float
    pointing_signs: frozenset[int]

    def share(self, model: Likelihoods) -> float:
        """Return the share of the belief at the goal."""
        return self.followed(model)[0]

    def followed(self, model: Likelihoods) -> tuple[float, bool]:
        """Return the share of the belief at the goal, and whether it is the likeliest."""
        found = follow(
            self.plan,
            self.floor,
            self.starts,
            model,
            set(self.pointing_signs),
            least_weight=LEAST_WEIGHT,
        )
        best = found.likeliest
        if best is None:
            return 0.0, False
        share = found.share_at(self.goal, self.within)
        return share, ends_at(best, self.goal, self.within)


class Cases:
    """Makes cases of episodes, with the maps of their sites."""

    def __init__(self, sites: Mapping[str, Site], detection_range: float) -> None:
        """Take the sites, and how far one sees on them."""
        self._sites, self._range = sites, detection_range
        self._maps: dict[str, TrueMaps] = {}

    def case(self, episode: Episode, plan: RoutePlan, within: float) -> Case:
        """Return what is to be found from where an episode starts."""
        told = episode.instruction
        if told.site not in self._maps:
            site = self._sites[told.site]
            self._maps[told.site] = TrueMaps(site, detection_range=self._range)
        maps = self._maps[told.site]
        start = episode.start
        if told.followers is not None:
            start = Pose(start.x, start.y, 0.0)
        floor = maps.floor_map(start, phrases_of(plan))
        at = maps.crossing_at(start.x, start.y)
        if told.followers is not None:
            starts = starts_any_way(plan, floor, at)
        else:
            starts = starts_ahead(Likelihoods(), floor, at)
        return Case(
            told.id,
            told.participant,
            told.site,
            DEVELOPED if is_of_split(told, DEVELOPED) else HELD_OUT,
            bool(told.failures),
            plan,
            floor,
            starts,
            in_frame(start, episode.goal),
            within,
            frozenset(maps.pointing_signs),
        )


def sail_cases(folder: Path, sample: int | None) -> Iterator[Case]:
    """Yield SAIL's usable paragraphs as the grammar reads them, or so many of them."""
    corpus, grammar = sail_corpus(folder), GrammarReader()
    distance, seen = corpus.success_distance, corpus.detection_range
    assert distance is not None
    assert seen is not None
    cases = Cases(corpus.sites, seen)
    told = {
        each.instruction.id: each
        for each in corpus.episodes
        if each.instruction.followers is not None and each.instruction.followers.usable
    }
    ordered = sorted(
        told.values(), key=lambda each: (each.instruction.participant, each.id)
    )
    every = 1 if sample is None else max(len(ordered) / sample, 1.0)
    for number in np.arange(0, len(ordered), every).astype(int):
        plan = grammar.read(ordered[number].instruction.text, Journal())
        yield cases.case(ordered[number], plan, distance)


def shipped_cases(sample: int | None) -> Iterator[Case]:
    """Yield the shipped texts with their recorded plans, or so many of them."""
    corpus, plans = load_corpus(), recorded_plans("plans")
    cases = Cases(corpus.sites, DETECTION_RANGE)
    every = 1 if sample is None else max(len(corpus.episodes) // sample, 1)
    for episode in corpus.episodes[::every]:
        yield cases.case(episode, plans[episode.instruction.id], SUCCESS_DISTANCE)


# -- parameters as a vector


def vector_of(model: Likelihoods) -> Vector:
    """Return the fitted parameters as log odds, or as logarithms."""
    values = {name: getattr(model, name) for name in FITTED}
    return np.array([
        math.log(value) if name in ABOVE_ZERO else float(logit(value))
        for name, value in values.items()
    ])


def model_of(vector: Vector) -> Likelihoods:
    """Return parameters, those that are not fitted as set by hand."""
    values = {
        name: float(np.exp(value) if name in ABOVE_ZERO else expit(value))
        for name, value in zip(FITTED, vector, strict=True)
    }
    return replace(Likelihoods(), **values)


# -- maximising


@dataclass(frozen=True, slots=True)
class Linear:
    """The log odds of each case's share at the goal, linear in the parameters."""

    about: Vector
    reach: float
    """How far from there it is to be trusted."""
    value: Vector
    slopes: NDArray[np.float64]
    """Shape (cases, parameters)."""

    def best(self, rows: NDArray[np.intp], prior: Vector) -> Vector:
        """Return what is best for some cases, not far from where it is linear."""

        def loss(vector: Vector) -> tuple[float, Vector]:
            share = expit(self.value[rows] + self.slopes[rows] @ (vector - self.about))
            off = (vector - prior) / PRIOR_SD
            known = (1 - FLOOR) * share + FLOOR
            slope = (1 - FLOOR) * share * (1 - share) / known
            gradient = off / PRIOR_SD - slope @ self.slopes[rows]
            return float(0.5 * off @ off - np.log(known).sum()), gradient

        near = [(each - self.reach, each + self.reach) for each in self.about]
        found = minimize(loss, self.about, jac=True, method="L-BFGS-B", bounds=near)
        return np.asarray(found.x)


def linear_about(cases: Sequence[Case], vector: Vector, reach: float) -> Linear:
    """Follow all cases, and again with each parameter a little larger."""
    here = _log_odds(cases, vector)
    slopes = np.empty((len(cases), len(vector)))
    for number in range(len(vector)):
        print(f"  {FITTED[number]}", file=sys.stderr)
        moved = vector.copy()
        moved[number] += STEP
        slopes[:, number] = (_log_odds(cases, moved) - here) / STEP
    return Linear(vector, reach, here, slopes)


def _log_odds(cases: Sequence[Case], vector: Vector) -> Vector:
    model = model_of(vector)
    shares = np.array([case.share(model) for case in cases])
    return logit(shares.clip(1e-6, 1 - 1e-6))


@dataclass(frozen=True, slots=True)
class Fit:
    """Parameters fitted on all cases, and with each group of them left out."""

    vector: Vector
    linear: Linear
    left_out: dict[str, Vector]
    """By the name of a writer or a map."""

    def interval(self) -> tuple[Vector, Vector]:
        """Return 95 % intervals by the curvature, prior included, the others held."""
        slopes = objective_slopes(self.linear)
        curvature = np.square(slopes).sum(axis=0) + PRIOR_SD**-2
        half = 1.96 / np.sqrt(curvature)
        return self.vector - half, self.vector + half


def fit(cases: Sequence[Case]) -> Fit:
    """Fit all cases, and again without each writer and each map.

    The likelihood is made linear about the values set by hand, then about what is best
    for all cases; what is left out has a say only in where that is.
    """
    prior, everything = _by_hand(), np.arange(len(cases))
    groups = {name: _others(cases, name) for name in _groups(cases)}
    vector = prior
    for reach in ROUNDS:
        linear = linear_about(cases, vector, reach)
        left_out = {name: linear.best(rows, prior) for name, rows in groups.items()}
        vector = linear.best(everything, prior)
    return Fit(vector, linear, left_out)


def _by_hand() -> Vector:
    return vector_of(Likelihoods())


def _groups(cases: Sequence[Case]) -> list[str]:
    return [
        *sorted({each.writer for each in cases}),
        *sorted({each.site for each in cases}),
    ]


def _others(cases: Sequence[Case], group: str) -> NDArray[np.intp]:
    return np.flatnonzero([group not in {each.writer, each.site} for each in cases])


# -- tables


def parameter_rows(found: Fit) -> Iterator[dict[str, object]]:
    """Yield each parameter with its values and what there is to tell it."""
    low, high = found.interval()
    by_hand, fitted = Likelihoods(), model_of(found.vector)
    ends = model_of(low), model_of(high)
    for number, name in enumerate(FITTED):
        slopes = np.abs(objective_slopes(found.linear)[:, number])
        yield {
            "parameter": name,
            "by_hand": getattr(by_hand, name),
            "fitted": getattr(fitted, name),
            "fitted_low": getattr(ends[0], name),
            "fitted_high": getattr(ends[1], name),
            "paragraphs": int((slopes > MATTERS).sum()),
            "information": float(np.square(slopes).sum() * PRIOR_SD**2),
        }


def objective_slopes(linear: Linear) -> NDArray[np.float64]:
    """Return the slopes of each case's objective, shape (cases, parameters)."""
    share = expit(linear.value)
    factor = (1 - FLOOR) * share * (1 - share) / ((1 - FLOOR) * share + FLOOR)
    return factor[:, np.newaxis] * linear.slopes


def comparison_row(
    group: str, name: str, cases: Sequence[Case], model: Likelihoods
) -> dict[str, object]:
    """Return how well values set by hand and fitted ones find the goals of cases."""
    row: dict[str, object] = {"group": group, "name": name, "n": len(cases)}
    for which, each in (("by_hand", Likelihoods()), ("fitted", model)):
        found = [case.followed(each) for case in cases]
        shares = np.array([share for share, _ in found])
        row[f"log_{which}"] = float(np.log((1 - FLOOR) * shares + FLOOR).mean())
        row[f"first_{which}"] = float(np.mean([is_first for _, is_first in found]))
    return row


def left_out_rows(cases: Sequence[Case], found: Fit) -> Iterator[dict[str, object]]:
    """Yield what comes of each writer's and map's texts by values fitted without them."""
    for what, told in (
        ("writer left out", {each.writer: f" ({each.half})" for each in cases}),
        ("map left out", {each.site: "" for each in cases}),
    ):
        rows = [
            comparison_row(
                what,
                f"{name}{half}",
                [each for each in cases if name in {each.writer, each.site}],
                model_of(found.left_out[name]),
            )
            for name, half in sorted(told.items())
        ]
        counts = [int(str(row["n"])) for row in rows]
        means = {
            name: float(
                np.average([float(str(row[name])) for row in rows], weights=counts)
            )
            for name in rows[0]
            if name.startswith(("log_", "first_"))
        }
        yield from [*rows, {"group": what, "name": "all", "n": sum(counts), **means}]


def shipped_rows(
    cases: Sequence[Case], model: Likelihoods
) -> Iterator[dict[str, object]]:
    """Yield what comes of the shipped texts, the half that was not read first."""
    for half in (HELD_OUT, DEVELOPED):
        for site in sorted({each.site for each in cases}):
            for has_error in (False, True):
                these = [
                    each
                    for each in cases
                    if (each.half, each.site, each.has_error) == (half, site, has_error)
                ]
                if these:
                    texts = "with an error" if has_error else "correct"
                    group = f"written to a brief, {half}"
                    yield comparison_row(group, f"{site}, {texts}", these, model)


def comparison_table(rows: Sequence[dict[str, object]]) -> Table:
    return Table(
        "Belief at the goal, by values set by hand and fitted on SAIL without these texts",
        (
            Column("group", "Texts", role="group"),
            Column("name", "Of", role="label"),
            Column("n", "n"),
            Column("log_by_hand", "log, by hand", digits=3, better="higher"),
            Column("log_fitted", "log, fitted", digits=3, better="higher"),
            Column("first_by_hand", "Likeliest, by hand", digits=3, better="higher"),
            Column("first_fitted", "Likeliest, fitted", digits=3, better="higher"),
        ),
        tuple(rows),
        notes=(
            "Log: mean logarithm of the share of the belief at the goal, at least "
            f"{FLOOR:g}. Likeliest: share of texts whose likeliest ending is the goal.",
        ),
        name="fit_check",
    )


def parameter_table(rows: Sequence[dict[str, object]]) -> Table:
    ends = ("fitted_low", "fitted_high")
    return Table(
        f"Parameters of the guide ({len(fields(Likelihoods))}, of which {len(FITTED)} "
        "fitted)",
        (
            Column("parameter", "Parameter", role="label"),
            Column("by_hand", "By hand", digits=3),
            Column("fitted", "Fitted", digits=3, interval=ends),
            Column("paragraphs", "Paragraphs"),
            Column("information", "Information", digits=1),
        ),
        tuple(rows),
        notes=(
            "Intervals: 95 %, by the curvature. Paragraphs: those to which the "
            "parameter matters. Information: sum of squared slopes, in units of the "
            f"prior, whose standard deviation is {PRIOR_SD:g} about the values by hand.",
        ),
        name="fit",
    )


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fit")
    parser.add_argument("--sail", type=Path, required=True, metavar="DIR")
    parser.add_argument(
        "--sample", type=int, default=150, metavar="N", help="paragraphs to fit on"
    )
    parser.add_argument(
        "--shipped", type=int, metavar="N", help="only so many shipped texts as a check"
    )
    options = parser.parse_args()
    cases = list(sail_cases(options.sail, options.sample))
    found = fit(cases)
    print(parameter_table(list(parameter_rows(found))))
    rows = list(left_out_rows(cases, found))
    rows += shipped_rows(list(shipped_cases(options.shipped)), model_of(found.vector))
    print(comparison_table(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
