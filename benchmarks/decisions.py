"""Looks on at the guide's decisions on made floors, and knows the right way at each.

What `benchmarks.blame` and `benchmarks.fit` share.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from unittest.mock import patch

import numpy as np
from shapely import Point

from benchmarks.made_walks import ToldWay
from benchmarks.plan_walks import given_plans
from memorymaze.agents.guide.agent import GuideAgent, GuideOptions
from memorymaze.agents.guide.alignments import Frontier
from memorymaze.agents.guide.arriving import Ending
from memorymaze.agents.guide.choosing import Choice
from memorymaze.agents.walking.floor_map import FloorMap
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.episode import run_episode
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.texts.corpus import Corpus
from memorymaze.texts.corpus.corpus import episodes

BEYOND = 2.0
"""Metres beyond a turning point where the way on from it is measured."""
DECIDE = Choice.best

Way = tuple[int, int]
"""A crossing on the guide's map, and an exit of it."""
Step = Frontier | Ending | None
"""A way that is new, or a place to arrive at; None where nothing is left."""


@dataclass(frozen=True, slots=True)
class Moment:
    """A decision of the guide, beside what is so."""

    choice: Choice
    step: Step
    """What it decided."""
    right: Way | None
    """The way that it should walk next, which it may have to go back to; None where that
    is not on its map, or nothing is left but to arrive."""
    arrives: bool
    """Whether nothing is left but to arrive."""
    at_goal: bool
    """Whether the robot is within 3 m of the destination."""
    goal: tuple[float, float]
    """The destination on the guide's map, which is not exact."""


class Guidepost:
    """Knows the way of one episode, and which crossings of the guide's map lie on it."""

    def __init__(self, told: ToldWay, robot: SimulatedRobot) -> None:
        """Begin with a robot at the start."""
        self._robot = robot
        self._line = told.route.line
        self._start = told.route.start_heading
        self._points = {each.id: each.polygon for each in told.site.turning_points}
        self._numbers: dict[str, int] = {}
        self._passed = self._passed_on_the_way()
        start = self._line.interpolate(0.0)
        self._starts_in_one = any(
            each.distance(start) < 0.05 for each in self._points.values()
        )

    def _passed_on_the_way(self) -> list[tuple[str, float]]:
        """Return the turning points of the route, and where each is left, in metres."""
        passed: list[tuple[str, float]] = []
        for s in np.arange(0.0, self._line.length, 0.25):
            here = self._line.interpolate(s)
            for name, polygon in self._points.items():
                if polygon.distance(here) < 0.05:
                    if passed and passed[-1][0] == name:
                        passed.pop()
                    passed.append((name, float(s)))
        return passed

    def look(self, choice: Choice, step: Step) -> Moment:
        """Return a decision beside what is so."""
        walker = choice._walker  # pyright: ignore[reportPrivateUsage]
        x, y, _ = self._robot.pose
        here = Point(x, y)
        if walker.at > 0:
            nearest = min(
                self._points, key=lambda each: self._points[each].distance(here)
            )
            self._numbers.setdefault(nearest, walker.at)
        ways = [*self._ways(walker.map)]
        untried = [each for each in ways if each not in walker.map.stretches]
        end = self._line.coords[-1][:2]
        at_goal = math.dist((x, y), end) < 3.0
        right = untried[0] if untried else None
        return Moment(choice, step, right, not untried, at_goal, self._on_map(end))

    def _ways(self, floor: FloorMap) -> Iterator[Way | None]:
        """Yield the ways out that the route takes, as far as the map goes."""
        if 0 in floor.crossings and not self._starts_in_one:
            yield (0, 0)
        for number, (name, left) in enumerate(self._passed):
            crossing = self._numbers.get(name)
            follows = self._passed[number + 1 :]
            beyond = min(left + BEYOND, follows[0][1] if follows else self._line.length)
            a, b = self._line.interpolate(left), self._line.interpolate(beyond)
            heading = math.atan2(b.y - a.y, b.x - a.x) - self._start
            exit = None
            if crossing is not None:
                heading = math.remainder(heading, math.tau)
                exit = floor.crossings[crossing].find_exit(heading)
            if crossing is None or exit is None:
                yield None
                return
            yield crossing, exit

    def _on_map(self, place: Sequence[float]) -> tuple[float, float]:
        x0, y0 = self._line.coords[0][:2]
        x, y = place[0] - x0, place[1] - y0
        cos, sin = math.cos(self._start), math.sin(self._start)
        return x * cos + y * sin, y * cos - x * sin


class _Watching:
    """Hands the robot of an episode to its guidepost."""

    def __init__(self, told: ToldWay, see: Callable[[ToldWay, Moment], None]) -> None:
        self._told, self._see = told, see
        self._post: Guidepost | None = None

    def begin(self, robot: SimulatedRobot, trace: object) -> None:
        self._post = Guidepost(self._told, robot)

    def told(self) -> None:
        """Nothing is to be done when a trace has grown."""

    def best(self, choice: Choice) -> Step:
        """Decide as the guide does, and show it."""
        step = DECIDE(choice)
        if self._post is not None:
            self._see(self._told, self._post.look(choice, step))
        return step


def watched_walks(
    told: Sequence[ToldWay], seed: int, see: Callable[[ToldWay, Moment], None]
) -> Iterator[tuple[ToldWay, bool]]:
    """Walk ways with the guide and show each decision; yield whether each arrived."""
    sites = {each.site.name: each.site for each in told}
    instructions = [each.instruction for each in told]
    corpus = Corpus("plans", tuple(episodes(instructions, sites)), sites, ())
    settings = given_plans(AgentSettings("guide"))
    plan = plan_run(settings, corpus, RunSettings(seed=seed))
    agent = GuideAgent(GuideOptions(reader="plan"))
    arenas = {name: Arena(site) for name, site in sites.items()}
    for each, episode in zip(told, corpus.episodes, strict=True):
        watching = _Watching(each, see)

        def best(choice: Choice, watching: _Watching = watching) -> Step:
            return watching.best(choice)

        with patch.object(Choice, "best", best):
            arena = arenas[each.site.name]
            run = run_episode(agent, episode, arena, plan.settings, watching)
        yield each, run.result.success
