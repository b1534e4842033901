"""What the plan tells steering of the floor, and what a body feels of it."""

import math
from typing import Literal

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.body import BodyInSite
from memorymaze.robot.simulation.motion.clearance import Clearance
from memorymaze.robot.steering.floor import StraightWay, Surroundings
from memorymaze.robot.steering.turning_points import TurningPointSource

THINGS = ("landmark", "thing", "person")
"""Kinds of collisions with what is no wall."""


class PlanFloor:
    """The floor as its plan tells it; implements `KnownFloor`."""

    horizon = math.inf

    def __init__(self, body: BodyInSite, turning_points: TurningPointSource) -> None:
        """Know the building of a body."""
        self._body = body
        self._ways = body.scene.straight_ways
        self.turning_points = turning_points
        self.surroundings: Surroundings | None = body.surroundings
        self.clearance: Clearance = body.scene.clearance
        if body.surroundings is not None:
            self.clearance = body.surroundings.clearance
        self.update = turning_points.update

    def straight_way(
        self, position: XY, course: float, *, fresh: bool, towards: str | None
    ) -> StraightWay:
        """See `Floor.straight_way`."""
        return self._ways.way(position, course, fresh=fresh, towards=towards)

    def is_blocked_ahead(self, pose: Pose, course: float) -> bool:
        """See `Floor.is_blocked_ahead`; it knows when it touches something."""
        return self._body.touches_ahead(course)

    def what_blocks(self) -> Literal["wall", "obstacle"]:
        """See `Floor.what_blocks`."""
        collisions = self._body.collisions
        hit_thing = bool(collisions) and collisions[-1].kind in THINGS
        return "obstacle" if hit_thing else "wall"
