"""A plan, its routes, walks and words on matplotlib's axes, whose unit is the metre."""

import math
import warnings
from collections.abc import Generator, Iterable, Sequence
from contextlib import contextmanager

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.figure import Figure
from matplotlib.font_manager import fontManager
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.patches import Polygon as PolygonPatch
from matplotlib.path import Path
from matplotlib.typing import RcKeyType
from numpy.typing import ArrayLike
from shapely import Polygon, get_coordinates, orient_polygons

from memorymaze.world.drawing.label_placing import LabelSpace
from memorymaze.world.drawing.labels import PlanLabel, place_labels
from memorymaze.world.drawing.shapes import (
    EXIT_COLOR,
    INKS,
    PEOPLE_COLOR,
    THING_COLOR,
    WALK_COLOR,
    Met,
    PlanShape,
    Points,
    ThingInTheWay,
    plan_shapes,
    route_color,
    side_by_side,
)
from memorymaze.world.sites.records import Route, Site

TURNING_POINT_ALPHA = 0.4
ROUTES_FROM = 7.0
"""Where routes and walks begin in the order of painting; plans lie below."""
NAME_SIZES = (7.0, 6.0, 5.0, 4.2)
"""Points."""
THING_SIZE = 4.4
"""Points."""
ALTERNATIVE_DASHES = (
    (0, (5, 1.5)),
    (0, (2.5, 1.2)),
    (0, (7, 1.5, 1.2, 1.5)),
    (0, (1, 1)),
)
LEAST_SIDE = 0.45
"""Metres that things in the way are drawn large at least, so that one finds them."""
ARROW_EVERY = 6.0
"""Metres of a person's walk from one arrow to the next."""
OTHER_SCRIPTS = (
    "Noto Sans CJK JP",
    "Noto Sans JP",
    "IPAexGothic",
    "IPAGothic",
    "TakaoPGothic",
    "WenQuanYi Zen Hei",
    "Hiragino Sans",
    "Yu Gothic",
    "Noto Sans",
)
"""Fonts looked for when Latin ones lack a character."""
WIDE_FROM = 0x2E80
"""Characters from here on are as wide as high, and in none but such fonts."""


@contextmanager
def lettering(**style: object) -> Generator[None]:
    """Draw with fonts that this machine has; characters of none become boxes."""
    installed = {font.name for font in fontManager.ttflist}
    others = [name for name in OTHER_SCRIPTS if name in installed]
    settings: dict[RcKeyType, object] = {"font.family": ["DejaVu Sans", *others]}
    settings.update(style)  # type: ignore[arg-type]
    with rc_context(settings), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        yield


def axes_in(
    figure: Figure,
    frame: tuple[float, float, float, float],
    low: ArrayLike,
    high: ArrayLike,
) -> Axes:
    """Return axes without ticks, from one corner of a plan to the opposite one."""
    axes = figure.add_axes(frame)
    (west, south), (east, north) = np.asarray([low, high], dtype=np.float64).tolist()
    axes.set_xlim(west, east)
    axes.set_ylim(south, north)
    axes.set_axis_off()
    return axes


def paint_plan(axes: Axes, site: Site, *, turning_points: bool = True) -> None:
    """Paint all shapes of a plan."""
    shapes = list(plan_shapes(site))
    for order, shape in enumerate(shapes):
        zorder = ROUTES_FROM * order / len(shapes)
        if shape.kind == "turning_point":
            if turning_points and site.turning_points:
                _fill(axes, shape, zorder, alpha=TURNING_POINT_ALPHA)
                _exits(axes, site, zorder)
        elif shape.kind == "door":
            for width, color in ((4.2, "white"), (INKS["door"].width, shape.paper)):
                axes.add_collection(
                    LineCollection(
                        list(shape.lines),
                        colors=color,
                        linewidths=width,
                        capstyle="butt",
                        zorder=zorder,
                    )
                )
        elif shape.kind in {"covering", "thing", "overhead"}:
            overhead = shape.kind == "overhead"
            axes.add_collection(
                PathCollection(
                    [_path([each]) for each in shape.polygons],
                    facecolors="none" if overhead else shape.paper,
                    edgecolors=shape.paper,
                    linewidths=INKS["thing"].width,
                    linestyles="dotted" if overhead else "solid",
                    alpha=0.85,
                    zorder=zorder,
                )
            )
        elif shape.kind == "wall":
            axes.add_patch(
                PathPatch(
                    _path(shape.polygons),
                    facecolor="none",
                    edgecolor=shape.paper,
                    linewidth=INKS["wall"].width,
                    joinstyle="miter",
                    zorder=zorder,
                )
            )
        else:
            edge = INKS["room_edge"].paper if shape.kind == "room" else "none"
            _fill(axes, shape, zorder, edge=edge)


def _fill(
    axes: Axes,
    shape: PlanShape,
    zorder: float,
    *,
    edge: str = "none",
    alpha: float = 1.0,
) -> None:
    axes.add_patch(
        PathPatch(
            _path(shape.polygons),
            facecolor=shape.paper,
            edgecolor=edge,
            linewidth=INKS["room"].width,
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


def _exits(axes: Axes, site: Site, zorder: float) -> None:
    """Point an arrow along each exit of turning points."""
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
        color=EXIT_COLOR,
        zorder=zorder,
    )


def route_lines(routes: Sequence[Route]) -> list[Line2D]:
    """Return how each route is drawn: solid references, dashed alternatives."""
    lines: list[Line2D] = []
    ranks = [(route.route, route.role) for route in routes]
    for number, (route, line) in enumerate(
        zip(routes, side_by_side(routes), strict=True)
    ):
        alternative = route.role == "alternative"
        before = ranks[:number].count(ranks[number])
        dash = ALTERNATIVE_DASHES[before % len(ALTERNATIVE_DASHES)]
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


def paint_routes(axes: Axes, routes: Sequence[Route]) -> None:
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


def paint_walk(axes: Axes, points: Points) -> None:
    """Draw where something really went."""
    axes.plot(*points.T, color=WALK_COLOR, linewidth=1.2, zorder=8)
    axes.plot(*points[0], "o", color=WALK_COLOR, markersize=4, zorder=8)
    axes.plot(*points[-1], "X", color=WALK_COLOR, markersize=7, zorder=9)


def paint_met(axes: Axes, met: Met) -> None:
    """Draw things where they stand, with their names, and people's walks as arrows."""
    for walk in met.walks:
        axes.plot(*walk.T, color=PEOPLE_COLOR, linewidth=0.7, alpha=0.5, zorder=7.7)
        axes.plot(*walk[0], "o", color=PEOPLE_COLOR, markersize=4, zorder=7.8)
        for (x, y), (to_x, to_y) in _arrows(walk):
            axes.annotate(
                "",
                xy=(to_x, to_y),
                xytext=(x, y),
                arrowprops={
                    "arrowstyle": "-|>",
                    "color": PEOPLE_COLOR,
                    "linewidth": 0.0,
                    "mutation_scale": 9,
                },
                zorder=7.8,
            )
    for thing in met.things:
        axes.add_patch(
            PolygonPatch(
                _corners(thing),
                facecolor=THING_COLOR,
                edgecolor="white",
                linewidth=0.6,
                zorder=8.5,
            )
        )
        axes.annotate(
            thing.category,
            (thing.x, thing.y),
            xytext=(4, 4),
            textcoords="offset points",
            fontsize=6.5,
            color=THING_COLOR,
            zorder=9.5,
            parse_math=False,
            bbox={"facecolor": "white", "alpha": 0.7, "linewidth": 0, "pad": 0.6},
        )
    for x, y in met.near_misses:
        axes.plot(
            x, y, "o", markersize=9, fillstyle="none", color=THING_COLOR, zorder=9
        )


def _arrows(walk: Points) -> list[tuple[Points, Points]]:
    steps = np.linalg.norm(np.diff(walk, axis=0), axis=1)
    come = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.arange(ARROW_EVERY / 2, come[-1], ARROW_EVERY)
    places = np.searchsorted(come, wanted)
    return [(walk[at - 1], walk[at]) for at in places.tolist() if steps[at - 1] > 0.1]


def _corners(thing: ThingInTheWay) -> Points:
    half_x = max(thing.depth, LEAST_SIDE) / 2
    half_y = max(thing.length, LEAST_SIDE) / 2
    cosine, sine = math.cos(thing.heading), math.sin(thing.heading)
    box = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (half_x, half_y)
    turned = box @ np.array([(cosine, sine), (-sine, cosine)])
    return turned + np.array([thing.x, thing.y])


def write_labels(
    axes: Axes,
    site: Site,
    routes: Sequence[Route],
    space: LabelSpace,
    magnified: float = 1.0,
) -> int:
    """Write the words of a plan; return how many found no room."""
    names = [size * magnified for size in NAME_SIZES]
    west, south, east, north = map(float, axes.viewLim.extents)
    sheet = (west, south, east, north)
    labels = place_labels(site, routes, space, names, THING_SIZE * magnified, sheet)
    for label in labels:
        _write(axes, label)
    return sum(label.placed is None for label in labels)


def _write(axes: Axes, label: PlanLabel) -> None:
    placed = label.placed
    if placed is None:
        return
    axes.text(
        placed.x,
        placed.y,
        placed.text,
        fontsize=placed.font_size,
        color=INKS[label.kind].paper,
        style="italic" if label.kind == "way" else "normal",
        rotation=math.degrees(placed.angle),
        rotation_mode="anchor",
        horizontalalignment="center",
        verticalalignment="center",
        linespacing=1.1,
        parse_math=False,
        clip_on=True,
        zorder=10,
    )
