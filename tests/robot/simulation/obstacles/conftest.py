"""Robots among people whom a test puts where it needs them."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.obstacles.crowd import Person
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.world.sites.records import Site


@pytest.fixture(scope="session")
def narrow(plans: Any) -> Site:
    """A corridor along y = 0, 24 m long and 1.6 m wide: nobody passes the robot."""
    return plans.site(plans.corridor("c", 0, -0.8, 24, 0.8))


@pytest.fixture(scope="session")
def wide(plans: Any) -> Site:
    """A corridor along y = 0, 24 m long and 4 m wide."""
    return plans.site(plans.corridor("c", 0, -2, 24, 2))


@pytest.fixture
def crowded() -> Callable[..., SimulatedRobot]:
    """Put a robot at (2, 0), facing east, among so many people."""

    def put(site: Site, people: int = 1, *, seed: int = 0, **settings: Any):
        obstacles = ObstacleSettings(things_per_100m=0, people=people, **settings)
        return SimulatedRobot(
            build_scene(site, obstacles),
            Pose(2, 0, 0),
            SimulationSettings(),
            np.random.default_rng(0),
            obstacles_rng=np.random.default_rng(seed),
        )

    return put


@pytest.fixture
def person_of() -> Callable[..., Person]:
    """Put the only person somewhere: who stands, or walks to a place."""

    def put(
        robot: SimulatedRobot,
        x: float,
        y: float,
        *,
        stands_until: float = 0.0,
        walks_to: tuple[float, float] | None = None,
    ) -> Person:
        assert robot.surroundings is not None
        assert robot.surroundings.crowd is not None
        [person] = robot.surroundings.crowd.people
        person.x, person.y, person.vx, person.vy = x, y, 0.0, 0.0
        goal = walks_to or (x, y)
        way = np.linspace((x, y), goal, 30)
        person.take(way, np.zeros(30, dtype=bool), goal)
        person.stands_until = person.progress_at = stands_until
        return person

    return put
