"""The layers of a site's drawing: rooms, floor, things and routes, without words.

Each function draws one layer on axes whose unit is the metre. The sheet around them is
in `drawing.py`.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray
from shapely import LineString, Polygon, get_coordinates, orient_polygons

from memorymaze.sites.records import Route, Site

__all__ = [
    "DOOR_COLORS",
    "FLOOR_COLOR",
    "LANDMARK_COLORS",
    "OTHER_DOOR_COLOR",
    "ROOM_COLOR",
    "TURNING_POINT_COLOR",
    "WALK_COLOR",
    "draw_doors",
    "draw_floor",
    "draw_landmarks",
    "draw_rooms",
    "draw_routes",
    "draw_turning_points",
    "draw_walk",
    "route_color",
    "route_lines",
]

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
ROUTE_COLORS = ("#d7301f", "#1f5fbf", "#2a8a3e", "#8a3ea8", "#c77700")
WALK_COLOR = "#111111"
ALTERNATIVE_DASHES = (
    (0, (5, 1.5)),
    (0, (2.5, 1.2)),
    (0, (7, 1.5, 1.2, 1.5)),
    (0, (1, 1)),
)
SHARED_WAY = 1.0
"""Metres two routes have in common before they are drawn side by side."""
ROUTES_APART = 0.16
"""Metres between routes drawn side by side where they share a way."""


def route_color(route: str) -> str:
    """Return the colour of routes of a name, such as `R1`."""
    digits = "".join(letter for letter in route if letter.isdecimal())
    return ROUTE_COLORS[(int(digits[:4]) - 1 if digits else 0) % len(ROUTE_COLORS)]


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


def route_lines(routes: Sequence[Route]) -> list[Line2D]:
    """Return how each route is drawn: solid references, dashed alternatives.

    Those that share a way run side by side.
    """
    lines: list[Line2D] = []
    for route, line in zip(routes, _side_by_side(routes), strict=True):
        alternative = route.role == "alternative"
        dashed = [each for each in routes if (each.route, each.role) == _rank(route)]
        dash = ALTERNATIVE_DASHES[dashed.index(route) % len(ALTERNATIVE_DASHES)]
        lines.append(
            Line2D(
                *get_coordinates(line).T,
                color=route_color(route.route),
                linewidth=1.6 if alternative else 2.4,
                linestyle=dash if alternative else "-",
                alpha=0.9,
                zorder=7 if alternative else 7.5,
            )
        )
    return lines


def _rank(route: Route) -> tuple[str, str]:
    return route.route, route.role


def _side_by_side(routes: Sequence[Route]) -> list[LineString]:
    """Move the lines of routes aside where they share a way with others."""
    groups: list[list[Route]] = []
    for route in routes:
        touching = [
            group
            for group in groups
            if any(_share_a_way(route, other) for other in group)
        ]
        rest = [group for group in groups if group not in touching]
        groups = [*rest, [*(each for group in touching for each in group), route]]
    moved: dict[str, LineString] = {}
    for group in groups:
        for place, route in enumerate(group):
            aside = (place - (len(group) - 1) / 2) * ROUTES_APART
            line = route.line.offset_curve(aside, join_style="mitre")
            moved[route.id] = (
                line
                if aside and isinstance(line, LineString) and not line.is_empty
                else route.line
            )
    return [moved[route.id] for route in routes]


def _share_a_way(route: Route, other: Route) -> bool:
    return route.line.intersection(other.line.buffer(0.1)).length > SHARED_WAY


def draw_routes(axes: Axes, routes: Sequence[Route]) -> None:
    """Draw routes with an arrow at the start and a star at the goal."""
    for route, line in zip(routes, route_lines(routes), strict=True):
        axes.add_line(line)
        points = get_coordinates(route.line)
        ends = (
            (points[0], (3, 0, math.degrees(route.start_heading) - 90), 11),
            (points[-1], "*", 15),
        )
        for (x, y), marker, size in ends:
            axes.plot(
                x,
                y,
                marker=marker,
                color=route_color(route.route),
                markersize=size,
                markeredgecolor="white",
                zorder=9,
            )


def draw_walk(axes: Axes, points: NDArray[np.float64]) -> None:
    """Draw where something really went.

    Args:
        axes: In metres.
        points: Metres, shape (N, 2).
    """
    axes.plot(*points.T, color=WALK_COLOR, linewidth=1.2, zorder=8)
    axes.plot(*points[0], "o", color=WALK_COLOR, markersize=4, zorder=8)
    axes.plot(*points[-1], "X", color=WALK_COLOR, markersize=7, zorder=9)


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
