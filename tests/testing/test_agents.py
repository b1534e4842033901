import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.code_generation import CodeGenerationAgent, CodeGenerationOptions
from memorymaze.agents.explorer import ExplorerAgent
from memorymaze.agents.guide import GuideAgent
from memorymaze.agents.navgpt import NavGPTAgent, NavGPTOptions
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.see_and_go import SeeAndGoAgent, SeeAndGoOptions
from memorymaze.agents.stop import StopAgent
from memorymaze.basics.errors import EpisodeOver
from memorymaze.basics.geometry.pose import Pose
from memorymaze.language.models.model import CompletionRequest
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.steps import SteppingRobot
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.guarded_robot import OracleAgent
from memorymaze.testing import check_agent
from memorymaze.world.sites import Site

EXAMPLES = Path(__file__).parents[2] / "examples"

PROGRAM = """
move_forward(5.0)
while not turn("left").turned:
    if move_forward(0.5).reason != "done":
        break
"""


def answer(request: CompletionRequest) -> str:
    asked = request.messages[-1].content
    if "Description:" in asked:
        return "Refined steps:\n1. Go ahead.\n2. Turn left."
    return f"Refined program:\n```python\n{PROGRAM}```"


@pytest.mark.parametrize("make", [ExplorerAgent, StopAgent])
def test_an_agent_keeps_the_contract_in_a_museum(make: Callable[[], Agent]) -> None:
    check_agent(make())


def test_the_guide_keeps_the_contract_where_its_walks_are_short(
    crossing_site: Site,
) -> None:
    scene, start = build_scene(crossing_site), crossing_site.routes[0].start
    settings = SimulationSettings(time_budget=60.0)
    check_agent(GuideAgent(), lambda: SimulatedRobot(scene, start, settings))


@pytest.mark.parametrize("parser", [True, False])
def test_the_code_generation_agent_keeps_the_contract(parser: bool) -> None:
    options = CodeGenerationOptions(parser=parser)
    check_agent(CodeGenerationAgent(options, ScriptedLanguageModel(answer)))


@pytest.fixture
def make_robot(corridor_site: Site) -> Callable[[], SteppingRobot]:
    """Robots in a corridor, for five simulated seconds."""
    scene = build_scene(corridor_site)
    settings = SimulationSettings(time_budget=5.0)
    return lambda: SimulatedRobot(scene, Pose(2, 0, 0), settings)


@pytest.mark.parametrize(
    "reply", ['{"action": "forward", "amount": 75}', "turn left 90 degrees", "?"]
)
def test_an_agent_that_goes_by_single_steps_keeps_the_contract(
    make_robot: Callable[[], SteppingRobot], reply: str
) -> None:
    model = ScriptedLanguageModel(lambda _: reply)
    check_agent(NavidAgent(NavidOptions(), model), make_robot)
    check_agent(SeeAndGoAgent(SeeAndGoOptions(), model), make_robot)


@pytest.mark.parametrize(
    ("file", "name"),
    [("right_hand.py", "RightHand"), ("depth_walker.py", "DepthWalker")],
)
def test_the_example_agents_keep_the_contract(
    make_robot: Callable[[], SteppingRobot], file: str, name: str
) -> None:
    check_agent(runpy.run_path(str(EXAMPLES / file))[name](), make_robot)


def test_agents_that_are_given_more_of_the_site_keep_the_contract(
    make_robot: Callable[[], SteppingRobot],
) -> None:
    silent = ScriptedLanguageModel(lambda _: "Thought: There.\nFinal Answer: arrived")
    turning = ScriptedLanguageModel(lambda _: "turn left 90 degrees")
    for agent in (
        OracleAgent(),
        NavGPTAgent(NavGPTOptions(), silent),
        NavidAgent(NavidOptions(), turning),
    ):
        check_agent(agent, make_robot)


class Nameless(StopAgent):
    name = ""


class Failing(StopAgent):
    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        if instruction == "?":
            raise IndexError("no words")


class Denying(StopAgent):
    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        for _ in range(20):
            try:
                robot.move_forward(1.0)
            except EpisodeOver:
                continue


class Peeking(StopAgent):
    def follow(
        self, instruction: str, robot: Any, journal: Journal, rng: np.random.Generator
    ) -> None:
        robot.say(robot.scene.site.name)


class Remembering(StopAgent):
    def __init__(self) -> None:
        self.followed = 0

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        self.followed += 1
        robot.move_forward(0.1 * self.followed)


@pytest.mark.parametrize(
    ("agent", "said"),
    [
        pytest.param(Nameless(), "one line of text, got ''", id="nameless"),
        pytest.param(Failing(), r"IndexError: no words \(test_agents.py", id="failing"),
        pytest.param(Peeking(), "follows an instruction has no 'scene'", id="peeking"),
        pytest.param(Denying(), "episode is over; got '14 more calls'", id="denying"),
        pytest.param(Remembering(), "the same calls for the same", id="remembering"),
    ],
)
def test_an_agent_that_breaks_the_contract_is_told_how(
    agent: Agent, said: str, make_robot: Callable[[], SteppingRobot]
) -> None:
    with pytest.raises(AssertionError, match=said):
        check_agent(agent, make_robot)


def test_an_agent_may_promise_no_repetition(
    make_robot: Callable[[], SteppingRobot],
) -> None:
    check_agent(Remembering(), make_robot, repeatable=False)
