"""The rules agent: reads the description, walks, doubts, goes back, arrives."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.agents.notes import ArrivalNote, DecisionNote, PlanNote
from memorymaze.agents.plan_readers import ReaderOptions, ReadsFirst
from memorymaze.agents.rules.arriving import RulesEnding, approach
from memorymaze.agents.rules.evidence import Standing
from memorymaze.agents.rules.tellings import RulesTellings
from memorymaze.agents.walking.floor_map import Sighting
from memorymaze.agents.walking.outlooks import (
    LEG_METRES,
    each_once,
    expected_metres,
    first_heading_cost,
    headings_to_begin,
    looks_of,
    phrases_at_start,
    things_on,
)
from memorymaze.agents.walking.walker import Walker
from memorymaze.language.model import LanguageModel
from memorymaze.robot.api import Robot
from memorymaze.routes import RoutePlan, describe

METRE_BACK = 0.012
"""Nats for each metre to walk back to another hypothesis."""
RIVALS = 3.0
"""Hypotheses that cost so much more than the best one are not looked for."""
FRONTIER = 300
"""Hypotheses kept at a time."""
FEWEST_METRES, MOST_METRES = 120.0, 300.0
"""Bounds of the walk after which the agent stops at the best place it knows."""


@dataclass(frozen=True, slots=True)
class RulesOptions(ReaderOptions):
    """What can be set of the rules agent."""

    start_heading: Literal["given", "unknown"] = "given"
    """Whether the robot faces the way the description begins with, or any way."""


class RulesAgent(ReadsFirst):
    """Follows route descriptions by rules; deterministic where its reader is.

    The description becomes a plan. At each turning point the plan and the walk are
    aligned in all sensible ways, each with a cost; the robot walks on with the
    cheapest and goes back to another when it becomes cheaper.
    """

    Options = RulesOptions

    def __init__(
        self, options: RulesOptions | None = None, model: LanguageModel | None = None
    ) -> None:
        """Make the agent with its options, and a model where one reads."""
        self.options = options or RulesOptions()
        super().__init__(self.options, model)

    @property
    def name(self) -> str:
        """`rules`, or `rules[model]` where a model reads."""
        return f"rules{self.reader.variant}"

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive the robot as the instruction says, and stop."""
        plans = self.reader.read_tellings(instruction, journal)
        for plan in plans:
            journal.add(PlanNote(describe(plan)))
        _Search(plans, Walker(robot), journal, self.options).run()
        robot.stop()


class _Search:
    """The walk of one episode.

    All tellings of the way are compared with the same map.
    """

    def __init__(
        self,
        plans: Sequence[RoutePlan],
        walker: Walker,
        journal: Journal,
        options: RulesOptions,
    ) -> None:
        self._walker = walker
        self._journal = journal
        self._told = RulesTellings(plans, walker.map)
        self._distances: dict[int, float] = {}
        self._frontier: list[Standing] = []
        self._endings: list[RulesEnding] = []
        self._best_known: dict[tuple[int, ...], list[float]] = {}
        self._limit = max(map(_walk_limit, plans))
        self._any_heading = options.start_heading == "unknown"
        self._looks = each_once(map(looks_of, plans))
        """What tells ways apart: looked for at every crossing."""

    def run(self) -> None:
        """Walk until arrived."""
        start = self._walker.at
        place = self._walker.map.crossings[start].place
        if start > 0 and not self._any_heading:
            self._survey()
        elif self._any_heading:
            self._walker.look_about(each_once([self._looks, *self._first_things()]))
        for begun in self._told.beginnings(Standing(start, 0.0, 0, line=(place,))):
            if self._any_heading:
                self._begin_anywhere(begun)
            elif start == 0:
                self._frontier.append(replace(begun, exit=0))
            else:
                self._branch_out(begun)
        for _ in range(400):
            self._walk_in_mind()
            branch = self._best_branch()
            ending = min(self._endings, key=self._ending_cost, default=None)
            if (
                branch is None
                or self._too_far_for(branch, ending)
                or (ending and self._ending_cost(ending) <= self._branch_cost(branch))
            ):
                if ending is not None:
                    self._finish(ending)
                return
            if self._walk(branch):
                return

    def _begin_anywhere(self, standing: Standing) -> None:
        """Take every way to face at the start for possible."""
        plan = self._told.of(standing).plan
        exits = self._walker.map.crossings[standing.at].exits
        for heading in headings_to_begin(exits):
            cost = first_heading_cost(plan, self._walker.map, standing.at, heading)
            told = f"began facing {math.degrees(heading):.0f} (+{cost:.1f})"
            cost += standing.cost
            self._branch_out(
                replace(standing, heading=heading, cost=cost, story=(told,))
            )

    def _first_things(self) -> Iterator[Sequence[str]]:
        """Yield things that the way to face at the start may be told by."""
        for each in self._told.all:
            yield (*phrases_at_start(each.plan), *each.arrivals.phrases)

    def _survey(self) -> None:
        """Look along the ways out of where the robot is, if that tells anything."""
        if self._looks and self._walker.at > 0:
            self._walker.survey(self._looks)

    # -- choosing

    def _too_far_for(self, branch: Standing, ending: RulesEnding | None) -> bool:
        """Tell whether after one more stretch there is no time to come back."""
        back = 0.0 if ending is None else self._metres_to(ending)
        further = self._away(branch.at) + LEG_METRES
        return self._walker.travelled + further + back > self._limit

    def _branch_cost(self, branch: Standing) -> float:
        return self._told.way_cost(branch) + METRE_BACK * self._away(branch.at)

    def _metres_to(self, ending: RulesEnding) -> float:
        return self._away(ending.standing.at) + ending.distance

    def _ending_cost(self, ending: RulesEnding) -> float:
        back = METRE_BACK * self._metres_to(ending)
        return self._told.ending_cost(ending) + back

    def _away(self, crossing: int) -> float:
        return self._distances.get(crossing, math.inf)

    def _best_branch(self) -> Standing | None:
        self._distances = self._walker.map.distances_from(self._walker.at)
        self._told.rate(self._frontier, self._endings)
        return min(self._frontier, key=self._branch_cost, default=None)

    # -- hypotheses

    def _walk_in_mind(self) -> None:
        """Carry hypotheses along stretches that are known already."""
        stretches = self._walker.map.stretches
        while True:
            known = [b for b in self._frontier if (b.at, b.exit) in stretches]
            if not known:
                break
            self._frontier = [
                b for b in self._frontier if (b.at, b.exit) not in stretches
            ]
            for branch in known:
                stretch = stretches[branch.at, branch.exit]
                told = self._told.of(branch)
                self._endings.extend(told.arrivals.on_stretch(branch, stretch))
                self._branch_out(told.aligner.advance(branch, stretch))
        crossings = self._walker.map.crossings
        self._frontier = [
            b for b in self._frontier if b.exit not in crossings[b.at].closed
        ]
        if len(self._frontier) > FRONTIER:
            self._frontier.sort(key=self._told.outlook)
            del self._frontier[FRONTIER:]

    def _branch_out(self, standing: Standing) -> None:
        if len(standing.line) > 25 or standing.cost > 25:
            return
        told = self._told.of(standing)
        choices = told.aligner.choices(standing)
        self._endings.extend(told.arrivals.at_crossing(standing, choices))
        for branch in told.aligner.branches(standing):
            self._endings.extend(told.arrivals.after_turn(branch))
            key = (branch.telling, branch.at, branch.exit, branch.leg)
            costs = self._best_known.setdefault(key, [])
            cost = self._told.outlook(branch)
            if sum(known <= cost + 1e-9 for known in costs) >= 2:
                continue
            costs.append(cost)
            self._frontier.append(branch)

    # -- walking

    def _walk(self, branch: Standing) -> bool:
        """Walk the stretch a hypothesis leads to; True when arrived on the way."""
        walker = self._walker
        self._journal.add(
            DecisionNote(
                branch.at,
                branch.exit,
                cost=round(self._told.outlook(branch), 2),
                legs_done=branch.leg,
                because=branch.story[-2:],
            )
        )
        if not walker.go_to(branch.at):
            self._frontier.remove(branch)
            return False
        rivals = self._rivals(branch)
        others = [b for b in self._frontier if b not in rivals]
        alternative = min(map(self._branch_cost, others), default=math.inf)
        begin = walker.travelled
        found: list[Sighting] = []

        def arrived(seen: list[Sighting]) -> bool:
            for rival in rivals:
                arrivals = self._told.of(rival).arrivals
                best = arrivals.best_now(rival, seen, walker.travelled - begin)
                if best is None:
                    continue
                cost = self._told.arrival_cost(rival, best[0], self._frontier)
                if cost <= alternative + 0.5:
                    found.append(best[1])
                    return True
            return False

        stretch = walker.follow_exit(branch.exit, self._phrases(rivals), arrived)
        if stretch is not None:
            self._survey()
        if found:
            self._journal.add(ArrivalNote(f"{found[0].phrase} seen"))
            approach(walker, found[0])
            return True
        return False

    def _rivals(self, branch: Standing) -> list[Standing]:
        """Hypotheses that go the same way and are about as good, the best first."""
        cost = self._told.outlook(branch)
        same = [
            b
            for b in self._frontier
            if b.at == branch.at
            and b.exit == branch.exit
            and self._told.outlook(b) <= cost + RIVALS
        ]
        return sorted(same, key=self._told.outlook)[:5]

    def _phrases(self, rivals: list[Standing]) -> list[str]:
        phrases = [self._looks, *(each.arrivals.phrases for each in self._told.all)]
        for rival in rivals:
            plan = self._told.of(rival).plan
            legs, first = plan.legs, rival.leg
            for number, leg in list(enumerate(legs))[max(first - 1, 0) : first + 2]:
                phrases.append([m.phrase for m in things_on(plan, number)])
                phrases.append((*leg.too_far, *leg.wrong_way))
            if first >= len(legs) - 1:
                phrases.append([m.phrase for m in things_on(plan, len(legs))])
        return each_once(phrases)

    def _finish(self, ending: RulesEnding) -> None:
        """Go to the place of an ending."""
        walker = self._walker
        self._journal.add(
            ArrivalNote(
                ending.reason,
                cost=round(ending.cost, 2),
                because=ending.standing.story,
            )
        )
        if not walker.go_to(ending.standing.at) or ending.exit is None:
            return
        if not walker.face(ending.exit):
            return
        goal = ending.distance
        phrases = self._told.of(ending.standing).arrivals.phrases
        while goal > -0.5:
            seen = [s for s in walker.look(phrases) if s.distance < goal + 3.0]
            if seen and ending.reason.endswith("seen"):
                approach(walker, seen[0])
                return
            if goal <= 0.2:
                return
            step = min(goal, 0.8)
            if not walker.step(step):
                return
            goal -= step


def _walk_limit(plan: RoutePlan) -> float:
    """Metres after which to stop at the best place known."""
    return min(max(FEWEST_METRES, 2.2 * expected_metres(plan)), MOST_METRES)
