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
from shapely import Point

from benchmarks.made_walks import ToldWay, made_walks_parser, told_by
from benchmarks.plan_walks import given_plans
from memorymaze.agents.guide import arriving, belief, said_of_legs
from memorymaze.agents.guide.agent import GuideAgent, GuideOptions
from memorymaze.agents.guide.alignments import Frontier
from memorymaze.agents.guide.arriving import Ending
from memorymaze.agents.guide.choosing import Choice
from memorymaze.agents.guide.things import Things
from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.episode import run_episode
from memorymaze.evaluation.plan import plan_run
from memorymaze.evaluation.settings import AgentSettings, RunSettings
from memorymaze.instructions import Corpus
from memorymaze.instructions.corpus import episodes
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.tables import Column, Table

ARRIVED = 3.0
BEYOND = 2.0
"""Metres beyond a turning point where the way on from it is measured."""
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
    "angle": (
        (belief, "way_ratio", lambda _, angle: 1.0 if abs(angle) > 0.26 else 0.0),
    ),
    "things": (
        (Things, "weigh", lambda _, weights, *__: weights),
        (Things, "so_far", lambda *_: 1.0),
        (Things, "ahead", lambda *_: 1.0),
    ),
    "destination seen": (
        (arriving.Arrivals, "seen", lambda *_: 1.0),
        (arriving.Arrivals, "_ahead", lambda *_: iter(())),
    ),
    "signs": ((belief.Belief, "_hint", lambda *_: 1.0),),
    "plain turn": ((belief.Belief, "_plain_turn_fits", lambda *_: False),),
}
"""What stands for each kind of evidence where it is to say nothing."""
PRICE = "metres"
DECIDE = Choice.best


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
    """Looks on at the decisions of a walk, and knows the way."""

    def __init__(self, told: ToldWay, robot: SimulatedRobot) -> None:
        self._told, self._robot = told, robot
        self._points = {e.id: e.polygon for e in told.site.turning_points}
        self.found: FirstMistake | None = None

    def see(self, choice: Choice, step: object) -> None:
        """Compare a decision with the way."""
        if self.found is not None:
            return
        line = self._told.route.line
        x, y, _ = self._robot.pose
        here = Point(x, y)
        at_goal = here.distance(Point(line.coords[-1])) < ARRIVED
        if isinstance(step, Ending) or step is None:
            if not self._ends_at_goal(step):
                self._note(choice, "stopped", step)
        elif at_goal and line.project(here) > line.length - 2 * ARRIVED:
            self._note(choice, "left the place", step)
        elif isinstance(step, Frontier):
            right = self._right_way(choice)
            if right is None or (step.at, step.exit) == (right.at, right.exit):
                return
            self._note(choice, "turned", step, right)

    def _ends_at_goal(self, ending: Ending | None) -> bool:
        if ending is None:
            return False
        start = self._told.route.start_heading
        x0, y0 = self._told.route.line.coords[0][:2]
        x, y = ending.place
        there = (
            x0 + x * math.cos(start) - y * math.sin(start),
            y0 + x * math.sin(start) + y * math.cos(start),
        )
        # The map of the agent is not exact.
        return math.dist(there, self._told.route.line.coords[-1][:2]) < 2 * ARRIVED

    def _right_way(self, choice: Choice) -> Frontier | None:
        """Return the way on along the route; None where the robot is not on it."""
        line, (x, y, _) = self._told.route.line, self._robot.pose
        here = Point(x, y)
        s = line.project(here)
        if line.distance(here) > 2.5:
            return None
        near = min(self._points.values(), key=lambda each: each.distance(here))
        while s < line.length and near.distance(line.interpolate(s)) < BEYOND:
            s += 0.25
        there, centre = line.interpolate(s), near.centroid
        heading = math.atan2(there.y - centre.y, there.x - centre.x)
        heading -= self._told.route.start_heading
        crossing = choice._walker.map.crossings[choice._walker.at]  # pyright: ignore
        exit = crossing.find_exit(math.remainder(heading, math.tau))
        if exit is None:
            return None
        return choice._tellings.frontiers.get((crossing.number, exit))  # pyright: ignore

    def _note(
        self,
        choice: Choice,
        what: str,
        step: Frontier | Ending | None,
        right: Frontier | None = None,
    ) -> None:
        tellings = choice._tellings  # pyright: ignore
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


class _Watching:
    """Hands the robot of an episode to its witness."""

    def __init__(self, told: ToldWay) -> None:
        self._told = told
        self.witness: _Witness | None = None

    def begin(self, robot: SimulatedRobot, _: object) -> None:
        self.witness = _Witness(self._told, robot)

    def told(self) -> None:
        """Nothing is to be done when a trace has grown."""

    def best(self, choice: Choice) -> object:
        """Decide as the guide does, before the witness."""
        step = DECIDE(choice)
        if self.witness is not None:
            self.witness.see(choice, step)
        return step


def first_mistakes(
    told: Sequence[ToldWay], seed: int
) -> Iterator[tuple[ToldWay, bool, FirstMistake | None]]:
    """Walk ways with the guide; yield whether each arrived, and its first mistake."""
    sites = {each.site.name: each.site for each in told}
    instructions = [each.instruction for each in told]
    corpus = Corpus("plans", tuple(episodes(instructions, sites)), sites, ())
    settings = given_plans(AgentSettings("guide"))
    plan = plan_run(settings, corpus, RunSettings(seed=seed))
    agent = GuideAgent(GuideOptions(reader="plan"))
    arenas = {name: Arena(site) for name, site in sites.items()}
    for each, episode in zip(told, corpus.episodes, strict=True):
        watching = _Watching(each)
        with patch.object(Choice, "best", lambda choice, w=watching: w.best(choice)):
            arena = arenas[each.site.name]
            run = run_episode(agent, episode, arena, plan.settings, watching)
        assert watching.witness is not None
        yield each, run.result.success, watching.witness.found


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
    print(
        Table("The first mistake of walks that were lost", tuple(columns), rows).text()
    )
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
    print(Table(title, tuple(columns), rows).text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
