"""How much time an episode may take when nobody says otherwise."""

import math
from collections.abc import Iterable

import numpy as np

from memorymaze.errors import SettingsError
from memorymaze.simulation.settings import SimulationSettings
from memorymaze.sites.records import Route

GENEROSITY = 3.0
"""A run's time budget lets a perfect follower finish any route this many times over."""


def perfect_time(route: Route, settings: SimulationSettings) -> float:
    """Return the seconds a robot needs that follows a route's line without a mistake.

    It drives every straight piece at full speed, speeds up and brakes once per piece,
    and turns on the spot between pieces:

        sum over pieces of (length / v + v / a)
        + sum over turns of (angle / w + w / b)

    with v, a, w, b the greatest speed, acceleration, turn rate and turn acceleration.
    """
    pieces = np.diff(np.array(route.line.coords)[:, :2], axis=0)
    pieces = pieces[np.hypot(pieces[:, 0], pieces[:, 1]) > 0]
    lengths = np.hypot(pieces[:, 0], pieces[:, 1])
    headings = np.unwrap(np.arctan2(pieces[:, 1], pieces[:, 0]))
    turns = np.abs(np.diff(headings))
    speed, rate = settings.max_speed, settings.max_turn_rate
    driving = lengths / speed + speed / settings.max_acceleration
    turning = turns / rate + rate / settings.max_turn_acceleration
    return float(driving.sum() + turning[turns > 0].sum())


def default_time_budget(routes: Iterable[Route], settings: SimulationSettings) -> float:
    """Return three times the perfect time of the slowest route, in whole seconds.

    Args:
        routes: The routes of all sites of a run, alternatives too.
        settings: The robot's abilities.

    Raises:
        SettingsError: There are no routes.
    """
    times = [perfect_time(route, settings) for route in routes]
    if not times:
        raise SettingsError("the sites of this run have no routes to set a budget by")
    return float(math.ceil(GENEROSITY * max(times)))
