"""Which ways lead away from a place, by rings of free floor around it."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from memorymaze.geometry.pose import turn_between, wrap_angle
from memorymaze.perception.turning_points.local_map import CELL

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

HALF_BODY = 0.35
"""Metres a robot's middle keeps from everything; ways are twice as wide at least."""
RING_GAP = 0.4
"""Metres from the largest free circle around a place to where its ways begin."""
RING = 0.6
"""Metres of a way's beginning that tell where it lies."""
REACH = 1.5
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


class Surroundings:
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
        """Return how far a robot can drive straight into a way, metres.

        Args:
            mouth: Where it begins; from there or up to a quarter of the width aside.
            headings: Radians, shape (N,).

        Returns:
            Shape (N,), at most `FARTHEST_REACH`.
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

    Args:
        ways: Lines; where they are parallel they do not tell how far along.
        middle: Metres; what decides then.
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
    far out, not beyond the free circle.

    Args:
        way: One of the ways.
        ways: All ways.
        radius: Of the free circle around the turning point's middle, metres.
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
