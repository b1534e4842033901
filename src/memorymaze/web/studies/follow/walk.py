"""People as an agent: somebody's commands drive the guarded robot of an episode.

A walk is its commands: the same ones give the same walk, so it can be taken up where it
was broken off, and scored when all is over. It is measured as every agent's is.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import ClassVar, NamedTuple

import numpy as np

from memorymaze.agents.agent import Journal, Need
from memorymaze.agents.notes import ArrivalNote, GaveUpNote
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.api.control import Robot
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.arena import Arena, arena_of
from memorymaze.runs.episodes.episode import EpisodeRun, run_episode
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.runs.episodes.trace_entries import TraceEntry
from memorymaze.texts.corpus.records import Episode
from memorymaze.web.serving.live_camera import seen_ahead
from memorymaze.world.sites import Site

PEOPLE = "people"
NEEDS: frozenset[Need] = frozenset({"camera"})
STEP = 0.5
"""Metres of a command to go on."""
TURN = 30.0
"""Degrees of a command to turn."""
MOTION = 0.17
"""Metres between two pictures while it moves."""
ROTATION = math.radians(12)
"""Radians between them while it turns."""
BLOCKED = {
    "wall": "It does not go on there. Turn, and try another way.",
    "obstacle": "Something is in the way.",
    "budget": "",
    "done": "",
}


def _forward(robot: Robot) -> str:
    return BLOCKED[robot.move_forward(STEP).reason]


def _turn(degrees: float) -> Callable[[Robot], str]:
    def turn(robot: Robot) -> str:
        robot.turn_by(degrees)
        return ""

    return turn


COMMANDS: dict[str, Callable[[Robot], str]] = {
    "forward": _forward,
    "left": _turn(TURN),
    "right": _turn(-TURN),
    "around": _turn(180.0),
}
"""What people can tell the robot; each returns what it answers."""


class Said(NamedTuple):
    """How somebody ended a walk."""

    arrived: bool
    """Whether they say that they are there; else they gave up."""
    confidence: float
    """How sure they are to be there, 0 to 1."""


class People:
    """Drives as it is told, command by command, until somebody ends the walk."""

    needs: ClassVar[frozenset[Need]] = NEEDS

    def __init__(
        self,
        commands: Iterable[str | Said],
        hear: Callable[[str], None] | None = None,
        name: str = PEOPLE,
    ) -> None:
        """Take the commands, one after the other; `hear` is told what the robot answers."""
        self.name = name
        self._commands = commands
        self._hear = hear

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        """Drive the robot."""
        for command in self._commands:
            if isinstance(command, Said):
                ending = ArrivalNote if command.arrived else GaveUpNote
                journal.add(ending(confidence=command.confidence))
                return
            answer = COMMANDS[command](robot)
            if self._hear is not None:
                self._hear(answer)


def walk_again(
    commands: Sequence[str],
    said: Said | None,
    episode: Episode,
    arena: Arena,
    settings: RunDefinition,
) -> EpisodeRun:
    """Score a walk by its commands; None said where the robot's budget ended it."""
    ended = () if said is None else (said,)
    people = People([*commands, *ended], name=settings.agent.name)
    return run_episode(people, episode, arena, settings)


class SeenOnWalk(NamedTuple):
    """What a driver is shown after a command."""

    done: int
    """Commands so far."""
    frames: tuple[bytes, ...]
    """Pictures on the way, the last one from where the robot stands; JPEG."""
    metres: float
    """Driven so far: agents have an odometer, too."""
    place: tuple[float, float]
    """Where the robot stands, which nobody is shown."""
    answer: str


class Ended:
    """That the walk is over without a word: the robot's budget is spent."""


@dataclass(frozen=True, slots=True)
class RobotToDrive:
    """The process of a walk that goes on; it is told commands and tells `SeenOnWalk`."""

    site: Site
    episode: Episode
    settings: RunDefinition
    past: tuple[str, ...]
    """Commands that were given before, to another process."""
    draws: bool = True
    """Whether somebody looks at its pictures."""

    def __call__(self, connection: Connection) -> None:
        """Take up the walk where it was, and drive on as told."""
        driver = _Driver(connection, self.past, draws=self.draws)
        arena = arena_of(self.settings, self.site)
        people = People(driver.commands(), driver.hear)
        run_episode(people, self.episode, arena, self.settings, driver)
        connection.send(Ended())


class _Driver:
    """Watches an episode, shows it to a driver, and waits for what is told."""

    def __init__(
        self, connection: Connection, past: Sequence[str], *, draws: bool
    ) -> None:
        self._connection = connection
        self._draws = draws
        self._past = past
        self._frames: list[bytes] = []
        self._answer = ""
        self._metres = 0.0
        self._robot: SimulatedRobot | None = None
        self._pose: Pose | None = None
        self._drawn_at: Pose | None = None
        """Where the last picture was taken; None while past commands are repeated."""

    def begin(self, robot: SimulatedRobot, trace: Sequence[TraceEntry]) -> None:
        self._robot, self._pose = robot, robot.pose
        robot.watch(self._moved)

    def told(self) -> None:
        """What happens is seen in pictures."""

    def hear(self, answer: str) -> None:
        self._answer = answer

    def commands(self) -> Iterator[str]:
        yield from self._past
        done = len(self._past)
        while True:
            assert self._robot is not None
            self._drawn_at = self._robot.pose
            if self._draws:
                self._frames.append(seen_ahead(self._robot))
            frames = tuple(self._frames)
            place = (self._drawn_at.x, self._drawn_at.y)
            self._connection.send(
                SeenOnWalk(done, frames, self._metres, place, self._answer)
            )
            self._frames.clear()
            command = self._connection.recv()
            done += 1
            yield command

    def _moved(self, now: float, pose: Pose) -> None:
        before, self._pose = self._pose or pose, pose
        self._metres += math.dist(before[:2], pose[:2])
        last = self._drawn_at
        if last is None or self._robot is None or not self._draws:
            return
        turned = abs(turn_between(last.heading, pose.heading))
        if math.dist(last[:2], pose[:2]) >= MOTION or turned >= ROTATION:
            self._drawn_at = pose
            self._frames.append(seen_ahead(self._robot))
