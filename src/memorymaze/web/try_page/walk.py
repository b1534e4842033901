"""The process of a robot to try: looks round, follows what it is told, tells all of it.

What it is told are `SetOut` and `Pace`; it tells `ShownPicture`, `News` and `Ready`.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

import numpy as np

from memorymaze.agents.notes import BeliefNote, PlanNote, StepsNote
from memorymaze.basics.errors import MemoryMazeError, RenderingError
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.arena import Arena, arena_of
from memorymaze.runs.episodes.navigation import episode_on, navigate
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace_entries import CallEntry, NoteEntry, TraceEntry
from memorymaze.runs.story.onlooker import Onlooker, Present
from memorymaze.runs.story.understanding import understood
from memorymaze.web.serving.live_camera import seen_ahead, seen_all_round
from memorymaze.web.try_page.words import (
    FOLLOWERS,
    belief_words,
    change_of_mind,
    thought_of,
    verdict_of,
)
from memorymaze.world.drawing.svg import path_data, simplified
from memorymaze.world.sites import Site

GUIDE = AgentSettings("guide")
PERIOD = 1 / 8
"""Seconds between two pieces of news."""
PICTURE_PERIOD = 1 / 5
"""Seconds between two pictures of the camera."""


class SetOut(NamedTuple):
    """Tells it to follow a text."""

    text: str
    pace: float


class Pace(NamedTuple):
    """Tells it how many simulated seconds to go in a second; 0 to stand still."""

    value: float


class ShownPicture(NamedTuple):
    """Tells what it sees."""

    name: str
    """`round`, at the start, or `camera`."""
    jpeg: bytes


class News(NamedTuple):
    """Tells what happens, as the page's script reads it; places are metres, y down."""

    content: dict[str, Any]


class Ready(NamedTuple):
    """Tells that it stands at the start and listens."""

    blind: str = ""
    """Why there are no pictures; empty where there are."""


@dataclass(frozen=True, slots=True)
class RobotToTry:
    """Who follows, and who follows the same text beside it."""

    site: Site
    route: str
    settings: RunSettings
    beside: tuple[AgentSettings, ...]

    def __call__(self, connection: Connection) -> None:
        """Look round; then follow one text after another."""
        arena = arena_of(self.settings, self.site)
        blind = ""
        try:
            strip = seen_all_round(lambda turn: self._robot_at_start(arena, turn))
            connection.send(ShownPicture("round", strip))
        except RenderingError as error:
            blind = str(error)
        while True:
            connection.send(Ready(blind))
            told = connection.recv()
            if isinstance(told, SetOut):
                self._walk(told, arena, connection, sees=not blind)

    def _robot_at_start(self, arena: Arena, turn: float) -> SimulatedRobot:
        route = self.site.find_route(self.route)
        episode = episode_on(self.site, route, "Look round.")
        x, y, heading = episode.start
        turned = replace(episode, start=Pose(x, y, wrap_angle(heading + turn)))
        rng = np.random.default_rng(self.settings.seed)
        return arena.robot(turned, self.settings.simulation, rng, lambda _: None)

    def _walk(
        self, told: SetOut, arena: Arena, connection: Connection, *, sees: bool
    ) -> None:
        live = LiveWalk(connection, told.pace, sees=sees)
        for number, agent in enumerate((GUIDE, *self.beside)):
            title = FOLLOWERS.get(agent.name, agent.name)
            connection.send(News({"sets_out": title, "number": number}))
            # What is shown live comes first; the others need not be waited for.
            watcher = live if number == 0 else None
            over = self._over(told.text, agent, arena, watcher)
            connection.send(News({"over": over, "number": number}))

    def _over(
        self,
        text: str,
        agent: AgentSettings,
        arena: Arena,
        watcher: "LiveWalk | None",
    ) -> dict[str, Any]:
        """Let an agent follow; return how it ended."""
        route = self.site.find_route(self.route)
        try:
            run = navigate(
                self.site,
                route,
                text,
                agent,
                self.settings,
                watcher=watcher,
                arena=arena,
            )
        except MemoryMazeError as error:
            return {"headline": f"It could not walk: {error}"}
        if watcher is not None:
            watcher.end()
        near = self.settings.success_distance
        verdict = verdict_of(run.result, run.trajectory, self.site, route, near)
        line = simplified(run.trajectory.points).tolist()
        return {
            **verdict._asdict(),
            "confidence": run.result.confidence,
            "from_goal": round(run.result.spd, 1),
            "walked": round(run.result.path_length),
            "path": path_data(line),
            "lost": None if verdict.lost is None else _place(*verdict.lost),
        }


class LiveWalk:
    """Looks on at a walk, tells it while it goes on, and heeds the pace it is told."""

    period = PERIOD

    def __init__(self, connection: Connection, pace: float, *, sees: bool) -> None:
        """Tell it over a connection; with pictures where there can be some."""
        self._connection = connection
        self._sees = sees
        self._onlooker = Onlooker(self, pace)
        self._robot: SimulatedRobot | None = None
        self._trace: Sequence[TraceEntry] = ()
        self._told = self._walked = 0
        self._drawn = 0.0
        self._things_told = False
        self._steps: Sequence[str] = ()
        self._belief: BeliefNote | None = None

    def begin(self, robot: SimulatedRobot, trace: Sequence[TraceEntry]) -> None:
        """See the walk begin."""
        self._robot, self._trace = robot, trace
        self._onlooker.begin(robot, trace)

    def told(self) -> None:
        """Take note that the trace has grown."""
        self._onlooker.told()

    def end(self) -> None:
        """Tell how things stand at the end."""
        self._onlooker.end()

    def show(self, present: Present) -> None:
        """Tell what is new."""
        news: dict[str, Any] = {
            "time": round(present.time, 1),
            "distance": round(present.distance, 1),
            "robot": [
                *_place(present.pose.x, present.pose.y),
                round(-math.degrees(present.pose.heading), 1),
            ],
            "path": [_place(*each) for each in present.path[self._walked :]],
            "people": [_place(each.x, each.y) for each in present.people.values()],
            "events": [[round(event.time, 1), event.text] for event in present.fresh],
            **self._thoughts(),
        }
        self._walked = len(present.path)
        if present.things and not self._things_told:
            self._things_told = True
            news["things"] = [_place(e.x, e.y) for e in present.things.values()]
        self._connection.send(News(news))
        now = time.monotonic()
        if self._sees and self._robot and now - self._drawn >= PICTURE_PERIOD:
            self._drawn = now
            jpeg = seen_ahead(self._robot)
            self._connection.send(ShownPicture("camera", jpeg))
        self._heed()

    def _thoughts(self) -> dict[str, Any]:
        """Return steps, belief and thoughts of the entries that are new."""
        fresh = self._trace[self._told :]
        self._told += len(fresh)
        found: dict[str, Any] = {}
        notes = [entry for entry in fresh if isinstance(entry, NoteEntry)]
        if any(isinstance(each.note, PlanNote | StepsNote) for each in notes):
            self._steps = found["steps"] = understood(self._trace).steps
        thoughts: list[list[object]] = []
        for entry in fresh:
            if not isinstance(entry, CallEntry | NoteEntry):
                continue
            thought = thought_of(entry)
            belief = entry.note if isinstance(entry, NoteEntry) else None
            if isinstance(belief, BeliefNote):
                thought = change_of_mind(self._belief, belief, self._steps)
                self._belief = belief
                found["belief"] = {
                    "steps": belief.legs,
                    "likeliest": belief.likeliest,
                    "words": belief_words(belief),
                    "doubt": belief.doubt,
                }
            if thought is not None:
                thoughts.append([round(entry.time, 1), *thought])
        return {**found, "thoughts": thoughts}

    def _heed(self) -> None:
        """Take the pace that was told; stand still while it is 0."""
        while self._onlooker.pace == 0 or self._connection.poll():
            told = self._connection.recv()
            if isinstance(told, Pace):
                self._onlooker.pace = told.value


def _place(x: float, y: float) -> list[float]:
    """Return a place in the coordinates of the page."""
    return [round(x, 2), round(-y, 2)]
