"""Contracts for sites, bodies, finders, robots and agents, for tests of this project and of users.

Each `check_…` function returns None or raises `AssertionError` with what was expected
and what came. No test is in here, and no site, body, finder, robot or agent.
"""

from memorymaze.testing.agents import check_agent
from memorymaze.testing.bodies import check_sensors_and_motion
from memorymaze.testing.finders import check_object_finder
from memorymaze.testing.robots import check_robot
from memorymaze.testing.sites import check_site

__all__ = [
    "check_agent",
    "check_object_finder",
    "check_robot",
    "check_sensors_and_motion",
    "check_site",
]
