"""What is free and what is not around the robot, from its last scans; a square grid."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from memorymaze.geometry.pose import Pose

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

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
        """Take note of a scan.

        Args:
            pose: Of the robot, in the odometry's frame.
            angles: Of the rays, radians from straight ahead, evenly round the full
                circle, ascending; shape (N,).
            ranges: Metres, `inf` without a return; shape (N,).
            moved: Metres driven since the scan before.
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
        seen = _without_drop_outs(ranges)
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


def _without_drop_outs(ranges: FloatArray) -> FloatArray:
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
