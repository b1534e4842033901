"""A stand-in for a server, and bodies on it."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from tests.robot.carla.stand_in import TINY_OPENDRIVE, StandInServer

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.carla import CarlaBody, CarlaOptions
from memorymaze.robot.steering.settings import RobotSettings
from memorymaze.world.sites import Site

MakeBody = Callable[..., CarlaBody]
START = Pose(2.0, 0.0, 0.1)


@pytest.fixture
def server(l_site: Site) -> StandInServer:
    """East along y = 0 from 0 to 12, then left along x = 11, all 2 m wide."""
    return StandInServer(l_site)


@pytest.fixture
def put_body(server: StandInServer) -> Iterator[MakeBody]:
    """Put a body on the stand-in: `put_body(Pose(2, 0, 0), carla_pedestrians=3)`."""
    made: list[CarlaBody] = []

    def put(start: Pose = START, *, seed: int = 0, **options: Any) -> CarlaBody:
        rng = np.random.default_rng(seed)
        made.append(
            CarlaBody(
                server.site,
                start,
                RobotSettings(),
                rng,
                options=CarlaOptions(**options),
                connect=server.connect,
                write_map=lambda _: TINY_OPENDRIVE,
            )
        )
        return made[-1]

    yield put
    server.die(after=10**9)
    for each in made:
        each.close()
