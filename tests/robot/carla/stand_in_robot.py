"""A robot for `evaluate --robot`: the body in CARLA, on a server that is our simulation.

memorymaze evaluate --robot tests/robot/carla/stand_in_robot.py:factory
"""

import runpy
from pathlib import Path
from typing import Any

import numpy as np

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.carla import CarlaBody, CarlaOptions
from memorymaze.robot.steering.settings import RobotSettings
from memorymaze.world.sites import Site

_stand_in = runpy.run_path(str(Path(__file__).with_name("stand_in.py")))
_servers: dict[str, Any] = {}


def factory(
    site: Site,
    start: Pose,
    settings: RobotSettings,
    rng: np.random.Generator,
    *,
    options: CarlaOptions,
) -> CarlaBody:
    """Put the body on its start; the server of a site goes on from episode to episode."""
    if site.name not in _servers:
        _servers[site.name] = _stand_in["StandInServer"](site)
    return CarlaBody(
        site,
        start,
        settings,
        rng,
        options=options,
        connect=_servers[site.name].connect,
        write_map=lambda _: _stand_in["TINY_OPENDRIVE"],
    )


factory.Options = CarlaOptions  # type: ignore[attr-defined]


def second_dies(*given: Any, options: CarlaOptions) -> CarlaBody:
    """Do the same on servers of which the second dies after two seconds."""
    _servers.clear()
    body = factory(*given, options=options)
    _made.append(body)
    if len(_made) == 2:
        [server] = _servers.values()
        server.die(after=40)
    return body


_made: list[CarlaBody] = []
second_dies.Options = CarlaOptions  # type: ignore[attr-defined]
