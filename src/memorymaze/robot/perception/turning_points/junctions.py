"""Ways that lead away from a place, and the turning points that many sightings tell."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from memorymaze.basics.geometry.points import BoolArray, FloatArray
from memorymaze.basics.geometry.pose import turn_between, wrap_angle
from memorymaze.robot.perception.turning_points.local_map import CELL

HALF_BODY = 0.35
"""Metres a robot's middle keeps from everything; ways are twice as wide at least."""
RING_GAP = 0.4
"""Metres from the largest free circle around a place to where its ways begin."""
RING = 0.6
"""Metres of a way's beginning that tell where it lies."""
SCAN_REACH = 1.5
"""Metres from its mouth that a robot can drive into a way at least; nooks are less
deep."""
FARTHEST_REACH = 5.0
"""Metres from its mouth up to which a way is looked along."""
FARTHEST_MIDDLE = 1.0
"""Metres from the robot to the middle of the ways it is in."""
SMOOTHING = 1.5
"""Cells; small bays and bulges of the walls draw no middle to them."""
LEAST_REACH = 0.9
"""Metres from its centre that a turning point reaches along each way at least."""
DOUBT = 0.02
"""Weight of the middle of the free floor against the lines of the ways, in squares."""
EVERY_NEIGHBOUR = np.ones((3, 3), dtype=bool)
BEND = math.radians(15)
"""A way that bends less goes straight on: alone it makes no turning point."""
SAME_DIRECTION = math.radians(35)
"""Ways seen at less than this angle from each other are one."""
SAME_JUNCTION = 2.0
"""Metres between two sightings of one turning point."""
MEMORY = 0.9
"""Share of a sighting's weight that is left at the next sighting."""


class Mouth(NamedTuple):
    """Where a way begins on the grid."""

    x: float
    """In cells."""
    y: float
    """In cells."""
    bearing: float
    """Seen from the middle, radians."""
    width: float
    """Metres."""
    spread: float
    """Angle under which it is seen from the middle, radians."""


class SensedWay(NamedTuple):
    """A way that leads away from a place, as a line in the odometry's frame."""

    x: float
    """Of the middle of its mouth, metres."""
    y: float
    """Of the middle of its mouth, metres."""
    heading: float
    """Outward, radians."""
    width: float
    """Metres."""

    def moved_towards(self, other: "SensedWay", share: float) -> "SensedWay":
        """Return a mean of two sightings of one way; a share of 1 gives the other."""
        turn = turn_between(self.heading, other.heading)
        return SensedWay(
            self.x + share * (other.x - self.x),
            self.y + share * (other.y - self.y),
            wrap_angle(self.heading + share * turn),
            self.width + share * (other.width - self.width),
        )


class FreeSurroundings:
    """Free floor around a robot, and the room on it."""

    def __init__(self, free: BoolArray) -> None:
        """Measure the room on a grid of free cells."""
        self.room: FloatArray = (
            np.asarray(ndimage.distance_transform_edt(free), dtype=np.float64) * CELL
        )
        """Metres from each cell to the nearest that is not free."""
        self._smooth: FloatArray = np.asarray(
            ndimage.gaussian_filter(self.room, SMOOTHING), dtype=np.float64
        )

    def middle(self, cell: tuple[int, int]) -> tuple[int, int]:
        """Climb from a cell to where the room is greatest around."""
        x, y = cell
        smooth = self._smooth
        while True:
            window = smooth[x - 1 : x + 2, y - 1 : y + 2]
            step = divmod(int(window.argmax()), 3)
            to_x, to_y = x + step[0] - 1, y + step[1] - 1
            if (
                smooth[to_x, to_y] <= smooth[x, y] + 1e-6
                or math.hypot(to_x - cell[0], to_y - cell[1]) * CELL > FARTHEST_MIDDLE
            ):
                return x, y
            x, y = to_x, to_y

    def mouths(self, middle: tuple[int, int]) -> list[Mouth]:
        """Return where ways begin around a middle.

        They are the connected pieces of a narrow ring just outside the largest free
        circle.
        """
        cx, cy = middle
        inner = self.room[middle] + RING_GAP
        cells = int((inner + RING) / CELL) + 2
        left, low = max(cx - cells, 0), max(cy - cells, 0)
        room = self.room[left : cx + cells + 1, low : cy + cells + 1]
        dx = (np.arange(room.shape[0]) + left - cx)[:, np.newaxis] * CELL
        dy = (np.arange(room.shape[1]) + low - cy)[np.newaxis, :] * CELL
        distance = np.hypot(dx, dy)
        disc = _pieces((room > HALF_BODY) & (distance <= inner + RING))
        own = disc[cx - left, cy - low]
        if own == 0:
            return []
        ring = _pieces((disc == own) & (distance >= inner))
        found: list[Mouth] = []
        for piece in range(1, int(ring.max()) + 1):
            x, y = np.nonzero(ring == piece)
            weights = room[x, y] ** 2
            weights /= weights.sum()
            east = float(dx[x, 0] @ weights)
            north = float(dy[0, y] @ weights)
            bearing = math.atan2(north, east)
            off = np.arctan2(dy[0, y], dx[x, 0]) - bearing
            found.append(
                Mouth(
                    cx + east / CELL,
                    cy + north / CELL,
                    bearing,
                    2 * float(room[x, y].max()),
                    float(np.ptp((off + math.pi) % (2 * math.pi))),
                )
            )
        return found

    def depths(self, mouth: Mouth, headings: FloatArray) -> FloatArray:
        """Return how far one can drive straight into a way by headings (N,), metres.

        It begins at the mouth or up to a quarter of its width aside; at most
        `FARTHEST_REACH`.
        """
        steps = np.arange(1, int(FARTHEST_REACH / CELL) + 1)
        aside = np.linspace(-0.25, 0.25, 5) * mouth.width / CELL
        ux, uy = np.cos(headings), np.sin(headings)
        # Shape (headings, offsets aside, steps ahead).
        x = mouth.x + np.multiply.outer(ux, steps)[:, np.newaxis, :]
        y = mouth.y + np.multiply.outer(uy, steps)[:, np.newaxis, :]
        x = x - np.multiply.outer(uy, aside)[:, :, np.newaxis]
        y = y + np.multiply.outer(ux, aside)[:, :, np.newaxis]
        side = len(self.room) - 1
        column = np.clip(np.rint(x), 0, side).astype(np.intp)
        row = np.clip(np.rint(y), 0, side).astype(np.intp)
        driven = np.logical_and.accumulate(
            self.room[column, row] > HALF_BODY, axis=2
        ).sum(axis=2)
        return driven.max(axis=1) * CELL


def crossing(
    ways: Sequence[SensedWay], middle: tuple[float, float]
) -> tuple[float, float]:
    """Return the place nearest to the lines of all ways, metres.

    Where they are parallel they do not tell how far along; the middle decides then.
    """
    normal = np.eye(2) * DOUBT
    right = normal @ np.array(middle)
    for way in ways:
        across = np.array([-math.sin(way.heading), math.cos(way.heading)])
        normal += np.outer(across, across)
        right += across * (across @ np.array([way.x, way.y]))
    x, y = np.linalg.solve(normal, right).tolist()
    return x, y


def reach_along(way: SensedWay, ways: Sequence[SensedWay], radius: float) -> float:
    """Return how far a turning point reaches along one of its ways, metres.

    To where the farther edges of the ways that cross it are; at bends, where these are
    far out, not beyond the free circle of that radius.
    """
    reach = LEAST_REACH
    for other in ways:
        sine = abs(math.sin(other.heading - way.heading))
        if sine > math.sin(math.radians(10)):
            reach = max(reach, min(other.width / 2 / sine, radius))
    return reach


def _pieces(mask: BoolArray) -> NDArray[np.int32]:
    pieces = np.zeros(mask.shape, dtype=np.int32)
    ndimage.label(mask, EVERY_NEIGHBOUR, output=pieces)
    return pieces


@dataclass(slots=True)
class _Belief:
    """A way as the sightings so far tell it."""

    way: SensedWay
    weight: float


@dataclass(slots=True)
class SensedJunction:
    """A turning point, or what may become one."""

    x: float
    """Of the place where its ways meet, metres."""
    y: float
    """Of that place, metres."""
    radius: float
    """Of the free circle there, metres."""
    weight: float = 0.0
    """Of all sightings, the older ones less."""
    beliefs: list[_Belief] = field(default_factory=list[_Belief])
    """Ways that were seen."""
    number: int | None = None
    """In the order of first stays; None before the first."""

    def ways(self) -> list[SensedWay]:
        """Return the ways that most sightings tell."""
        return [each.way for each in self.beliefs if each.weight > 0.5 * self.weight]

    def see(
        self,
        x: float,
        y: float,
        radius: float,
        ways: Sequence[SensedWay],
        weight: float,
    ) -> None:
        """Take note of a sighting, whose weight is 1 for a good one; see the fields."""
        kept = MEMORY**weight
        self.weight = self.weight * kept + weight
        share = weight / self.weight
        self.x += share * (x - self.x)
        self.y += share * (y - self.y)
        self.radius += share * (radius - self.radius)
        for each in self.beliefs:
            each.weight *= kept
        left = list(self.beliefs)
        for way in ways:
            same = min(
                left,
                key=lambda each: abs(turn_between(each.way.heading, way.heading)),
                default=None,
            )
            if (
                same is None
                or abs(turn_between(same.way.heading, way.heading)) > SAME_DIRECTION
            ):
                self.beliefs.append(_Belief(way, weight))
                continue
            left.remove(same)
            same.weight += weight
            same.way = same.way.moved_towards(way, weight / same.weight)
        self.beliefs = [each for each in self.beliefs if each.weight > 0.05]

    def holds(self, x: float, y: float, margin: float) -> bool:
        """Whether a place lies where the ways' strips cross."""
        ways = self.ways()
        dx, dy = x - self.x, y - self.y
        if math.hypot(dx, dy) > SAME_JUNCTION + self.radius:
            return False
        return all(
            dx * math.cos(way.heading) + dy * math.sin(way.heading)
            <= reach_along(way, ways, self.radius) + margin
            for way in ways
        )


def is_turning_point(ways: Sequence[SensedWay]) -> bool:
    """Whether ways are more than one that leads straight on, and more than an end."""
    if len(ways) != 2:
        return len(ways) > 2
    bend = turn_between(ways[0].heading + math.pi, ways[1].heading)
    return abs(bend) > BEND


def is_worth_telling(onward: Sequence[SensedWay], back: SensedWay | None) -> bool:
    """Whether ways onward are more than none and more than straight on alone."""
    if not onward:
        return False
    if len(onward) > 1 or back is None:
        return True
    return abs(turn_between(back.heading + math.pi, onward[0].heading)) > BEND
