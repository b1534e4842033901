"""What every agent must do that follows instructions."""

from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np

from memorymaze.agents.agent import Agent, FairLimits, Journal
from memorymaze.agents.making import checked_agent, checked_needs
from memorymaze.basics.errors import (
    EpisodeOver,
    LanguageModelError,
    ProgramError,
    SettingsError,
)
from memorymaze.basics.failures import failure_line
from memorymaze.robot.api.specification import API_NAMES
from memorymaze.robot.api.steps import SteppingRobot
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.guarded_robot import hand_over
from memorymaze.testing.expectation import expect
from memorymaze.world.sites import load_site

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
    make_robot: Callable[[], SteppingRobot] | None = None,
    *,
    instructions: Sequence[str] = INSTRUCTIONS,
    repeatable: bool = True,
) -> None:
    """Check that an agent keeps its contract.

    It follows every instruction, then the first one again, each time with a robot at
    the beginning of an episode, and guarded as in a run: it has the control API, steps,
    pictures and scans, and no more. Whatever it is told it must end without an error of
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


def _museum() -> Callable[[], SteppingRobot]:
    scene = build_scene(load_site("museum_5f"))
    start = scene.site.find_route("R2").start
    settings = SimulationSettings(time_budget=40.0, call_budget=300)
    return lambda: SimulatedRobot(scene, start, settings, np.random.default_rng(0))


def _followed(agent: Agent, text: str, robot: SteppingRobot) -> list[str]:
    """Let an agent follow a text; return what it called."""
    heard = _Calls(robot)
    named = f"follow({text[:30]!r}…) to end"
    needs = checked_needs(agent.name, agent)
    journal = Journal(limits=FairLimits(requests=10, steps={15: 60, 30: 40}))
    try:
        simulated = cast(SimulatedRobot, robot)
        # One that needs the answers is at its goal already.
        way = (simulated.pose[:2],) if "answers" in needs else ()
        handed = hand_over(simulated, needs, way)
        agent.follow(text, handed, journal, np.random.default_rng(0))
    except (EpisodeOver, ProgramError, LanguageModelError):
        pass
    except (Exception, SystemExit) as error:
        allowed = f"{named} or to raise EpisodeOver, ProgramError or LanguageModelError"
        raise AssertionError(
            f"expected {allowed}; got {failure_line(error, agent)}"
        ) from error
    expect(
        heard.leftover <= LEFTOVER_CALLS,
        f"{named} where the robot says that the episode is over",
        f"{heard.leftover} more calls",
    )
    return heard.made


def _end(calls: Sequence[str]) -> str:
    return f"{len(calls)} calls, at last {', '.join(calls[-3:]) or 'none'}"


class _Calls:
    """Listens to what is called of a robot."""

    def __init__(self, robot: SteppingRobot) -> None:
        self.made: list[str] = []
        self.leftover = 0
        self._over = False
        for name in (*API_NAMES, "step_forward", "rotate", "camera_picture"):
            setattr(robot, name, self._heard(name, getattr(robot, name)))

    def _heard(self, name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def heard(*arguments: Any) -> Any:
            self.made.append(f"{name}{arguments!r}")
            self.leftover += self._over
            try:
                return call(*arguments)
            except EpisodeOver:
                self._over = True
                raise

        return heard
