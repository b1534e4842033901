"""Which pieces of a scene can be seen from where: walls on the plan hide what is behind.

Only a plan is looked at, so whatever may be seen counts as seen, never the reverse.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.world.looks.floor_plan import (
    WallFace,
    WallSurroundings,
    clear_of,
)

RAYS_PER_RADIAN = 120
MARGIN = 0.05
"""Metres that a thing may lie behind a wall and still counts as seen."""


def hiding_segments(
    faces: Iterable[WallFace], open_rings: set[int], surroundings: WallSurroundings
) -> FloatArray:
    """Return the pieces of wall that hide what is behind, (n, 4): x, y to x, y, metres.

    Balustrades, glass screens and panes with the open air behind hide nothing.
    """
    segments: list[tuple[float, float, float, float]] = []
    for face in faces:
        if face.ring in open_rings or face.part.open_air:
            continue
        gaps = [hole[:2] for hole in face.holes]
        if face.part.wall_material == "glass":
            gaps = [(0.0, face.length)]
        outwards = face.heading + math.pi
        open_air = [
            (low, high)
            for low, high in gaps
            if surroundings.behind(*face.at((low + high) / 2), outwards)[0]
            == "outdoors"
        ]
        for low, high in clear_of(face.length, open_air):
            segments.append((*face.at(low), *face.at(high)))
    return np.array(segments, dtype=np.float64).reshape(-1, 4)


@dataclass(frozen=True, eq=False)
class SightFan:
    """How far one sees from a place in each of a fan of directions."""

    x: float
    y: float
    bearings: FloatArray
    """Evenly spaced, ascending, relative to `heading`, (N,)."""
    reach: FloatArray
    """Metres to the first wall in each, (N,)."""
    heading: float

    def sees(self, centres: FloatArray, radii: FloatArray) -> NDArray[np.bool_]:
        """Tell which round things may be seen: (n, 2) and (n,) metres."""
        dx, dy = centres[:, 0] - self.x, centres[:, 1] - self.y
        distance = np.hypot(dx, dy)
        around = distance <= radii + 0.1
        bearing = np.arctan2(dy, dx) - self.heading
        bearing = (bearing + np.pi) % (2 * np.pi) - np.pi
        half = np.arcsin(np.clip(radii / np.maximum(distance, 1e-6), 0, 1))
        step = self.bearings[1] - self.bearings[0]
        half = np.where(around, np.pi, half + 1.5 * step)
        needed = distance - radii - MARGIN
        shown = around.copy()
        inside = np.flatnonzero(
            ~around
            & (needed <= self.reach.max())
            & (bearing + half >= self.bearings[0])
            & (bearing - half <= self.bearings[-1])
        )
        # A thing behind the seam of a full circle is seen from the other end.
        shown[inside] = (
            (np.abs(self.bearings - bearing[inside, None]) <= half[inside, None])
            & (self.reach >= needed[inside, None])
        ).any(axis=1)
        if self.bearings[-1] - self.bearings[0] > 2 * np.pi - 2 * step:
            seam = np.abs(bearing) + half > np.pi
            shown |= seam & ~around
        return shown


class Sightlines:
    """The walls of a building that hide things."""

    def __init__(self, segments: FloatArray) -> None:
        """Remember the walls: (n, 4), x, y to x, y, metres."""
        self._starts = segments[:, :2]
        self._along = segments[:, 2:] - segments[:, :2]
        self._middles = (segments[:, :2] + segments[:, 2:]) / 2
        self._halves = np.linalg.norm(self._along, axis=1) / 2

    def outlook(
        self, x: float, y: float, heading: float, half_angle: float, far: float
    ) -> SightFan:
        """Look around."""
        count = max(8, math.ceil(2 * half_angle * RAYS_PER_RADIAN))
        bearings = np.linspace(-half_angle, half_angle, count)
        eye = np.array([x, y])
        offsets = self._middles - eye
        distances = np.hypot(offsets[:, 0], offsets[:, 1])
        near = distances - self._halves < far
        if half_angle < math.pi / 2:
            ahead = np.array([math.cos(heading), math.sin(heading)])
            near &= offsets @ ahead > -self._halves
        starts, along = self._starts[near] - eye, self._along[near]
        cosines, sines = np.cos(bearings + heading), np.sin(bearings + heading)
        # start + t * along = s * direction, solved for s and t by cross products.
        cross = cosines[:, None] * along[:, 1] - sines[:, None] * along[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = 1.0 / cross
            s = (starts[:, 0] * along[:, 1] - starts[:, 1] * along[:, 0]) * inverse
            t = (
                starts[:, 0] * sines[:, None] - starts[:, 1] * cosines[:, None]
            ) * inverse
        hit = (s > 0) & (t >= 0) & (t <= 1)
        reach = np.where(hit, s, far).min(axis=1, initial=far)
        return SightFan(x, y, bearings, reach, heading)
