"""What one episode's robot meets beyond the plan: placed things and a crowd."""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from shapely import Point, Polygon

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.motion.clearance import Clearance
from memorymaze.simulation.obstacles.closeness import Closeness
from memorymaze.simulation.obstacles.crowd import Crowd, RobotMotion
from memorymaze.simulation.obstacles.kinds import Movable
from memorymaze.simulation.obstacles.placing import footprint, place_things
from memorymaze.simulation.obstacles.settings import ObstacleSettings
from memorymaze.simulation.obstacles.yielding import STANDING
from memorymaze.simulation.scene import Scene

PEOPLE_MET = 6.0
"""Metres within which people who stand matter to a way round them."""
NOTED_EVERY = 1.0
"""Seconds after which it is kept again where people are."""
PERSON_ROOM = 0.2
"""Metres around a person who stands that a way round leaves, besides its own."""


@dataclass(frozen=True, slots=True)
class PlacedThing:
    """A thing of an episode, and where it stands."""

    record: Movable
    pose: Pose
    """Of its middle; its front faces along the heading."""


class Surroundings:
    """Things and people of one episode. Time passes only in `advance`."""

    def __init__(
        self,
        scene: Scene,
        data: mujoco.MjData,
        robot: Pose,
        keep_free: Sequence[tuple[float, float]],
        rng: np.random.Generator,
    ) -> None:
        """Place things and people.

        Args:
            scene: A building with movables.
            data: The state of physics, in which they are put in their places.
            robot: Where the robot begins.
            keep_free: Points where nothing may stand, besides that, metres.
            rng: Where every choice comes from.
        """
        self._scene = scene
        self._data = data
        settings = scene.obstacles or ObstacleSettings()
        self.patience = settings.patience
        """Seconds a move waits for people before it reports an obstacle."""
        for_things, for_people = rng.spawn(2)
        things = [each for each in scene.movables if not each.is_person]
        poses = place_things(
            scene.site, things, [(robot.x, robot.y), *keep_free], for_things
        )
        self.things = tuple(
            PlacedThing(thing, pose)
            for thing, pose in zip(things, poses, strict=True)
            if pose is not None
        )
        """What stands somewhere; things that found no place are not there."""
        self._solids: list[Polygon] = [
            *(each.footprint for each in scene.site.landmarks if each.obstacle),
            *(footprint(each.record, each.pose) for each in self.things),
        ]
        floor = scene.site.walkable_floor
        self.clearance = Clearance(floor, self._solids)
        """Distances to walls and everything that stands."""
        for each in self.things:
            self._put(each.record, *each.pose)
        people = [each for each in scene.movables if each.is_person]
        self.crowd: Crowd | None = None
        """Who walks about; None where nobody does."""
        self.closeness: Closeness | None = None
        if people:
            self.crowd = Crowd(
                people,
                scene.walks,
                self.clearance,
                floor,
                self._solids,
                (robot.x, robot.y),
                for_people,
            )
            self.closeness = Closeness(self.crowd)
            self._show_people()
        self.walked: list[tuple[float, str, float, float]] = []
        """Where people were: seconds, id, x and y in metres, about once a second."""
        self._note_people(0.0)

    def advance(self, now: float, pose: Pose, velocity: tuple[float, float]) -> None:
        """Let people walk until a simulated time."""
        if self.crowd is None or self.closeness is None:
            return
        self.crowd.advance(now, RobotMotion(pose.x, pose.y, *velocity))
        self.closeness.update(now, pose)
        self._show_people()
        if now - self.walked[-1][0] >= NOTED_EVERY:
            self._note_people(now)

    def clearance_now(self, place: tuple[float, float]) -> Clearance | None:
        """Return distances to everything that stands, people near a place among it.

        None when nobody stands there.
        """
        crowd = self.crowd
        standing = [
            each
            for each in (() if crowd is None else crowd.near(*place, PEOPLE_MET))
            if each.pace < STANDING
        ]
        if not standing:
            return None
        discs = [
            Point(each.x, each.y).buffer(each.radius + PERSON_ROOM) for each in standing
        ]
        return Clearance(self._scene.site.walkable_floor, [*self._solids, *discs])

    def _show_people(self) -> None:
        if self.crowd is not None:
            for person in self.crowd.people:
                self._put(person.record, person.x, person.y, person.heading)

    def _note_people(self, now: float) -> None:
        people = () if self.crowd is None else self.crowd.people
        self.walked += [(now, each.record.id, each.x, each.y) for each in people]

    def _put(self, movable: Movable, x: float, y: float, heading: float) -> None:
        body = self._scene.mocap_ids[movable.id]
        self._data.mocap_pos[body] = (x, y, movable.size[2] / 2)
        self._data.mocap_quat[body] = (np.cos(heading / 2), 0, 0, np.sin(heading / 2))
