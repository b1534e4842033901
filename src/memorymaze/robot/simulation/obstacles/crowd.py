"""The people of one episode, as they walk about, evade, stop and choose new goals."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from shapely import Polygon

from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.simulation.motion.clearance import Clearance
from memorymaze.robot.simulation.obstacles.walking import Avoidance, Disc, Walks
from memorymaze.robot.steering.detours import make_detours
from memorymaze.world.sites.scene_objects import Movable

LOOK_AHEAD = 3
"""Points of the way ahead of the nearest one at which a person aims."""
SEARCHED = 12
"""Points of the way among which the nearest is looked for."""
ARRIVED = 0.4
"""Metres from the end of the way at which a person has arrived."""
PERIOD = 0.1
"""Seconds from one decision of a person to the next."""
MEAN_SPEED, SPEED_SPREAD = 1.2, 0.2
"""Metres per second, of walking undisturbed: mean and standard deviation."""
SLOWEST, QUICKEST = 0.7, 1.7
"""Speeds drawn outside these are drawn again, metres per second."""
KEEP_RIGHT, ASIDE_SPREAD = 0.45, 0.15
"""Metres to the right of the middle at which people walk: mean, standard deviation."""
WALL_ROOM = 0.45
"""Metres people keep to walls and things where there is room."""
LEAST_ROOM = 0.36
"""Metres they keep everywhere."""
ATTENTION = 4.0
"""Metres within which others make a person look out; alone one just walks."""
ON_WAY = 0.5
"""Metres beside the way from which on a person looks out for walls."""
AGILITY = 5.0
"""Greatest change of velocity, metres per second squared."""
ROBOT_MARGIN = 0.28
"""Metres people keep from the robot's shell, besides the margin they keep anyway."""
LEAST_GAP = 0.04
"""Metres before the robot's shell at which people stop whatever they want."""
STANDS = 0.35
"""Share of goals at which a person stands for a while."""
STANDING_TIME = (3.0, 15.0)
"""Seconds, shortest and longest."""
STUCK_AFTER = 4.0
"""Seconds without getting on after which a person goes elsewhere."""
STUCK_POINTS = 2
"""Points of the way that count as getting on."""
FIRST_GAP = 3.0
"""Metres from the robot's start and 1 m from each other within which nobody begins."""
NEXT_GOAL = 2.0
"""Metres; nobody sets out for a place nearer than this, where there are others."""
TRIES = 60


@dataclass(slots=True, eq=False)
class Person:
    """Someone in one episode; positions in metres, velocities in metres per second."""

    record: Movable
    speed: float
    """Of walking undisturbed, metres per second."""
    rng: np.random.Generator
    """Where the choices of this person come from."""
    x: float = 0.0
    y: float = 0.0
    vx: float = 0.0
    vy: float = 0.0
    heading: float = 0.0
    """The way the person faces, radians."""
    goal: tuple[float, float] = (0.0, 0.0)
    way: NDArray[np.float64] = field(default_factory=lambda: np.zeros((1, 2)))
    """Points to walk along, (N, 2)."""
    tight: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(1, dtype=bool))
    """Whether walls or things are close beside each of these points, (N,)."""
    reached: int = 0
    """Number of the way's point that is nearest."""
    stands_until: float = -math.inf
    """Simulated time up to which the person stands still."""
    progress_at: float = 0.0
    """When the person last got on along the way."""
    progress: int = 0
    """How far the person had come then."""

    @property
    def radius(self) -> float:
        """Metres."""
        return self.record.radius

    @property
    def pace(self) -> float:
        """Metres per second at this moment."""
        return math.hypot(self.vx, self.vy)

    @property
    def in_tight_place(self) -> bool:
        """Whether walls or things are close here or a few steps ahead."""
        return bool(self.tight[self.reached : self.reached + LOOK_AHEAD + 1].any())

    def stand_still(self, until: float) -> None:
        """Stop where one is and stand up to a simulated time."""
        self.stands_until = self.progress_at = max(until, self.stands_until)

    def take(
        self,
        way: NDArray[np.float64],
        tight: NDArray[np.bool_],
        goal: tuple[float, float],
    ) -> None:
        """Begin a way."""
        self.way, self.tight, self.goal = way, tight, goal
        self.reached = self.progress = 0

    def wanted(self) -> tuple[float, float, float]:
        """Return the velocity to go on along the way, and the metres beside it."""
        window = self.way[self.reached : self.reached + SEARCHED]
        dx, dy = window[:, 0] - self.x, window[:, 1] - self.y
        squares = dx * dx + dy * dy
        nearest = int(np.argmin(squares))
        self.reached += nearest
        aside = math.sqrt(float(squares[nearest]))
        ax, ay = self.way[min(self.reached + LOOK_AHEAD, len(self.way) - 1)].tolist()
        ux, uy = ax - self.x, ay - self.y
        left = math.hypot(ux, uy)
        if left < 1e-6:
            return 0.0, 0.0, aside
        share = self.speed / left
        return ux * share, uy * share, aside

    def has_arrived(self) -> bool:
        """Whether the end of the way is reached."""
        ex, ey = self.way[-1].tolist()
        return math.hypot(ex - self.x, ey - self.y) < ARRIVED


class RobotMotion(NamedTuple):
    """Where the robot is and goes: metres, metres per second."""

    x: float
    y: float
    vx: float
    vy: float


class Crowd:
    """People who walk between goals. Time passes only in `advance`."""

    def __init__(
        self,
        records: Sequence[Movable],
        walks: Walks,
        clearance: Clearance,
        floor: Polygon,
        solids: Sequence[Polygon],
        robot: tuple[float, float],
        rng: np.random.Generator,
    ) -> None:
        """Put everyone somewhere on a way."""
        self._walks = walks
        self._clearance = clearance
        self._avoidance = Avoidance(floor, solids)
        self._time = 0.0
        self._decisions = 0
        self.people: list[Person] = []
        """Everyone for whom there was room; never changes."""
        for record, own in zip(records, rng.spawn(len(records)), strict=True):
            person = self._begin(record, own, robot)
            if person is not None:
                self.people.append(person)
        self._minds = [
            self._avoidance.mind(each.radius, each.speed) for each in self.people
        ]

    def advance(self, now: float, robot: RobotMotion) -> None:
        """Let people walk until a simulated time, seconds."""
        while now - self._time > 1e-9:
            due = self._decisions * PERIOD
            if self._time >= due - 1e-9:
                self._decide(robot)
                self._decisions += 1
                due += PERIOD
            step = min(now, due) - self._time
            for person in self.people:
                _walk(person, step, robot)
            self._time += step

    def near(self, x: float, y: float, reach: float) -> list[Person]:
        """Return everyone whose middle is within so many metres of a point."""
        return [
            person
            for person in self.people
            if (person.x - x) ** 2 + (person.y - y) ** 2 <= reach * reach
        ]

    def _decide(self, robot: RobotMotion) -> None:
        count = len(self.people)
        places = np.array([(each.x, each.y) for each in self.people]).reshape(-1, 2)
        close = (
            np.square(places[:, None] - places[None]).sum(axis=2)
            <= ATTENTION * ATTENTION
        )
        discs = [Disc(p.x, p.y, p.vx, p.vy, p.radius) for p in self.people]
        machine = Disc(*robot, ROBOT_RADIUS + ROBOT_MARGIN)
        chosen: list[tuple[float, float]] = []
        for number, person in enumerate(self.people):
            if self._stands(person):
                chosen.append((0.0, 0.0))
                continue
            self._go_elsewhere_if_stuck(person, robot)
            vx, vy, aside = person.wanted()
            others = [
                discs[other]
                for other in np.flatnonzero(close[number]).tolist()
                if other != number
            ]
            if math.dist((person.x, person.y), robot[:2]) <= ATTENTION:
                others.append(machine)
            if others or aside > ON_WAY or person.in_tight_place:
                vx, vy = self._avoidance.decide(
                    self._minds[number], discs[number], (vx, vy), others, PERIOD
                )
            chosen.append((vx, vy))
        for number in range(count):
            _change_velocity(self.people[number], *chosen[number])

    def _stands(self, person: Person) -> bool:
        """Whether a person stands now; one who arrives stands, or goes on elsewhere."""
        if self._time < person.stands_until:
            return True
        if not person.has_arrived():
            return False
        stays = person.rng.random() < STANDS
        self._set_out(person)
        if stays:
            person.stands_until = self._time + person.rng.uniform(*STANDING_TIME)
            person.progress_at = person.stands_until
        return stays

    def _go_elsewhere_if_stuck(self, person: Person, robot: RobotMotion) -> None:
        if person.reached >= person.progress + STUCK_POINTS:
            person.progress, person.progress_at = person.reached, self._time
        elif self._time - person.progress_at > STUCK_AFTER:
            ahead = person.wanted()[:2]
            for _ in range(TRIES):
                self._set_out(person)
                back = person.wanted()[:2]
                if ahead[0] * back[0] + ahead[1] * back[1] < 0:
                    break

    def _set_out(self, person: Person) -> None:
        """Choose a goal and a way to it from where the person is."""
        here = (person.x, person.y)
        goals = self._walks.goals
        apart = [each for each in goals if math.dist(each, here) > NEXT_GOAL]
        goal = (apart or goals)[int(person.rng.integers(len(apart or goals)))]
        way = self._way(here, goal, person.rng)
        tight = self._clearance.to_anything(way) < LEAST_ROOM
        person.take(way, tight, goal)
        person.progress_at = self._time

    def _way(
        self,
        start: tuple[float, float],
        goal: tuple[float, float],
        rng: np.random.Generator,
    ) -> NDArray[np.float64]:
        """Return a way to a goal, on the right of the middle and round things."""
        middle = self._walks.way(start, goal)
        count = len(middle)
        aside = -float(rng.normal(KEEP_RIGHT, ASIDE_SPREAD))
        if count < 3:
            return middle
        normals = polyline.left_normals(middle)
        ramp = np.minimum(np.minimum(np.arange(count), np.arange(count)[::-1]) / 5, 1)
        offsets = aside * ramp
        # Where there is not that much room one walks nearer to the middle.
        for share in (0.5, 0.0):
            room = self._clearance.to_anything(middle + offsets[:, None] * normals)
            tight = room < WALL_ROOM
            offsets = np.where(tight, share * aside * ramp, offsets)
        offsets, reachable = make_detours(
            middle,
            normals,
            polyline.smoothed_rows(offsets, 4),
            LEAST_ROOM + 0.02,
            np.full(count, LEAST_ROOM - 0.06),
            self._clearance,
        )
        offsets[reachable:] = 0.0
        return middle + offsets[:, None] * normals

    def _begin(
        self, record: Movable, rng: np.random.Generator, robot: tuple[float, float]
    ) -> Person | None:
        """Return a person who is on the way somewhere; None where nobody fits."""
        speed = 0.0
        while not SLOWEST <= speed <= QUICKEST:
            speed = float(rng.normal(MEAN_SPEED, SPEED_SPREAD))
        person = Person(record, speed, rng)
        goals = self._walks.goals
        for _ in range(TRIES):
            person.x, person.y = goals[int(rng.integers(len(goals)))]
            self._set_out(person)
            begin = int(rng.integers(max(1, len(person.way) - 3)))
            person.x, person.y = person.way[begin].tolist()
            person.reached = person.progress = begin
            if math.dist((person.x, person.y), robot) >= FIRST_GAP and all(
                math.dist((person.x, person.y), (each.x, each.y)) >= 1.0
                for each in self.people
            ):
                break
        else:
            return None
        vx, vy, _ = person.wanted()
        person.vx, person.vy = vx, vy
        person.heading = math.atan2(vy, vx)
        return person


def _change_velocity(person: Person, vx: float, vy: float) -> None:
    dx, dy = vx - person.vx, vy - person.vy
    change, limit = math.hypot(dx, dy), AGILITY * PERIOD
    if change > limit:
        dx, dy = dx * limit / change, dy * limit / change
    person.vx += dx
    person.vy += dy
    if person.pace > 0.15:
        bearing = math.atan2(person.vy, person.vx)
        turn = turn_between(person.heading, bearing)
        person.heading += max(-0.5, min(0.5, turn))
        person.heading = math.remainder(person.heading, 2 * math.pi)


def _walk(person: Person, step: float, robot: RobotMotion) -> None:
    """Move a person; nobody walks into the robot with open eyes."""
    x, y = person.x + person.vx * step, person.y + person.vy * step
    now = math.dist((person.x, person.y), robot[:2])
    then = math.dist((x, y), robot[:2])
    if then < ROBOT_RADIUS + person.radius + LEAST_GAP and then < now:
        person.vx = person.vy = 0.0
        return
    person.x, person.y = x, y
