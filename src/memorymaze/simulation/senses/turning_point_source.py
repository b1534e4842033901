"""Where a robot's knowledge of turning points comes from: a role, and the plan in it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.motion.straight_ways import StraightWays
from memorymaze.simulation.scene import Scene
from memorymaze.simulation.senses.turning_points import (
    TurningPointVisits,
    Visit,
    meeting_point,
)
from memorymaze.sites.records import Exit

XY = tuple[float, float]


class WayOut(Protocol):
    """A way that leads out of a turning point."""

    @property
    def heading(self) -> float:
        """Outward, radians."""
        ...

    @property
    def to(self) -> str | None:
        """Id of the corridor or area it leads to; None where that is not known."""
        ...


class Stay(Protocol):
    """A stay in one turning point."""

    def onward(self) -> Sequence[WayOut]:
        """Return every way but the one it came by."""
        ...

    def choices(self) -> Sequence[WayOut]:
        """Return the ways it can turn into: all, once it has turned here."""
        ...

    def everywhere(self) -> Sequence[WayOut]:
        """Return all ways, the one it came by included."""
        ...

    def meeting_point(self, chosen: int, place: XY, course: float) -> XY:
        """Return where to turn into a way, metres.

        Args:
            chosen: Index of the way in `choices`.
            place: A place on the line the robot comes along, metres.
            course: The way that line goes, radians.
        """
        ...


class TurningPointSource(Protocol):
    """Follows one robot in and out of turning points."""

    @property
    def number(self) -> int | None:
        """Of the turning point it is in, by order of first stays, from 1; or None."""
        ...

    @property
    def current(self) -> Stay | None:
        """The stay that goes on; None outside turning points."""
        ...

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """Take note of where the robot is.

        Args:
            pose: Of the robot.
            travel: The way it moves, or faces when it has not moved yet, radians; None
                while it only turns.
            time: Simulated seconds.
        """
        ...

    def note_turn(self) -> None:
        """Take note that the robot has turned where it is."""
        ...


class AnnotatedTurningPoints:
    """Turning points as the site plan tells them; implements `TurningPointSource`."""

    def __init__(self, scene: Scene) -> None:
        """Begin outside all turning points."""
        self._scene = scene
        self._visits = TurningPointVisits(scene.site)

    @property
    def number(self) -> int | None:
        """See `TurningPointSource.number`."""
        return self._visits.number

    @property
    def current(self) -> Stay | None:
        """See `TurningPointSource.current`."""
        visit = self._visits.current
        if visit is None:
            return None
        return _AnnotatedStay(visit, self._scene.straight_ways)

    def update(self, pose: Pose, travel: float | None, time: float) -> None:
        """See `TurningPointSource.update`."""
        if travel is not None:
            self._visits.update(pose.x, pose.y, travel)

    def note_turn(self) -> None:
        """See `TurningPointSource.note_turn`."""
        self._visits.note_turn()


@dataclass(frozen=True, slots=True)
class _AnnotatedStay:
    visit: Visit
    ways: StraightWays

    def onward(self) -> Sequence[Exit]:
        return self.visit.onward()

    def choices(self) -> Sequence[Exit]:
        return self.everywhere() if self.visit.turned else self.onward()

    def everywhere(self) -> Sequence[Exit]:
        return self.visit.point.exits

    def meeting_point(self, chosen: int, place: XY, course: float) -> XY:
        way = self.choices()[chosen]
        return meeting_point(self.visit.point, way, place, course, self.ways)
