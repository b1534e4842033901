"""How much time, and how many steps, an episode may take when nobody says otherwise.

A robot that comes to rest after every 25 cm needs several times as long as one that
drives on, so agents that go by primitive motions (a step ahead, a turn on the spot) get
more time.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from memorymaze.agents.agent import FairLimits, Need
from memorymaze.basics.errors import SettingsError
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.world.sites.records import Route

GENEROSITY = 3.0
"""A time budget lets a perfect follower finish the way this many times over."""


STEP_M = 0.25
TURN_DEG = 30
STEP_SECONDS = 1.5
"""Of a primitive motion from rest to rest: 25 cm take 1.4 s, 30 degrees 1.35 s."""


VIEWPOINT_M = 2.25
"""Between viewpoints, as in R2R."""
REQUESTS_PER_VIEWPOINT = 2
FEWEST_REQUESTS = 10
"""As the released code of NavGPT allows on the routes of R2R."""


def _pieces_and_turns(
    route: Route,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the metres of a line's straight pieces, and the radians turned between."""
    pieces = np.diff(np.array(route.line.coords)[:, :2], axis=0)
    lengths = np.hypot(pieces[:, 0], pieces[:, 1])
    pieces, lengths = pieces[lengths > 0], lengths[lengths > 0]
    headings = np.unwrap(np.arctan2(pieces[:, 1], pieces[:, 0]))
    return lengths, np.abs(np.diff(headings))


def perfect_time(route: Route, settings: SimulationSettings) -> float:
    """Return the seconds a robot needs that follows a route's line without a mistake.

    It drives every straight piece at full speed, speeds up and brakes once per piece,
    and turns on the spot between pieces:

        sum over pieces of (length / v + v / a)
        + sum over turns of (angle / w + w / b)

    with v, a, w, b the greatest speed, acceleration, turn rate and turn acceleration.
    """
    lengths, turns = _pieces_and_turns(route)
    speed, rate = settings.max_speed, settings.max_turn_rate
    driving = lengths / speed + speed / settings.max_acceleration
    turning = turns / rate + rate / settings.max_turn_acceleration
    return float(driving.sum() + turning[turns > 0].sum())


def perfect_steps(
    route: Route, step_m: float = STEP_M, turn_deg: float = TURN_DEG
) -> int:
    """Return the primitives of a walk along a route's line without a mistake.

    It goes to the end of each straight piece and past it by less than a step, and turns
    by whole primitives:

        sum over pieces of ceil(length / step) + sum over turns of ceil(angle / turn)
    """
    lengths, turns = _pieces_and_turns(route)
    # What is a whole number but for rounding is one.
    ahead = np.ceil(lengths / step_m - 1e-6)
    aside = np.ceil(np.degrees(turns) / turn_deg - 1e-6)
    return int(ahead.sum() + aside.sum())


def fair_steps(
    routes: Sequence[Route], step_m: float = STEP_M, turn_deg: float = TURN_DEG
) -> int:
    """Return three times the perfect steps of the longest route.

    All routes of a site count, alternatives too: the number is the same in every episode
    there, so it tells nothing of its route.
    """
    steps = [perfect_steps(route, step_m, turn_deg) for route in routes]
    if not steps:
        raise SettingsError("the site has no routes to set a budget of steps by")
    return math.ceil(GENEROSITY * max(steps))


def fair_limits(routes: Sequence[Route]) -> FairLimits:
    """Return what the budget `fair` allows on the site of these routes, alternatives too.

    Two requests for each viewpoint of the longest route, at least ten, and `fair_steps`; a
    viewpoint stands for 2.25 m.
    """
    steps = {degrees: fair_steps(routes, turn_deg=degrees) for degrees in (15, 30)}
    viewpoints = math.ceil(max(each.length for each in routes) / VIEWPOINT_M) + 1
    return FairLimits(max(FEWEST_REQUESTS, REQUESTS_PER_VIEWPOINT * viewpoints), steps)


def time_budget_for(
    needs: frozenset[Need], routes: Sequence[Route], settings: SimulationSettings
) -> float:
    """Return the time budget of an agent that needs these when nobody says otherwise.

    Three times the perfect time of the slowest route of a run's sites, alternatives too,
    in whole seconds; for agents that go by steps the time for `fair_steps`, and no less.
    """
    if not routes:
        raise SettingsError("the sites of this run have no routes to set a budget by")
    slowest = max(perfect_time(route, settings) for route in routes)
    usual = float(math.ceil(GENEROSITY * slowest))
    if "steps" not in needs:
        return usual
    # The smaller turns that can be asked for need the most time.
    return max(usual, math.ceil(STEP_SECONDS * fair_steps(routes, turn_deg=15)))


def episode_time_budget(settings: RunDefinition, route: Route) -> float:
    """Return the time budget of an episode whose instruction describes a route.

    An agent is not told the number, which would tell it how far it has to go.
    """
    if not settings.scales_budget:
        return settings.simulation.time_budget
    return time_budget_for(frozenset(settings.needs), [route], settings.simulation)
