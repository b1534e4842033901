"""Small things that stand on a floor: holes of its outline made into boxes."""

import math
from collections.abc import Iterator, Sequence

import shapely
from shapely import MultiPoint, Point, Polygon

from memorymaze.basics.geometry.points import XY
from memorymaze.world.sites.records import Landmark

OBSTACLE_ACROSS = 1.5
"""Metres; what stands free and is no longer is an obstacle, else wall."""
OBSTACLE_HEIGHT = 1.0
"""Metres of what is known only by its outline."""


def without_obstacles(outline: Polygon) -> tuple[Polygon, list[Polygon]]:
    """Return a floor without its small holes, and these."""
    holes = [Polygon(hole) for hole in outline.interiors]
    small = [hole for hole in holes if box_around(hole)[1] <= OBSTACLE_ACROSS]
    walls = [hole.exterior for hole in holes if hole not in small]
    return Polygon(outline.exterior, walls), small


def boxes_on(floor: Polygon, small: Sequence[Polygon]) -> Iterator[Landmark]:
    """Yield a box for each obstacle on a floor."""
    on_floor = [each for each in small if floor.covers(each.centroid)]
    for number, each in enumerate(on_floor, 1):
        middle, length, depth, heading = box_around(each)
        yield Landmark(
            f"box_{number}",
            Point(middle),
            category="box",
            color=None,
            name=None,
            text=None,
            heading=heading + math.pi / 2,
            size=(round(length, 2), round(depth, 2), OBSTACLE_HEIGHT),
            mount="floor",
            obstacle=True,
        )


def box_around(shape: Polygon | MultiPoint) -> tuple[XY, float, float, float]:
    """Return middle, longer side, shorter side, at least 1 cm, and the longer's heading."""
    box = shape.minimum_rotated_rectangle
    corners = shapely.get_coordinates(
        box if isinstance(box, Polygon) else box.buffer(0.005)
    )
    first, second = corners[1] - corners[0], corners[2] - corners[1]
    along, across = sorted((first, second), key=lambda side: -math.hypot(*side))
    heading = math.atan2(along[1], along[0])
    return (
        (box.centroid.x, box.centroid.y),
        max(math.hypot(*along), 0.01),
        max(math.hypot(*across), 0.01),
        heading,
    )
