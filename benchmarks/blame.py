"""Which part of the guide's belief makes it leave a way that it was told rightly.

`python -m benchmarks.blame [--speakers people] [--made K]` walks right plans on made floors
(`benchmarks.made_walks`). At the first decision of a walk that is not the way told, the
belief is worked out once more without each kind of evidence: by how many nats did that
evidence make the wrong way better than the right one, and would the right one have been
taken without it?
"""

import math
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from unittest.mock import patch

import numpy as np

from benchmarks.decisions import Moment, Step, watched_walks
from benchmarks.made_walks import ToldWay, made_walks_parser, told_by
from memorymaze.agents.guide import arriving, belief, recognising, said_of_legs
from memorymaze.agents.guide.alignments import Frontier, Segment
from memorymaze.agents.guide.arriving import Ending
from memorymaze.agents.guide.choosing import Choice
from memorymaze.agents.guide.likelihoods import Weights
from memorymaze.agents.guide.things import Things
from memorymaze.basics.tables import Column, Table

ARRIVED = 3.0


def _any_turn(_: object, angle: float) -> float:
    return 1.0 if abs(angle) > 0.26 else 0.0


def _as_before(_: object, weights: Weights, *__: object) -> Weights:
    return weights


def _without_signs(_: object, segment: Segment, *__: object) -> Weights:
    return segment.weights


NEUTRAL: Mapping[str, tuple[tuple[object, str, Callable[..., object]], ...]] = {
    "length": (
        (said_of_legs, "length_ratio", lambda *_: 1.0),
        (said_of_legs, "length_to_come", lambda *_: 1.0),
        (arriving, "length_ratio", lambda *_: 1.0),
    ),
    "no length told": (
        (said_of_legs, "untold_length", lambda *_: 1.0),
        (arriving, "untold_length", lambda *_: 1.0),
    ),
    "count": (
        (said_of_legs, "ordinal_ratio", lambda *_: 1.0),
        (said_of_legs, "ordinal_to_come", lambda *_: 1.0),
    ),
    "passings": (
        (said_of_legs, "passings_ratio", lambda *_, **__: 1.0),
        (arriving, "passings_ratio", lambda *_, **__: 1.0),
    ),
    "kind of place": (
        (said_of_legs, "junction_ratio", lambda *_: 1.0),
        (arriving, "junction_ratio", lambda *_: 1.0),
    ),
    "angle": ((belief, "way_ratio", _any_turn),),
    "things": (
        (Things, "weigh", _as_before),
        (Things, "so_far", lambda *_: 1.0),
        (Things, "ahead", lambda *_: 1.0),
    ),
    "destination seen": (
        (recognising.Recognition, "seen", lambda *_: 1.0),
        (arriving.Arrivals, "_ahead", lambda *_: iter(())),
    ),
    "signs": ((belief.Belief, "_by_signs", _without_signs),),
    "plain turn": ((said_of_legs.SaidOfLegs, "plain_turn_fits", lambda *_: False),),
}
"""What stands for each kind of evidence where it is to say nothing."""
PRICE = "metres"


@dataclass(frozen=True, slots=True)
class FirstMistake:
    """The first decision of a walk that was not the way told."""

    what: str
    """`turned`, `stopped` or `left the place`."""
    probability: float
    """Of the right one in the belief."""
    nats: Mapping[str, float] = field(default_factory=dict[str, float])
    """By which each evidence made the wrong one the better; nothing if that is not known."""
    mended: frozenset[str] = frozenset()
    """Evidence without which the right one would have been the better."""


class _Witness:
    """Finds the first mistake of a walk."""

    def __init__(self) -> None:
        self.found: FirstMistake | None = None

    def see(self, now: Moment) -> None:
        """Compare a decision with the way."""
        if self.found is not None:
            return
        step = now.step
        if isinstance(step, Ending) or step is None:
            near = step is not None and math.dist(step.place, now.goal) < 2 * ARRIVED
            if not near:
                self._note(now.choice, "stopped", step)
        elif now.at_goal and now.arrives:
            self._note(now.choice, "left the place", step)
        elif now.right is not None:
            right = now.choice._tellings.frontiers.get(now.right)  # pyright: ignore[reportPrivateUsage]
            if right is not None and (step.at, step.exit) != now.right:
                self._note(now.choice, "turned", step, right)

    def _note(
        self,
        choice: Choice,
        what: str,
        step: Step,
        right: Frontier | None = None,
    ) -> None:
        tellings = choice._tellings  # pyright: ignore[reportPrivateUsage]
        if right is None or not isinstance(step, Frontier):
            self.found = FirstMistake(what, math.nan)
            return
        wrong = step.at, step.exit
        key = right.at, right.exit

        def better() -> float:
            masses = [
                tellings.frontiers[each].mass if each in tellings.frontiers else 0.0
                for each in (wrong, key)
            ]
            return math.log(max(masses[0], 1e-30) / max(masses[1], 1e-30))

        paid = choice.value(step) - choice.value(right) - better()
        now = better()
        nats: dict[str, float] = {PRICE: paid}
        share = right.mass / tellings.total
        for name, stands_for in NEUTRAL.items():
            with ExitStack() as stack:
                for where, attribute, neutral in stands_for:
                    stack.enter_context(patch.object(where, attribute, neutral))
                tellings.update()
                nats[name] = now - better()
        tellings.update()
        choice.update()
        mended = {name for name, each in nats.items() if now + paid - each < 0}
        self.found = FirstMistake(what, share, nats, frozenset(mended))


def first_mistakes(
    told: Sequence[ToldWay], seed: int
) -> Iterator[tuple[ToldWay, bool, FirstMistake | None]]:
    """Walk ways with the guide; yield whether each arrived, and its first mistake."""
    witnesses = {each.name: _Witness() for each in told}

    def see(way: ToldWay, now: Moment) -> None:
        witnesses[way.name].see(now)

    for way, arrived in watched_walks(told, seed, see):
        yield way, arrived, witnesses[way.name].found


def main() -> int:
    options = made_walks_parser("blame").parse_args()
    walks = list(first_mistakes(list(told_by(options)), options.seed))
    kinds = [*dict.fromkeys(way.kind for way, _, _ in walks), "all"]
    rows: list[dict[str, object]] = []
    for kind in kinds:
        mine = [each for each in walks if kind in {each[0].kind, "all"}]
        lost = [found for _, arrived, found in mine if not arrived]
        what = Counter("none" if each is None else each.what for each in lost)
        rows.append({"kind": kind, "n": len(mine), "lost": len(lost), **what})
    mistakes = ("turned", "stopped", "left the place", "none")
    columns = [Column("kind", "Building", role="label"), Column("n", "n")]
    columns += [Column("lost", "lost"), *(Column(each, each) for each in mistakes)]
    title = "The first mistake of walks that were lost"
    print(Table(title, tuple(columns), tuple(rows)).text())
    turned = [(ok, found) for _, ok, found in walks if found and found.nats]
    rows = []
    for name in (PRICE, *NEUTRAL):
        row: dict[str, object] = {"evidence": name}
        for label, some in (("lost", False), ("found again", True)):
            found = [each for ok, each in turned if ok is some]
            nats = [each.nats[name] for each in found]
            row[f"{label} nats"] = float(np.mean(nats)) if nats else None
            row[f"{label} mended"] = sum(name in each.mended for each in found)
        rows.append(row)
    columns = [Column("evidence", "Evidence", role="label")]
    for label in ("lost", "found again"):
        columns.append(Column(f"{label} nats", f"{label}: nats", digits=2))
        columns.append(Column(f"{label} mended", "mended without it"))
    title = f"What made {len(turned)} wrong ways the better ones"
    print(Table(title, tuple(columns), tuple(rows)).text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
