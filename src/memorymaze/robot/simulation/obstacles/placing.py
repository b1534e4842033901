"""Where things are left standing: along walls, or in the middle of wide ways."""

import math
from collections.abc import Sequence
from typing import NamedTuple, cast

import numpy as np
import shapely
from shapely import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.geometry.pose import Pose, moved
from memorymaze.world.sites.records import Site, rectangle
from memorymaze.world.sites.scene_objects import Movable

PASSAGE = 0.9
"""Metres that stay free beside a thing, on one side at least."""
TRIES = 40
"""Places looked at before a thing is left out."""
WALL_GAP = 0.04
TURNING_GAP = 0.3
"""Metres kept from turning points, where robots turn on the spot."""
DOOR_GAP = 0.7
"""Metres kept from doors."""
KEPT_FREE = 1.5
"""Metres kept from places that have to stay free, such as start and goal."""
APART = 2.5
"""Metres between the middles of two things."""
WINDOW = 4.0
"""Metres around a thing within which the way past it is looked for."""
EDGE = 1.6
"""Metres around a thing beyond which the floor has to hang together as before."""


class _Stretch(NamedTuple):
    """A piece of floor along which things may stand."""

    line: LineString
    """Its middle."""
    polygon: Polygon


def stretches(site: Site) -> list[_Stretch]:
    """Return the corridors with their centre lines, the areas with their long axes."""
    found = [_Stretch(each.centre_line, each.polygon) for each in site.corridors]
    for area in site.areas:
        outline = cast(Polygon, area.polygon.minimum_rotated_rectangle)
        corners = list(outline.exterior.coords)[:4]
        sides = [math.dist(corners[i], corners[(i + 1) % 4]) for i in range(4)]
        first = int(np.argmin(sides))
        ends = [
            LineString([corners[i % 4], corners[(i + 1) % 4]]).interpolate(
                0.5, normalized=True
            )
            for i in (first, first + 2)
        ]
        found.append(_Stretch(LineString(ends), area.polygon))
    return found


def footprint(thing: Movable, pose: Pose) -> Polygon:
    """Return the rectangle a thing covers; its front faces along the heading."""
    return rectangle(thing.size, *pose)


def place_things(
    site: Site,
    things: Sequence[Movable],
    keep_free: Sequence[tuple[float, float]],
    rng: np.random.Generator,
) -> list[Pose | None]:
    """Find places for things so that no way is sealed; None for one without a place.

    Beside each thing a way of `PASSAGE` metres stays open, on one side at least: floor
    that hung together for a disc of that size still does. Nothing stands in or close to
    turning points, before doors, or near the places to be kept free.
    """
    placer = _Placer(site, keep_free, rng)
    return [placer.place(thing) for thing in things]


class _Placer:
    def __init__(
        self,
        site: Site,
        keep_free: Sequence[tuple[float, float]],
        rng: np.random.Generator,
    ) -> None:
        self._rng = rng
        self._free: BaseGeometry = site.free_floor
        self._stretches = stretches(site)
        self._shares = np.array([each.line.length for each in self._stretches])
        self._shares = self._shares / self._shares.sum()
        self._turning = [each.polygon for each in site.turning_points]
        self._doors = [each.line for each in site.doors]
        self._kept = [Point(point) for point in keep_free]
        self._standing: list[Point] = []
        shapely.prepare(self._free)

    def place(self, thing: Movable) -> Pose | None:
        for _ in range(TRIES):
            found = self._candidate(thing)
            if found is None:
                continue
            pose, across = found
            if self._suits(thing, pose, across):
                self._free = self._free.difference(footprint(thing, pose))
                shapely.prepare(self._free)
                self._standing.append(Point(pose.x, pose.y))
                return pose
        return None

    def _candidate(self, thing: Movable) -> tuple[Pose, float] | None:
        """Choose a place along a stretch, at a wall or in the middle."""
        rng = self._rng
        stretch = self._stretches[int(rng.choice(len(self._shares), p=self._shares))]
        at = float(rng.uniform(0, stretch.line.length))
        side = 1.0 if rng.random() < 0.5 else -1.0
        middle = thing.in_the_middle and rng.random() < 0.5
        aside = float(rng.uniform(-0.3, 0.3))
        (ax, ay), (bx, by) = (point[:2] for point in stretch.line.coords)
        along = math.atan2(by - ay, bx - ax)
        place = moved((ax, ay), along, at)
        across = along + side * math.pi / 2
        if middle:
            facing = math.remainder(along + math.pi, 2 * math.pi)
            return Pose(*moved(place, across, aside), facing), across
        ray = LineString([place, moved(place, across, 30)])
        beside = ray.intersection(stretch.polygon)
        first = min(
            (
                piece.length
                for piece in shapely.get_parts(beside)
                if piece.distance(Point(place)) < 1e-6
            ),
            default=0.0,
        )
        out = first - thing.size[1] / 2 - WALL_GAP
        if out <= 0:
            return None
        facing = math.remainder(across + math.pi, 2 * math.pi)
        return Pose(*moved(place, across, out), facing), across

    def _suits(self, thing: Movable, pose: Pose, across: float) -> bool:
        covers = footprint(thing, pose)
        here = Point(pose.x, pose.y)
        return (
            self._free.contains(covers)
            and all(covers.distance(each) >= TURNING_GAP for each in self._turning)
            and all(covers.distance(each) >= DOOR_GAP for each in self._doors)
            and all(covers.distance(each) >= KEPT_FREE for each in self._kept)
            and all(here.distance(each) >= APART for each in self._standing)
            and self._leaves_room_beside(covers, here, across)
            and self._leaves_a_way(covers, here)
        )

    def _leaves_room_beside(self, covers: Polygon, here: Point, across: float) -> bool:
        """Whether a passage is left on one side of the thing, along its full length."""
        ux, uy = math.cos(across), math.sin(across)
        corners = shapely.get_coordinates(covers) - (here.x, here.y)
        reach = float(np.abs(corners @ (ux, uy)).max()) + 0.01
        half = float(np.abs(corners @ (-uy, ux)).max())
        free = self._free.difference(covers)
        for side in (1.0, -1.0):
            strip = [
                LineString([
                    (
                        here.x + side * out * ux - along * uy,
                        here.y + side * out * uy + along * ux,
                    )
                    for out in (reach, reach + PASSAGE)
                ])
                for along in (-half, 0.0, half)
            ]
            if all(free.covers(line) for line in strip):
                return True
        return False

    def _leaves_a_way(self, covers: Polygon, here: Point) -> bool:
        """Whether the floor around hangs together as it did without the thing."""
        around = self._free.intersection(here.buffer(WINDOW + PASSAGE))
        window = here.buffer(WINDOW)
        far = window.difference(here.buffer(EDGE))

        def parts(free: BaseGeometry) -> int:
            passable = free.buffer(-PASSAGE / 2, join_style="mitre")
            pieces = shapely.get_parts(passable.intersection(window))
            return int(shapely.intersects(pieces, far).sum())

        before = parts(around)
        return before > 0 and parts(around.difference(covers)) == before
