"""Which way walls run, from neighbouring hits of the last scans."""

import math
from collections import deque

import numpy as np
from numpy.typing import NDArray

from memorymaze.geometry.pose import Pose

FloatArray = NDArray[np.float64]

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

    def along(self, x: float, y: float, radius: float, heading: float) -> FloatArray:
        """Return the directions of the walls around a place that are near a heading.

        Returns:
            Radians, the one with most wall first, shape (N,); N is 0 where no walls
            run near the heading.
        """
        if self._all is None:
            self._all = np.concatenate(self._scans, axis=1)
        hits = self._all
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
