"""Fits the likelihoods of the guide on made floors, judged on kinds that are left out.

`python -m benchmarks.fit --out FOLDER` walks plans of made-up speakers with the guide and
keeps its map at every decision, with the way that would have been right. The loss is the
mean, over walks, of the negative logarithm of what the belief gives to the right way; no
walk is needed to try other values. L-BFGS-B moves all of them, as log odds or logarithms,
and pays for going far from the values that stand. What is best on the kinds of buildings
left out is kept (docs/lab/guide_fit.md).

Walk it before you believe it: the decisions are those of the guide as it is, and where it
went wrong the right way is the way back, so more doubt looks better here than it walks.
"""

import argparse
import json
import math
import pickle
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from benchmarks.decisions import Moment, Way, watched_walks
from benchmarks.made_walks import ToldWay, floor_seeds, told_ways
from memorymaze.agents.guide.alignments import AssumedStart
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.tellings import Tellings
from memorymaze.language.plans import RoutePlan
from memorymaze.world.construction import BUILDING_KINDS, BuildingKind

SPEAKERS = ("exact", "people", "people", "errors")
MOST_A_WALK = 2
"""Decisions that are kept of a walk."""
LEAST = 1e-3
"""What the right way counts for at least."""
AT_GOAL = 4.5
"""Metres on the map within which an ending is the right one."""
PRICE, FARTHEST = 0.004, 2.0
"""Nats for each squared unit that a value moves, and the most units that it may."""
DIFFERENCE = 0.1
"""Units between two values, for slopes."""


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A decision, with what the guide knew."""

    walk: str
    kind: str
    floor: bytes
    plan: RoutePlan
    starts: tuple[AssumedStart, ...]
    right: Way | None
    goal: tuple[float, float]


def snapshots(told: Sequence[ToldWay], seed: int, speakers: str) -> list[Snapshot]:
    """Walk ways with the guide and keep some decisions of each."""
    kept: list[Snapshot] = []

    def see(way: ToldWay, now: Moment) -> None:
        if now.right is None and not now.arrives:
            return
        telling = now.choice._tellings.all[0]  # pyright: ignore[reportPrivateUsage]
        kept.append(
            Snapshot(
                f"{speakers}/{way.name}",
                way.kind,
                pickle.dumps(telling.belief.floor),
                way.plan,
                tuple(telling.starts),
                now.right,
                now.goal,
            )
        )

    rng = np.random.default_rng(seed)
    chosen: list[Snapshot] = []
    for _ in watched_walks(told, seed, see):
        some = rng.permutation(len(kept))[:MOST_A_WALK]
        chosen += [kept[number] for number in sorted(some)]
        kept.clear()
    return chosen


def chance_of_right(snapshot: Snapshot, model: Likelihoods) -> float:
    """Return what the belief gives to what is right."""
    tellings = Tellings(pickle.loads(snapshot.floor), model)
    telling = tellings.add(snapshot.plan)
    telling.starts = list(snapshot.starts)
    tellings.update()
    right = 0.0
    if snapshot.right in tellings.frontiers:
        right += tellings.frontiers[snapshot.right].mass
    right += sum(
        each.mass
        for each in tellings.endings
        if math.dist(each.place, snapshot.goal) < AT_GOAL
    )
    return right / max(tellings.total, 1e-300)


def _losses(task: tuple[Sequence[int], Mapping[str, float]]) -> list[float]:
    part, values = task
    model = Likelihoods(**values)
    chances = (chance_of_right(_KEPT[number], model) for number in part)
    return [-math.log(max(each, LEAST)) for each in chances]


_KEPT: list[Snapshot] = []
"""Of the processes that weigh them, which have it from the one that walked."""
NAMES = tuple(each.name for each in fields(Likelihoods))
BY_HAND = {name: float(getattr(Likelihoods(), name)) for name in NAMES}


def _values(moved: NDArray[np.float64]) -> dict[str, float]:
    """Return likelihoods so many units from those by hand: log odds, or logarithms."""
    values: dict[str, float] = {}
    for name, units in zip(NAMES, moved, strict=True):
        by_hand = BY_HAND[name]
        if name == "again" or name.endswith(("_sd", "_rate")):
            values[name] = by_hand * math.exp(float(units))
        else:
            odds = by_hand / (1 - by_hand) * math.exp(float(units))
            values[name] = odds / (1 + odds)
    return values


class Fit:
    """One search, on some kinds of buildings."""

    def __init__(self, kept: Sequence[Snapshot], workers: int) -> None:
        """Take the decisions to be judged by."""
        _KEPT[:] = kept
        self._pool = get_context("fork").Pool(workers)

    def losses(self, moved: NDArray[np.float64], kinds: Sequence[str]) -> list[float]:
        """Return the mean loss over walks in buildings of some kinds, for rows of values."""
        mine = [at for at, each in enumerate(_KEPT) if each.kind in kinds]
        parts = [mine[at : at + 30] for at in range(0, len(mine), 30)]
        tasks = [(part, _values(row)) for row in moved for part in parts]
        found = self._pool.map(_losses, tasks, chunksize=1)
        means: list[float] = []
        for at in range(0, len(tasks), len(parts)):
            by_walk: dict[str, list[float]] = {}
            for part, losses in zip(parts, found[at:], strict=False):
                for number, loss in zip(part, losses, strict=True):
                    by_walk.setdefault(_KEPT[number].walk, []).append(loss)
            means.append(float(np.mean([np.mean(each) for each in by_walk.values()])))
        return means

    def search(self, kinds: Sequence[str], out: Path, steps: int) -> dict[str, float]:
        """Fit on some kinds; return the values that are best on the others."""
        others = [each for each in BUILDING_KINDS if each not in kinds]
        by_hand = self.losses(np.zeros((1, len(NAMES))), others)[0]
        best, least = np.zeros(len(NAMES)), by_hand

        def slopes(moved: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
            rows = np.vstack([moved, moved + DIFFERENCE * np.eye(len(NAMES))])
            loss, *beside = self.losses(rows, kinds)
            slope = (np.array(beside) - loss) / DIFFERENCE
            return loss + PRICE * float(moved @ moved), slope + 2 * PRICE * moved

        def note(moved: NDArray[np.float64]) -> None:
            nonlocal best, least
            left_out = self.losses(moved[None], others)[0]
            entry = {
                "fitted_on": list(kinds),
                "loss": self.losses(moved[None], kinds)[0],
                "left_out": left_out,
                "left_out_by_hand": by_hand,
                "values": _values(moved),
            }
            with out.open("a", encoding="utf-8") as log:
                log.write(json.dumps(entry) + "\n")
            if left_out < least:
                best, least = moved.copy(), left_out

        minimize(
            slopes,
            best.copy(),
            jac=True,
            method="L-BFGS-B",
            bounds=[(-FARTHEST, FARTHEST)] * len(NAMES),
            callback=note,
            options={"maxiter": steps, "maxfun": 2 * steps},
        )
        print(f"fitted on {', '.join(kinds)}: left out {by_hand:.4f} to {least:.4f}")
        return _values(best)


_Task = tuple[BuildingKind, str, int, int, Path]
"""Kind of building, speakers, floors of it, seed, and the folder for what is made."""


def _walked(task: _Task) -> list[Snapshot]:
    kind, speakers, made, seed, folder = task
    floors: dict[BuildingKind, range] = {kind: floor_seeds(seed, made)}
    told = list(told_ways(floors, speakers, 1, seed, folder / f"{speakers}-{seed}"))
    return snapshots(told, seed, speakers)


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fit")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument(
        "--made", type=int, default=4, help="floors a kind and speakers"
    )
    parser.add_argument("--seed", type=int, default=20, help="of floors and speakers")
    parser.add_argument("--steps", type=int, default=8)
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    log = options.out / "fit.jsonl"
    tasks: list[_Task] = [
        (kind, speakers, options.made, options.seed + number, options.out)
        for number, speakers in enumerate(SPEAKERS)
        for kind in BUILDING_KINDS
    ]
    with get_context("fork").Pool(options.workers) as pool:
        kept = [each for part in pool.imap(_walked, tasks) for each in part]
    print(f"{len(kept)} decisions of {len({each.walk for each in kept})} walks")
    fit = Fit(kept, options.workers)
    halves = BUILDING_KINDS[::2], BUILDING_KINDS[1::2]
    found = [fit.search(half, log, options.steps) for half in halves]
    print(f"{'':22} by hand   fitted on each half")
    for name in NAMES:
        print(
            f"{name:22} {BY_HAND[name]:7.3f} {found[0][name]:9.3f} {found[1][name]:9.3f}"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
