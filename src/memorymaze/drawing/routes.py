"""Routes and walks on a site's drawing."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray
from shapely import LineString, get_coordinates

from memorymaze.sites.records import Route

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
