"""Near misses: how often people and the robot come very close to each other."""

from dataclasses import dataclass

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.motion.wheeled_base import ROBOT_RADIUS
from memorymaze.simulation.obstacles.crowd import Crowd

CLOSE = 0.3
"""Metres between the robot's shell and a person below which it is a near miss."""
APART_AGAIN = 0.4
"""Metres from which on it is over; so that swaying at the limit counts once."""


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
