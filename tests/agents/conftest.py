"""Walks of agents through the tiny sites, with the simulated robot."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest

from memorymaze.agents.agent import Agent, Journal
from memorymaze.basics.errors import EpisodeOver
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.control import Robot
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.calls import TraceEvent

STARTS = {
    "corridor": (2.0, 0.0, 0.0),
    "l_shape": (1.0, 0.0, 0.0),
    "t_junction": (0.0, -9.0, 90.0),
    "crossing": (-10.0, 0.0, 0.0),
    "slanted_crossing": (-10.0, 0.0, 0.0),
    "loop": (1.0, 4.0, 90.0),
    "loop, the other way": (1.0, 4.0, -90.0),
    "two_rooms": (1.5, 3.0, 0.0),
}
"""Where walks begin: x, y, and degrees."""

NEAR = 3.0
"""Metres from the place meant that count as there."""


class Walk(NamedTuple):
    """How a walk went."""

    end: tuple[float, float]
    points: tuple[tuple[float, float], ...]
    metres: float
    stopped_by: str
    calls: tuple[str, ...]
    said: tuple[str, ...]
    looked_for: frozenset[str]
    journal: Journal

    def ends_near(self, x: float, y: float) -> bool:
        return math.dist(self.end, (x, y)) <= NEAR

    def came_by(self, x: float, y: float) -> bool:
        return any(math.dist(point, (x, y)) <= NEAR for point in self.points)

    def notes(self, kind: str) -> list[dict[str, Any]]:
        return [dict(each.details) for each in self.journal.notes if each.about == kind]


TakeWalk = Callable[..., Walk]


@pytest.fixture(scope="session")
def walk_with(scenes: dict[str, Scene]) -> TakeWalk:
    """Walk as told: `walk_with(agent, start, text, seed=…, as_seen=…)`."""

    def walk(
        agent: Agent,
        start: str,
        text: str,
        *,
        seed: int = 0,
        as_seen: Callable[[Robot], Robot] = lambda robot: robot,
    ) -> Walk:
        x, y, degrees = STARTS[start]
        events: list[TraceEvent] = []
        robot = SimulatedRobot(
            scenes[start.partition(",")[0]],
            Pose(x, y, math.radians(degrees)),
            SimulationSettings(),
            np.random.default_rng(0),
            events.append,
        )
        journal = Journal()
        with pytest.raises(EpisodeOver) as over:
            agent.follow(text, as_seen(robot), journal, np.random.default_rng(seed))
        return Walk(
            (robot.pose.x, robot.pose.y),
            tuple((at[0], at[1]) for at in robot.trajectory().points),
            robot.trajectory().length,
            over.value.stopped_by,
            tuple(event.call for event in events),
            tuple(
                str(event.arguments["text"]) for event in events if event.call == "say"
            ),
            frozenset(str(event.arguments.get("object")) for event in events),
            journal,
        )

    return walk
