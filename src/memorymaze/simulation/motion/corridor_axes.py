"""Centre lines of corridors with a direction, as plain numbers."""

import math
from dataclasses import dataclass

from memorymaze.sites.records import Corridor

XY = tuple[float, float]

ON_FLOOR = 0.01
"""Metres outside the corridor's edge that still count as on its floor."""


@dataclass(frozen=True, slots=True)
class Axis:
    """A corridor's centre line with its floor."""

    corridor: str
    """Id of the corridor."""
    x: float
    """Where the line begins, metres."""
    y: float
    """Where the line begins, metres."""
    ux: float
    """Unit vector along the line."""
    uy: float
    """Unit vector along the line."""
    length: float
    """Metres."""
    corners: tuple[XY, ...]
    """Of the floor, counter-clockwise, metres."""

    @property
    def heading(self) -> float:
        """Of the line, radians."""
        return math.atan2(self.uy, self.ux)

    def reversed_if(self, reverse: bool) -> "Axis":
        """Return the axis that runs the other way, or itself."""
        if not reverse:
            return self
        x, y = self.at(self.length)
        return Axis(self.corridor, x, y, -self.ux, -self.uy, self.length, self.corners)

    def local(self, x: float, y: float) -> XY:
        """Return metres along the axis and to the left of it."""
        dx, dy = x - self.x, y - self.y
        return dx * self.ux + dy * self.uy, dy * self.ux - dx * self.uy

    def at(self, along: float) -> XY:
        """Return the point of the line at metres along it."""
        return self.x + along * self.ux, self.y + along * self.uy

    def covers(self, x: float, y: float) -> bool:
        """Whether a point is on the corridor's floor."""
        px, py = self.corners[-1]
        for qx, qy in self.corners:
            inward = (qx - px) * (y - py) - (qy - py) * (x - px)
            if inward < -ON_FLOOR * math.hypot(qx - px, qy - py):
                return False
            px, py = qx, qy
        return True

    def floor_ahead(self, place: XY) -> float:
        """Return how far it is along the axis from a place to the floor's end.

        Args:
            place: Metres; on the axis.
        """
        nearest = math.inf
        px, py = self.corners[-1]
        for qx, qy in self.corners:
            nx, ny = qy - py, px - qx  # outward normal
            speed = nx * self.ux + ny * self.uy
            if speed > 1e-12:
                gap = nx * (px - place[0]) + ny * (py - place[1])
                nearest = min(nearest, gap / speed)
            px, py = qx, qy
        return max(nearest, 0.0)


def corridor_axis(corridor: Corridor) -> Axis:
    """Return a corridor's axis, running as its centre line does."""
    (ax, ay), (bx, by) = [point[:2] for point in corridor.centre_line.coords]
    length = math.hypot(bx - ax, by - ay)
    ring = corridor.polygon.exterior
    corners = [(x, y) for x, y, *_ in ring.coords[:-1]]
    if not ring.is_ccw:
        corners.reverse()
    ux, uy = (bx - ax) / length, (by - ay) / length
    return Axis(corridor.id, ax, ay, ux, uy, length, tuple(corners))
