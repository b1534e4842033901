"""What every agent must do that follows instructions."""

import math
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np

from memorymaze.agents import Agent, Journal
from memorymaze.errors import (
    EpisodeOver,
    LanguageModelError,
    ProgramError,
    SettingsError,
)
from memorymaze.evaluation.agent_failures import failure_line
from memorymaze.evaluation.own_agents import checked_agent
from memorymaze.pictures import robot_cameras
from memorymaze.robot.api import (
    Detection,
    Direction,
    MoveResult,
    Robot,
    SignText,
    TurnResult,
)
from memorymaze.robot.steps import CameraPicture, SteppingRobot
from memorymaze.simulation import SimulatedRobot, SimulationSettings, build_scene
from memorymaze.sites import load_site
from memorymaze.testing.expectation import expect

Result = TypeVar("Result")

INSTRUCTIONS = (
    "Go straight ahead to the end, turn left there, and stop at the second door.",
    "Uh, I don't know. I have never been here, sorry!",
    "左に曲がってください。",
    "?",
    "Turn left and then right. " * 40,
)
"""What people say: a way, no way, another language, nothing, and no end of it."""

LEFTOVER_CALLS = 3
"""Calls after the end of an episode that are forgiven."""


def check_agent(
    agent: Agent,
    make_robot: Callable[[], Robot] | None = None,
    *,
    instructions: Sequence[str] = INSTRUCTIONS,
    repeatable: bool = True,
) -> None:
    """Check that an agent keeps its contract.

    It follows every instruction, then the first one again, each time with a robot at
    the beginning of an episode. Whatever it is told it must end without an error of
    its own, leave the robot alone when the episode is over, and do the same again when
    told the same.

    Args:
        agent: The agent.
        make_robot: Makes robots that are all alike; None for simulated ones in the
            museum that have little time.
        instructions: At least one.
        repeatable: Whether the agent promises to do the same again; one that asks a
            language model may not.

    Raises:
        AssertionError: It breaks the contract.
    """
    try:
        checked_agent(type(agent).__name__, agent)
    except SettingsError as error:
        raise AssertionError(str(error)) from None
    make = make_robot or _museum()
    first, *others = instructions
    calls = _followed(agent, first, make())
    for text in others:
        _followed(agent, text, make())
    again = _followed(agent, first, make())
    if repeatable:
        what = "the same calls for the same text, whatever was followed in between"
        expect(again == calls, f"{what}, such as {_end(calls)}", _end(again))


def _museum() -> Callable[[], Robot]:
    scene = build_scene(load_site("museum_5f"))
    start = scene.site.reference_route("R2").start
    settings = SimulationSettings(time_budget=40.0, call_budget=300)
    return lambda: SimulatedRobot(
        scene, start, settings, np.random.default_rng(0), cameras=robot_cameras
    )


def _followed(agent: Agent, text: str, robot: Robot) -> list[str]:
    """Let an agent follow a text; return what it called."""
    steps = isinstance(robot, SteppingRobot)
    watched = _WatchedSteppingRobot(robot) if steps else _WatchedRobot(robot)
    named = f"follow({text[:30]!r}…) to end"
    try:
        agent.follow(text, watched, Journal(), np.random.default_rng(0))
    except (EpisodeOver, ProgramError, LanguageModelError):
        pass
    except (Exception, SystemExit) as error:
        allowed = f"{named} or to raise EpisodeOver, ProgramError or LanguageModelError"
        raise AssertionError(
            f"expected {allowed}; got {failure_line(error, agent)}"
        ) from error
    expect(
        watched.leftover <= LEFTOVER_CALLS,
        f"{named} where the robot says that the episode is over",
        f"{watched.leftover} more calls",
    )
    return watched.calls


def _end(calls: Sequence[str]) -> str:
    return f"{len(calls)} calls, at last {', '.join(calls[-3:]) or 'none'}"


class _WatchedRobot:
    """Passes calls on and remembers them."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._over = False
        self.calls: list[str] = []
        self.leftover = 0

    def move_forward(self, distance: float) -> MoveResult:
        return self._passed("move_forward", self._robot.move_forward, distance)

    def detect_turning_point(self) -> list[Direction]:
        return self._passed("detect_turning_point", self._robot.detect_turning_point)

    def turning_point_id(self) -> int | None:
        return self._passed("turning_point_id", self._robot.turning_point_id)

    def turn(self, direction: str) -> TurnResult:
        return self._passed("turn", self._robot.turn, direction)

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        return self._passed(
            "detect_from_RGB_image", self._robot.detect_from_RGB_image, object
        )

    def read_signs(self) -> list[SignText]:
        return self._passed("read_signs", self._robot.read_signs)

    def say(self, text: str) -> None:
        self._passed("say", self._robot.say, text)

    def distance_travelled(self) -> float:
        return self._passed("distance_travelled", self._robot.distance_travelled)

    def stop(self) -> None:
        self._passed("stop", self._robot.stop)

    def _passed(
        self, name: str, call: Callable[..., Result], *arguments: Any
    ) -> Result:
        self.calls.append(f"{name}{arguments!r}")
        self.leftover += self._over
        try:
            return call(*arguments)
        except EpisodeOver:
            self._over = True
            raise


class _WatchedSteppingRobot(_WatchedRobot):
    """The same, for robots that can be moved by single steps."""

    def __init__(self, robot: SteppingRobot) -> None:
        super().__init__(robot)
        self._stepping = robot

    def step_forward(self, distance: float) -> float:
        return self._passed("step_forward", self._stepping.step_forward, distance)

    def rotate(self, angle: float) -> float:
        return self._passed("rotate", self._stepping.rotate, angle)

    def camera_picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        picture = self._stepping.camera_picture
        return self._passed("camera_picture", picture, width, height, horizontal_fov)
