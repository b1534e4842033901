"""What an agent is handed for an episode: its robot, by what it needs."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from memorymaze.agents.agent import Need
from memorymaze.evaluation.budgets import VIEWPOINT_M
from memorymaze.evaluation.guarded_robot import (
    AskingGuardedRobot,
    GuardedRobot,
    RobotThatKnows,
)
from memorymaze.passers_by import Encounters
from memorymaze.robot.viewpoints import Panorama
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.viewpoint_walk import ViewpointWalk
from memorymaze.sites.navigation_graph import (
    NavigationGraph,
    Viewpoint,
    navigation_graph,
)

DRIVING_ROOM = 0.3
"""Metres that edges keep from walls: the robot's radius, and what steering needs."""


def hand_over(
    robot: SimulatedRobot,
    needs: frozenset[Need],
    reference_path: tuple[tuple[float, float], ...],
    people: Encounters | None = None,
    look: Callable[[Viewpoint], Panorama] | None = None,
) -> Any:
    """Return the robot of an episode as an agent gets it that needs these.

    One that needs the graph gets a `ViewpointRobot`, which drives to its first viewpoint;
    one that needs the answers a guarded robot that knows the way. Neither can ask people.

    Args:
        robot: The robot itself.
        needs: What the agent declares.
        reference_path: Of the episode, from its start.
        people: Those one can ask; None where there are none.
        look: Describes what is seen from viewpoints; None for templates.

    Raises:
        EpisodeOver: A budget ran out on the way to the first viewpoint.
    """
    if "graph" in needs:
        return ViewpointWalk(robot, graph_of(robot.scene), look)
    if "answers" in needs:
        return RobotThatKnows(robot, needs, reference_path)
    if people is None:
        return GuardedRobot(robot, needs)
    return AskingGuardedRobot(robot, needs, people)


@lru_cache(maxsize=8)
def graph_of(scene: Scene) -> NavigationGraph:
    """Return the navigation graph that robots drive in a scene."""
    return navigation_graph(scene.site, spacing=VIEWPOINT_M, robot_radius=DRIVING_ROOM)
