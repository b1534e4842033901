"""The NaVid agent in runs: what each budget is enough for, and models on servers."""

import json
import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.navid.motions import Motions
from memorymaze.basics.errors import EpisodeOver, SettingsError
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.language.models.model import Completion, CompletionRequest, Usage
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.agent_catalogue import choose_agent
from memorymaze.runs.episodes.budgets import fair_limits, time_budget_for
from memorymaze.runs.episodes.navigation import navigate
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.world.sites import Site
from memorymaze.world.sites.records import Route

AHEAD = 1.2
"""Metres along the route that the stand-in aims at."""


class TruePath:
    """A model that sees nothing and knows the way: a stand-in for a perfect one."""

    name = "true path"

    def __init__(self, robot: SimulatedRobot, route: Route) -> None:
        self._robot = robot
        self._line = route.line
        self._along = 0.0
        self._turn = math.radians(Motions().turn_deg)

    def complete(self, request: CompletionRequest) -> Completion:
        said = json.dumps(self._next())
        return Completion(said, self.name, Usage(), 0.0)

    def _next(self) -> dict[str, Any]:
        here = self._robot.pose
        stops = np.arange(self._along, min(self._along + 2, self._line.length), 0.05)
        places = [self._line.interpolate(each) for each in stops]
        if places:
            away = [math.hypot(each.x - here.x, each.y - here.y) for each in places]
            self._along = float(stops[int(np.argmin(away))])
        if self._line.length - self._along < 0.5:
            return {"action": "stop"}
        aim = self._line.interpolate(self._along + AHEAD)
        bearing = math.atan2(aim.y - here.y, aim.x - here.x)
        off = turn_between(here.heading, bearing)
        if abs(off) > 0.6 * self._turn:
            return {"action": "left" if off > 0 else "right", "amount": 30}
        return {"action": "forward", "amount": 25}


@pytest.fixture
def blind_robot() -> Callable[[Site, Route], SimulatedRobot]:
    """Put a robot that takes black pictures, at once, at the start of a route."""

    def put(site: Site, route: Route) -> SimulatedRobot:
        settings = SimulationSettings()
        settings = SimulationSettings(
            time_budget=time_budget_for(frozenset({"steps"}), site.routes, settings)
        )
        robot = SimulatedRobot(
            build_scene(site), route.start, settings, np.random.default_rng(0)
        )
        black = SimpleNamespace(rgb=np.zeros((480, 640, 3), np.uint8))
        robot.camera_picture = lambda *_: black  # type: ignore[method-assign]
        return robot

    return put


def walked(robot: SimulatedRobot, route: Route, **options: Any) -> str:
    """Walk the true path within a budget; return what ended it."""
    agent = NavidAgent(NavidOptions(**options), TruePath(robot, route))
    journal = Journal(limits=fair_limits(robot.scene.site.routes))
    with pytest.raises(EpisodeOver) as over:
        agent.follow("Go.", robot, journal, np.random.default_rng(0))
    return over.value.stopped_by


@pytest.mark.proof
def test_the_longest_route_can_be_finished_under_the_fair_budget_only(
    builtin_sites: dict[str, Site],
    blind_robot: Callable[[Site, Route], SimulatedRobot],
) -> None:
    site = builtin_sites["university"]
    route = site.find_route("R2")
    goal = route.line.coords[-1]

    fair, released = blind_robot(site, route), blind_robot(site, route)

    assert walked(fair, route, budget="fair") == "agent"
    assert math.dist(goal[:2], fair.pose[:2]) < 3.0
    assert walked(released, route, budget="released") == "budget"
    assert 90 < released.trajectory().length <= 100
    assert math.dist(goal[:2], released.pose[:2]) > 3.0


@pytest.fixture
def vision_server(
    chat_server: Callable[..., tuple[str, list[dict[str, Any]]]],
) -> tuple[str, list[dict[str, Any]]]:
    """A server of a vision model that goes 75 cm ahead until it is asked 20 times."""
    replies = ["forward"] * 19 + ["stop"]

    def ahead(_: dict[str, Any]) -> str:
        return json.dumps({"action": replies.pop(0), "amount": 75})

    return chat_server(ahead, model="small-vlm-2", tokens=(900, 20))


@pytest.mark.proof
def test_a_vision_model_on_a_server_drives_the_robot_and_replays(
    corridor_site: Site,
    vision_server: tuple[str, list[dict[str, Any]]],
    tmp_path: Path,
) -> None:
    address, requests = vision_server
    store = str(tmp_path / "replies.jsonl")
    asking = AgentSettings(
        "navid",
        language_model=ModelSettings(model="small-vlm", base_url=address, record=store),
    )
    route = corridor_site.routes[0]

    run = navigate(corridor_site, route, "To the fourth door.", asking)

    assert run.result.agent == "NaVid protocol with small-vlm+fair"
    assert (run.result.success, run.result.model_calls) == (True, len(requests))
    assert run.result.tokens == 920 * len(requests)
    text, *pictures = requests[-1]["messages"][1]["content"]
    assert text["type"] == "text"
    assert len(pictures) == 8 + 1
    for picture in pictures:
        assert picture["image_url"]["url"].startswith("data:image/jpeg;base64,/9j/")

    asked = len(requests)
    replaying = AgentSettings(
        "navid", language_model=ModelSettings(model="small-vlm", replay=store)
    )
    again = navigate(corridor_site, route, "To the fourth door.", replaying)
    assert (again.trace, again.trajectory) == (run.trace, run.trajectory)
    assert len(requests) == asked


@pytest.mark.proof
def test_pictures_are_the_same_from_process_to_process(tmp_path: Path) -> None:
    script = """
import hashlib, sys
import numpy as np
from memorymaze.agents.navid.motions import Frame
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.world.sites import load_site
site = load_site(sys.argv[1])
start = site.routes[0].start
robot = SimulatedRobot(build_scene(site), start)
for step in range(3):
    robot.step_forward(0.25)
    frame = Frame(step, None, robot.camera_picture().rgb, "x")
    print(hashlib.sha256(frame.jpeg().data + frame.jpeg(320).data).hexdigest())
"""
    plan = Path(__file__).parents[2] / "tiny_sites" / "corridor.geojson"
    printed = [
        subprocess.run(
            [sys.executable, "-c", script, str(plan)],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for _ in range(2)
    ]
    assert printed[0] == printed[1]
    assert len(set(printed[0].split())) == 3


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({}, "name a language model with --model, or take recorded replies"),
        ({"language_model": ModelSettings(record="a", replay="b")}, "not both"),
        ({"language_model": ModelSettings(replay="none")}, "no recorded"),
    ],
)
def test_what_cannot_be_made_is_explained(settings: Any, said: str) -> None:
    with pytest.raises(SettingsError, match=said):
        choose_agent(AgentSettings("navid", **settings)).make()
