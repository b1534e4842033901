"""Robots on tiny sites, with one person whom a test puts where it needs them."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.obstacles.crowd import Person
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.texts.passers_by import (
    Encounters,
    FloorKnowledge,
    Meet,
    Memory,
    load_bank,
)
from memorymaze.world.sites import Site


@pytest.fixture
def knowing() -> Callable[[Site], FloorKnowledge]:
    """Return what somebody knows who knows a site."""
    return lambda site: FloorKnowledge(
        site, FloorGrid.from_polygon(site.walkable_floor)
    )


@pytest.fixture
def met(t_site: Site) -> Callable[..., tuple[SimulatedRobot, Encounters, Person]]:
    """Put a robot at (0, -6), facing the T junction, and somebody who stands near it."""

    def put(
        person: tuple[float, float] = (0.5, -4.5),
        questions: int = 3,
        *,
        destination: str = "the library",
        seed: int = 0,
        error_rate: float = 0.0,
        time_budget: float = 100.0,
        meet: Meet | None = None,
    ) -> tuple[SimulatedRobot, Encounters, Person]:
        robot = SimulatedRobot(
            build_scene(t_site, ObstacleSettings(things_per_100m=0, people=1)),
            Pose(0, -6, math.pi / 2),
            SimulationSettings(time_budget=time_budget),
            np.random.default_rng(0),
            obstacles_rng=np.random.default_rng(0),
        )
        assert robot.surroundings is not None
        assert robot.surroundings.crowd is not None
        [somebody] = robot.surroundings.crowd.people
        somebody.x, somebody.y, somebody.vx, somebody.vy = *person, 0.0, 0.0
        floor = FloorKnowledge(t_site, FloorGrid.from_polygon(t_site.walkable_floor))
        encounters = Encounters(
            robot,
            meet
            or (
                lambda number, _: Memory(
                    (seed, number), floor, load_bank(), error_rate, 3.0
                )
            ),
            destination,
            questions,
        )
        return robot, encounters, somebody

    return put
