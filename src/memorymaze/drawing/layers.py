"""The layers of a site's drawing: rooms, floor, doors and things, without words.

Each function draws one layer on axes whose unit is the metre. The sheet around them is
in `drawing.py`.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from shapely import Polygon, get_coordinates, orient_polygons

from memorymaze.sites.records import Site

FLOOR_COLOR = "#fffaf0"
AREA_COLOR = "#fdf1d8"
OPEN_AIR_COLOR = "#e3f1da"
WALL_COLOR = "#2f2f2f"
ROOM_COLOR = "#ebebeb"
ROOM_COLORS = {
    "exhibit": "#e7e0f1",
    "hall": "#e9e4da",
    "kitchen": "#f7e7d6",
    "library": "#e2ecd8",
    "restroom": "#dcebf3",
    "shop": "#f7e7d6",
    "stairwell": "#dedede",
}
TURNING_POINT_COLOR = "#6aa5de"
DOOR_COLORS = {
    "wood": "#9c5a1e",
    "glass": "#2f9fd8",
    "steel": "#6f7f8a",
    "automatic_glass": "#12b5b0",
    "elevator": "#7a4fb5",
    "fire": "#e03131",
}
OTHER_DOOR_COLOR = "#000000"
LANDMARK_COLORS = {"floor": "#4c8c4a", "wall": "#0b7a75", "ceiling": "#8c8c8c"}


def draw_floor(axes: Axes, site: Site) -> None:
    """Fill the walkable floor and draw walls on its boundary and round its holes."""
    _fill(axes, [site.walkable_floor], FLOOR_COLOR, zorder=2)
    for area in site.areas:
        color = OPEN_AIR_COLOR if area.open_air else AREA_COLOR
        _fill(axes, [area.polygon], color, zorder=2.1)
    axes.add_patch(
        PathPatch(
            _path([site.walkable_floor]),
            facecolor="none",
            edgecolor=WALL_COLOR,
            linewidth=1.5,
            joinstyle="miter",
            zorder=4,
        )
    )


def draw_rooms(axes: Axes, site: Site) -> None:
    """Fill rooms in the colour of their use."""
    for room in site.rooms:
        color = ROOM_COLORS.get(room.use, ROOM_COLOR)
        _fill(axes, [room.polygon], color, edge="#a8a8a8", zorder=1)


def draw_turning_points(axes: Axes, site: Site) -> None:
    """Tint turning points and point an arrow along each exit."""
    if not site.turning_points:
        return
    _fill(
        axes,
        [point.polygon for point in site.turning_points],
        TURNING_POINT_COLOR,
        alpha=0.4,
        zorder=2.5,
    )
    arrows = np.array([
        (middle.x, middle.y, way.heading, 0.42 * math.sqrt(point.polygon.area))
        for point in site.turning_points
        for middle in [point.polygon.centroid]
        for way in point.exits
    ])
    x, y, heading, length = arrows.T
    length = np.clip(length, 0.6, 1.4)
    axes.quiver(
        x + 0.25 * np.cos(heading),
        y + 0.25 * np.sin(heading),
        length * np.cos(heading),
        length * np.sin(heading),
        angles="xy",
        scale_units="xy",
        scale=1,
        units="xy",
        width=0.09,
        headwidth=4,
        headlength=4,
        headaxislength=3.6,
        color="#2f6fb0",
        zorder=5,
    )


def draw_doors(axes: Axes, site: Site) -> None:
    """Draw doors in the colour of their style, open ones as two posts."""
    for door in site.doors:
        ends = get_coordinates(door.line)
        if door.state == "open":
            way = (ends[1] - ends[0]) * 0.22
            pieces = [(ends[0], ends[0] + way), (ends[1] - way, ends[1])]
        else:
            pieces = [(ends[0], ends[1])]
        color = DOOR_COLORS.get(door.style, OTHER_DOOR_COLOR)
        for width, shade in ((4.2, "white"), (2.8, color)):
            axes.add_collection(
                LineCollection(
                    [np.array(piece) for piece in pieces],
                    colors=shade,
                    linewidths=width,
                    capstyle="butt",
                    zorder=6,
                )
            )


def draw_landmarks(axes: Axes, site: Site) -> None:
    """Draw the footprints of landmarks in the colour of where they are mounted."""
    for mount in ("floor", "wall", "ceiling"):
        things = [thing.footprint for thing in site.landmarks if thing.mount == mount]
        flat = mount == "ceiling"
        axes.add_collection(
            PathCollection(
                [_path([thing]) for thing in things],
                facecolors="none" if flat else LANDMARK_COLORS[mount],
                edgecolors=LANDMARK_COLORS[mount],
                linewidths=0.8,
                linestyles="dotted" if flat else "solid",
                alpha=0.85,
                zorder=6.5 if flat else 5.5,
            )
        )


def _fill(
    axes: Axes,
    polygons: Sequence[Polygon],
    color: str,
    *,
    zorder: float,
    edge: str = "none",
    alpha: float = 1.0,
) -> None:
    axes.add_patch(
        PathPatch(
            _path(polygons),
            facecolor=color,
            edgecolor=edge,
            linewidth=0.6,
            alpha=alpha,
            zorder=zorder,
        )
    )


def _path(polygons: Iterable[Polygon]) -> Path:
    """Return polygons with their holes as one path."""
    rings = [
        Path(get_coordinates(ring), closed=True)
        for polygon in orient_polygons(list(polygons))
        for ring in (polygon.exterior, *polygon.interiors)
    ]
    return Path.make_compound_path(*rings)
