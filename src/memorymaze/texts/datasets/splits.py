"""Which building, and which route of it, is in which split, as in R2R.

R2R (Anderson et al., CVPR 2018) has 90 buildings: 61 to train on, 11 for `val_unseen`
and 18 for `test`. `val_seen` has other paths in buildings of `train`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from memorymaze.world.construction import BUILDING_KINDS, BuildingKind

Split = Literal["train", "val_seen", "val_unseen", "test"]
SPLITS: tuple[Split, ...] = ("train", "val_seen", "val_unseen", "test")
SHARE_OF_VAL_UNSEEN, SHARE_OF_TEST = 11 / 90, 18 / 90
SEEN_EVERY = 3
"""One of so many buildings of `train` has a route in `val_seen`."""
FEWEST = 3
"""Buildings: one to train on, one for `val_unseen`, one for `test`."""
SEEDS_APART = 10_000
"""Buildings of a dataset at most; the seeds of the next dataset begin so much higher."""


@dataclass(frozen=True, slots=True)
class PlannedBuilding:
    """A building before it is made."""

    kind: BuildingKind
    seed: int
    split: Split
    """Of the whole building, or of all its routes but one."""
    held_out: float | None
    """Which of its routes is in `val_seen`, from 0 (the first) to below 1; None for
    none."""

    def splits(self, routes: Sequence[str]) -> dict[str, Split]:
        """Return the split of each route of the building."""
        split: dict[str, Split] = dict.fromkeys(routes, self.split)
        if self.held_out is not None:
            split[routes[int(self.held_out * len(routes))]] = "val_seen"
        return split


def plan_buildings(count: int, seed: int) -> list[PlannedBuilding]:
    """Plan the buildings of a dataset; kinds take turns, and are spread over the splits.

    Args:
        count: How many; at least `FEWEST`.
        seed: Of the dataset.
    """
    kinds, rng = BUILDING_KINDS, np.random.default_rng([seed, count])
    # The place of a building within its kind, from 0 to 1, parts every kind alike.
    level = np.empty(count)
    for first in range(min(len(kinds), count)):
        members = np.arange(first, count, len(kinds))
        places = rng.permutation(len(members)) + rng.random()
        level[members] = places / len(members)
    tests = max(1, round(count * SHARE_OF_TEST))
    unseen = max(1, round(count * SHARE_OF_VAL_UNSEEN))
    order = np.argsort(level, kind="stable").tolist()
    split_of: dict[int, Split] = dict.fromkeys(order, "train")
    split_of.update(dict.fromkeys(order[:tests], "test"))
    split_of.update(dict.fromkeys(order[tests : tests + unseen], "val_unseen"))
    seen = set(order[tests + unseen :: SEEN_EVERY])
    held_out = rng.random(count)
    return [
        PlannedBuilding(
            kind=kinds[number % len(kinds)],
            seed=seed * SEEDS_APART + number,
            split=split_of[number],
            held_out=float(held_out[number]) if number in seen else None,
        )
        for number in range(count)
    ]
