"""What one robot meets beyond the plan: placed things, a crowd, near misses, and who is in its way."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from shapely import LineString, Point, Polygon

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.api.asking import HEARING_RANGE
from memorymaze.robot.simulation.motion.clearance import Clearance
from memorymaze.robot.simulation.obstacles.crowd import Crowd, Person, RobotMotion
from memorymaze.robot.simulation.obstacles.placing import footprint, place_things
from memorymaze.robot.simulation.obstacles.settings import ObstacleSettings
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.steering.floor import LANE_STEP
from memorymaze.world.sites.scene_objects import Movable

PEOPLE_MET = 6.0
"""Metres within which people who stand matter to a way round them."""
NOTED_EVERY = 1.0
"""Seconds after which it is kept again where people are."""
PERSON_ROOM = 0.2
"""Metres around a person who stands that a way round leaves, besides its own."""
CLOSE = 0.3
"""Metres between the robot's shell and a person below which it is a near miss."""
APART_AGAIN = 0.4
"""Metres from which on it is over; so that swaying at the limit counts once."""
KEPT = 0.2
"""Metres kept between the robot's shell and people, while it goes towards them."""
STAND_OFF = 0.6
"""Metres before the first place too close at which the robot halts; from nearer it
could not go round."""
FORESIGHT = 1.6
"""Seconds ahead to which people's motion is foretold."""
MOMENT = 0.2
"""Seconds between the moments looked at."""
LEAST_SPEED = 0.4
"""Speed in metres per second for which a robot looks ahead that stands."""
REACH = 4.5
"""Metres around the robot within which people are looked at."""
SEEN_ROUND = 0.05
"""Metres that a line of sight may cut a corner of the walls."""
STANDING = 0.15
"""Speed in metres per second below which a person stands."""


@dataclass(slots=True)
class NearMiss:
    """The robot and a person were close; one record however long that lasted."""

    time: float
    """Simulated seconds when it began."""
    pose: Pose
    """Where the robot was then."""
    person: str
    """Id of the person."""
    gap: float
    """Least distance between the robot's shell and the person, metres."""


@dataclass(frozen=True, slots=True)
class PlacedObstacle:
    """A thing of an episode, and where it stands."""

    record: Movable
    pose: Pose
    """Of its middle; its front faces along the heading."""


class ObstacleSurroundings:
    """Things and people of one episode. Time passes only in `advance`."""

    def __init__(
        self,
        scene: Scene,
        data: mujoco.MjData,
        robot: Pose,
        keep_free: Sequence[tuple[float, float]],
        rng: np.random.Generator,
    ) -> None:
        """Place things and people of a scene that has some.

        Nothing stands near the robot or near the points to keep free, metres.
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
            PlacedObstacle(thing, pose)
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

    def room_ahead(
        self, places: Sequence[tuple[float, float, float]], speed: float
    ) -> float | None:
        """Return the metres to drive to the first person in the way; None for nobody.

        Everyone's motion is foretold: people are taken to keep their velocity for a while;
        those behind the robot are left to keep away themselves.
        """
        if self.crowd is None:
            return None
        x, y, _ = places[0]
        first: float | None = None
        pace = max(speed, LEAST_SPEED)
        for person in self.crowd.near(x, y, REACH):
            limit = ROBOT_RADIUS + person.radius + KEPT
            ahead = _conflict(person, places, pace, limit)
            if ahead is not None and (first is None or ahead < first):
                first = ahead
        return first

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

    def person_in_hearing(self, place: Pose) -> Person | None:
        """Return the nearest person who can be asked from a place; None for nobody.

        They are within 3 m, in any direction, and no wall is between.
        """
        within = (
            [] if self.crowd is None else self.crowd.near(*place[:2], HEARING_RANGE)
        )
        in_sight = [
            each
            for each in within
            if self._open.covers(LineString([place[:2], (each.x, each.y)]))
        ]
        return min(
            in_sight,
            key=lambda each: math.dist(place[:2], (each.x, each.y)),
            default=None,
        )

    @cached_property
    def _open(self) -> Polygon:
        """What lines of sight may cross; made once, as agents ask at every look."""
        return self._scene.site.walkable_floor.buffer(SEEN_ROUND)

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
        self._data.mocap_quat[body] = about_z(heading)


class Closeness:
    """Counts near misses of one episode."""

    def __init__(self, crowd: Crowd) -> None:
        """Begin with nobody near."""
        self.near_misses: list[NearMiss] = []
        self._crowd = crowd
        self._running: dict[str, NearMiss] = {}

    def update(self, time: float, pose: Pose) -> None:
        """Take note of who is near."""
        running: dict[str, NearMiss] = {}
        for person in self._crowd.near(pose.x, pose.y, 1.0):
            distance = ((person.x - pose.x) ** 2 + (person.y - pose.y) ** 2) ** 0.5
            gap = max(0.0, distance - person.radius - ROBOT_RADIUS)
            name = person.record.id
            known = self._running.get(name)
            if known is not None and gap < APART_AGAIN:
                known.gap = min(known.gap, gap)
                running[name] = known
            elif gap < CLOSE:
                running[name] = NearMiss(time, pose, name, gap)
                self.near_misses.append(running[name])
        self._running = running


def _conflict(
    person: Person,
    places: Sequence[tuple[float, float, float]],
    pace: float,
    limit: float,
) -> float | None:
    """Return the metres to drive to the first place that comes too close."""
    last = len(places) - 1
    found: float | None = None
    for moment in range(round(FORESIGHT / MOMENT) + 1):
        later = moment * MOMENT
        number = round(pace * later / LANE_STEP)
        if number > last:
            break
        x, y, heading = places[number]
        dx, dy = person.x + person.vx * later - x, person.y + person.vy * later - y
        if dx * dx + dy * dy >= limit * limit:
            continue
        if dx * math.cos(heading) + dy * math.sin(heading) <= 0:
            continue
        found = max(0.0, (number - 1) * LANE_STEP - STAND_OFF)
        break
    return found
