"""Puts NavGPT, the one agent that gets a navigation graph, on the graph of a site."""

import math
from collections.abc import Callable
from functools import lru_cache
from typing import ClassVar

import numpy as np

from memorymaze.agents.agent import Journal, Need
from memorymaze.agents.navgpt import NavGPTAgent
from memorymaze.agents.navgpt.agent import loop_limits
from memorymaze.errors import SettingsError
from memorymaze.evaluation.guarded_robot import simulated_behind
from memorymaze.robot.api import Robot
from memorymaze.robot.viewpoints import Panorama
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.viewpoint_walk import ViewpointWalk
from memorymaze.sites import Site
from memorymaze.sites.navigation_graph import (
    NavigationGraph,
    Viewpoint,
    navigation_graph,
)

VIEWPOINT_SPACING = 2.25
"""Metres between viewpoints along corridors, as in R2R."""
DRIVING_ROOM = 0.3
"""Metres that edges keep from walls: the robot's radius, and what steering needs."""

Describe = Callable[[SimulatedRobot, Journal], Callable[[Viewpoint], Panorama]]
"""Gives, for an episode, what describes what is seen from viewpoints; what that costs is
counted in the journal."""


class NavGPTOnGraph:
    """NavGPT as an agent for runs: an `Agent` that needs a simulated robot.

    The graph goes round the robot here, for this agent alone; no other agent's robot has
    one. The goal and the route of the episode are not known here.
    """

    needs: ClassVar[frozenset[Need]] = NavGPTAgent.needs

    def __init__(self, agent: NavGPTAgent, describe: Describe | None = None) -> None:
        """Stand for an agent.

        `describe` tells what is seen; None takes templates.
        """
        self._agent = agent
        self._describe = describe
        self.prompts = agent.prompts
        """Versions of the prompts that the agent asks with."""

    @property
    def name(self) -> str:
        """That of the agent."""
        return self._agent.name

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Let the agent walk the graph of the robot's site."""
        simulated = simulated_behind(robot, self.name)
        describe = self._describe
        walk = ViewpointWalk(
            simulated,
            graph_of(simulated.scene),
            None if describe is None else describe(simulated, journal),
        )
        limits = loop_limits(
            self._agent.options, longest_route_viewpoints(simulated.scene.site)
        )
        self._agent.follow(instruction, walk, journal, limits)


@lru_cache(maxsize=8)
def graph_of(scene: Scene) -> NavigationGraph:
    """Return the navigation graph that robots drive in a scene."""
    return navigation_graph(
        scene.site, spacing=VIEWPOINT_SPACING, robot_radius=DRIVING_ROOM
    )


def longest_route_viewpoints(site: Site) -> int:
    """Return how many viewpoints lie along the longest route of a site.

    Every route of the site counts, alternatives too, and one viewpoint for each 2.25 m:
    the number is the same in every episode there, so it tells nothing of its route.
    """
    if not site.routes:
        raise SettingsError(
            f"{site.name}: the site has no routes to set NavGPT's budget by"
        )
    longest = max(route.length for route in site.routes)
    return math.ceil(longest / VIEWPOINT_SPACING) + 1
