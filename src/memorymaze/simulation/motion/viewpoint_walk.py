"""A simulated robot that really drives from viewpoint to viewpoint of a graph."""

import math
from collections.abc import Callable

from memorymaze.errors import EpisodeOver
from memorymaze.geometry.pose import heading_to
from memorymaze.robot.api import MoveResult
from memorymaze.robot.viewpoints import Journey, Panorama, WayOn
from memorymaze.simulation.motion.wheeled_base import ROBOT_RADIUS
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.senses.look_around import look_around
from memorymaze.sites.navigation_graph import NavigationGraph, Viewpoint

THERE = 0.05
"""Metres from a viewpoint within which the robot is on it."""


class ViewpointWalk:
    """One episode on a navigation graph; implements `ViewpointRobot`.

    Collisions, budgets and people count as in any walk. Looking costs no time, as with
    a camera that sees all round.
    """

    def __init__(
        self,
        robot: SimulatedRobot,
        graph: NavigationGraph,
        look: Callable[[Viewpoint], Panorama] | None = None,
    ) -> None:
        """Drive the robot to the viewpoint nearest to it that it can go straight to.

        Args:
            robot: At the start of an episode.
            graph: Of its site.
            look: Describes what is seen from a viewpoint; None for templates filled
                with what the camera truly sees.

        Raises:
            EpisodeOver: A budget ran out on the way.
        """
        self._robot = robot
        self._graph = graph
        self._look = look or self._by_templates
        self._viewpoints = {each.id: each for each in graph.viewpoints}
        self._start_heading = robot.pose.heading
        self._here = self._nearest()
        if math.dist(self._here[1:], robot.pose[:2]) > THERE:
            self._drive_to(self._here)

    @property
    def viewpoint(self) -> str:
        """See `ViewpointRobot.viewpoint`."""
        return self._here.id

    @property
    def start_heading(self) -> float:
        """See `ViewpointRobot.start_heading`."""
        return self._start_heading

    def ways_on(self) -> tuple[WayOn, ...]:
        """See `ViewpointRobot.ways_on`; the nearest first."""
        here = self._here
        ways = [
            WayOn(
                there.id,
                heading_to(here[1:], there[1:]),
                math.dist(here[1:], there[1:]),
            )
            for there in self._graph.neighbours[here.id]
        ]
        return tuple(sorted(ways, key=lambda way: (way.distance, way.viewpoint)))

    def look_around(self) -> Panorama:
        """See `ViewpointRobot.look_around`."""
        return self._look(self._here)

    def go_to(self, viewpoint: str) -> Journey:
        """See `ViewpointRobot.go_to`."""
        there = self._viewpoints.get(viewpoint)
        if there is None:
            return Journey("unknown", 0.0, "")
        if there not in self._graph.neighbours[self._here.id]:
            return Journey("not_adjacent", 0.0, "")
        gone = self._drive_to(there)
        if gone.reason == "done":
            self._here = there
            return Journey("arrived", gone.distance, "")
        back = self._drive_to(self._here)
        return Journey("blocked", gone.distance + back.distance, gone.reason)

    def _drive_to(self, there: Viewpoint) -> MoveResult:
        """Drive straight to a viewpoint."""
        result = self._robot.follow([there[1:]])
        if result.reason == "budget":
            raise EpisodeOver("budget")
        return result

    def _nearest(self) -> Viewpoint:
        pose = self._robot.pose
        clearance = self._robot.scene.clearance
        ordered = sorted(
            self._graph.viewpoints, key=lambda each: math.dist(pose[:2], each[1:])
        )
        return next(
            (
                each
                for each in ordered
                if clearance.is_free([pose[:2], each[1:]], ROBOT_RADIUS)
            ),
            ordered[0],
        )

    def _by_templates(self, viewpoint: Viewpoint) -> Panorama:
        return look_around(self._robot, viewpoint.x, viewpoint.y)
