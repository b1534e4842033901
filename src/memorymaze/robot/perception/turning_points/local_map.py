"""What the last scans tell: what is free around the robot, and which way walls run."""

import math
from collections import deque

import numpy as np
from scipy import ndimage

from memorymaze.basics.geometry.points import BoolArray, FloatArray
from memorymaze.basics.geometry.pose import Pose

CELL = 0.15
"""Side of a cell, metres."""
SIDE = 128
"""Cells along a side of the map: 19 m."""
RECENTRE = 2.0
"""Metres from the map's middle at which the map moves along with the robot."""
HIT = 3.0
"""Evidence of a ray that ended in a cell against one that went through it."""
CEILING = 8.0
"""Greatest evidence for or against; what has changed is believed after as many scans."""
FADING = 12.0
"""Metres after whose driving evidence is down to a third, so that drift is forgotten."""
SCAN_SPACING = 0.4
"""Metres the robot drives from one kept scan to the next."""
SCANS = 20
"""Kept scans: the last 8 m."""
NEIGHBOURS = 3
"""A hit's wall runs from so many hits before it to so many after it."""
LONGEST = 1.5
"""Metres between those outer hits; across gaps they lie on no common wall."""
STRAIGHT = 0.06
"""Metres the hit may lie beside their line."""
SECTOR = math.radians(40)
"""Greatest angle between a way as it seems at first and its walls."""
BIN = math.radians(3)
"""Directions that differ by less are one wall's."""
BINS = np.arange(-SECTOR, SECTOR + BIN / 2, BIN)
MOST_DIRECTIONS = 3
"""Directions that are told at most; more are no longer walls."""
LEAST_WALL = 1.5
"""Metres of wall, seen once or several times, that tell a direction."""


class LocalMap:
    """A grid of evidence that moves with the robot in the odometry's frame."""

    def __init__(self) -> None:
        """Begin with nothing known."""
        self._evidence = np.zeros((SIDE, SIDE), dtype=np.float32)
        self._corner = (-SIDE // 2, -SIDE // 2)
        self._middles = (np.arange(SIDE) + 0.5) * CELL

    @property
    def free(self) -> BoolArray:
        """Cells seen free more often than not, shape (SIDE, SIDE), first index x."""
        return self._evidence > 0.5

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Return the position in metres of a place in cells."""
        return (x + 0.5 + self._corner[0]) * CELL, (y + 0.5 + self._corner[1]) * CELL

    def cell(self, x: float, y: float) -> tuple[int, int]:
        """Return the cell of a position in metres."""
        return (
            math.floor(x / CELL) - self._corner[0],
            math.floor(y / CELL) - self._corner[1],
        )

    def add(
        self, pose: Pose, angles: FloatArray, ranges: FloatArray, moved: float
    ) -> None:
        """Take note of a scan, made so many metres after the last.

        See `TurningPointFinder.update`.
        """
        self._move_along(pose)
        if moved > 0:
            self._evidence *= math.exp(-moved / FADING)
        corner = self._corner
        dx = (self._middles + corner[0] * CELL - pose.x)[:, np.newaxis]
        dy = (self._middles + corner[1] * CELL - pose.y)[np.newaxis, :]
        distances = np.hypot(dx, dy)
        step = 2 * math.pi / len(angles)
        turns = (np.arctan2(dy, dx) - pose.heading - angles[0]) / step
        before = np.floor(turns).astype(np.intp)
        seen = without_drop_outs(ranges)
        nearer = np.minimum(seen, np.roll(seen, -1))
        through = distances < nearer[before % len(angles)] - CELL / 2
        self._evidence[through] += 1.0
        hit = np.isfinite(ranges)
        headings = angles[hit] + pose.heading
        x = np.floor((pose.x + ranges[hit] * np.cos(headings)) / CELL) - corner[0]
        y = np.floor((pose.y + ranges[hit] * np.sin(headings)) / CELL) - corner[1]
        inside = (x >= 0) & (x < SIDE) & (y >= 0) & (y < SIDE)
        cells = np.unique((x[inside] * SIDE + y[inside]).astype(np.intp))
        self._evidence.ravel()[cells] -= HIT
        np.clip(self._evidence, -CEILING, CEILING, out=self._evidence)

    def _move_along(self, pose: Pose) -> None:
        wanted = (
            math.floor(pose.x / CELL) - SIDE // 2,
            math.floor(pose.y / CELL) - SIDE // 2,
        )
        dx, dy = wanted[0] - self._corner[0], wanted[1] - self._corner[1]
        if max(abs(dx), abs(dy)) * CELL < RECENTRE:
            return
        kept = np.zeros_like(self._evidence)
        if abs(dx) < SIDE and abs(dy) < SIDE:
            kept[max(-dx, 0) : SIDE - max(dx, 0), max(-dy, 0) : SIDE - max(dy, 0)] = (
                self._evidence[
                    max(dx, 0) : SIDE + min(dx, 0), max(dy, 0) : SIDE + min(dy, 0)
                ]
            )
        self._evidence = kept
        self._corner = wanted


def without_drop_outs(ranges: FloatArray) -> FloatArray:
    """Return ranges with single rays that gave nothing filled from their neighbours.

    Where neighbours gave nothing either, there is nothing near: `inf` stays.
    """
    missing = ~np.isfinite(ranges)
    if not missing.any():
        return ranges
    filled = np.array(ranges)
    smooth = ndimage.median_filter(ranges, size=5, mode="wrap")
    filled[missing] = smooth[missing]
    return filled


class WallDirections:
    """Hits with the direction of the wall they lie on, in the odometry's frame."""

    def __init__(self) -> None:
        """Begin knowing no walls."""
        self._scans: deque[FloatArray] = deque(maxlen=SCANS)
        self._last: Pose | None = None
        self._all: FloatArray | None = None

    def add(self, pose: Pose, angles: FloatArray, ranges: FloatArray) -> None:
        """Take note of a scan, if the robot has driven on since the last one kept."""
        last = self._last
        if last is not None and math.dist(last[:2], pose[:2]) < SCAN_SPACING:
            return
        self._last = pose
        self._all = None
        with np.errstate(invalid="ignore"):
            x = pose.x + ranges * np.cos(angles + pose.heading)
            y = pose.y + ranges * np.sin(angles + pose.heading)
            dx = np.roll(x, -NEIGHBOURS) - np.roll(x, NEIGHBOURS)
            dy = np.roll(y, -NEIGHBOURS) - np.roll(y, NEIGHBOURS)
            length = np.hypot(dx, dy)
            aside = np.abs(
                (x - np.roll(x, NEIGHBOURS)) * dy - (y - np.roll(y, NEIGHBOURS)) * dx
            )
            good = (length < LONGEST) & (aside < STRAIGHT * length)
        good &= np.isfinite(ranges)
        self._scans.append(
            np.stack([x[good], y[good], np.arctan2(dy[good], dx[good]), length[good]])
        )

    @property
    def hits(self) -> FloatArray:
        """All kept hits: x, y, direction of the wall and metres of it, shape (4, N)."""
        if self._all is None:
            self._all = np.concatenate(self._scans, axis=1)
        return self._all

    def along(self, x: float, y: float, radius: float, heading: float) -> FloatArray:
        """Return the directions of walls around a place near a heading, radians.

        The one with most wall comes first; none where no walls run near the heading.
        """
        hits = self.hits
        near = (hits[0] - x) ** 2 + (hits[1] - y) ** 2 < radius * radius
        off = (hits[2][near] - heading + math.pi / 2) % math.pi - math.pi / 2
        length = hits[3][near]
        weights, _ = np.histogram(off, BINS, weights=length)
        weights = np.convolve(weights, [0.5, 1.0, 0.5], mode="same")
        found: list[float] = []
        while len(found) < MOST_DIRECTIONS:
            best = int(weights.argmax())
            if weights[best] < LEAST_WALL:
                break
            middle = (BINS[best] + BINS[best + 1]) / 2
            close = np.abs(off - middle) < 2 * BIN
            found.append(heading + float(np.average(off[close], weights=length[close])))
            weights[max(best - 3, 0) : best + 4] = 0
        return np.array(found)
