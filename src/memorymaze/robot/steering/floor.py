"""What steering needs to know of the floor, as roles: from a plan, or from scans."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.steering.detours import FreeSpace
from memorymaze.robot.steering.turning_points import TurningPointSource

END_GAP = 0.7
"""Metres from the robot's centre to the wall at which it halts."""


@dataclass(frozen=True, slots=True)
class StraightWay:
    """A line to follow."""

    points: tuple[XY, ...]
    """Vertices, metres; the first is the place nearest to the robot."""
    courses: tuple[float, ...]
    """Heading of the corridor or the open way at each piece, one less than points."""
    halt: float
    """Metres along the line at which the robot has to halt."""


class Surroundings(Protocol):
    """What may stand or walk in the way that was not there when the way was planned."""

    @property
    def patience(self) -> float:
        """Seconds a move waits before it reports an obstacle."""
        ...

    def room_ahead(
        self, places: Sequence[tuple[float, float, float]], speed: float
    ) -> float | None:
        """Return the metres to drive to whoever is in the way; None with nobody in it.

        `places` are where the robot will be, `LANE_STEP` apart, from where it is now: x, y
        in metres and heading in radians.
        """
        ...

    def clearance_now(self, place: XY) -> FreeSpace | None:
        """Return the room there is now around a place; None where nobody stands."""
        ...


class KnownFloor(Protocol):
    """What is known of the floor one robot drives on."""

    @property
    def turning_points(self) -> TurningPointSource:
        """Where it can turn into other ways."""
        ...

    @property
    def clearance(self) -> FreeSpace:
        """The room there is, people left out."""
        ...

    @property
    def surroundings(self) -> Surroundings | None:
        """What may come in the way; None for nothing, which costs nothing."""
        ...

    @property
    def horizon(self) -> float:
        """Metres after which a way is to be found anew; inf where it is known whole."""
        ...

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """Take note of where the robot is; see `TurningPointSource.update`."""
        ...

    def straight_way(
        self, position: XY, course: float, *, fresh: bool, towards: str | None
    ) -> StraightWay:
        """Return the straight way from a place, for a robot on a course.

        A `fresh` robot has turned since it last followed a way, and joins one at a greater
        angle. `towards` is what the way leads to that a turn was made into.
        """
        ...

    def is_blocked_ahead(self, pose: Pose, course: float) -> bool:
        """Whether the robot touches what is in its way, or would at the next step."""
        ...

    def what_blocks(self) -> Literal["wall", "obstacle"]:
        """Return what the robot pushed against when it could not get on."""
        ...


LANE_STEP = 0.2
"""Metres between the places of a lane that are looked at."""
LOOK_AROUND = 1.5
"""Seconds of waiting from one look for a way round people who stand to the next."""
GETS_PAST = 1.5
"""Metres that a way round people must lead on for the robot to take it."""
