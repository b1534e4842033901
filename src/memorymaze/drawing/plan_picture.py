"""Pictures of sites: sheets as PNG, SVG or PDF, and pixels to draw a robot on."""

import textwrap
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from numpy.typing import ArrayLike, NDArray

from memorymaze.drawing.axes import (
    TURNING_POINT_ALPHA,
    lettering,
    paint_met,
    paint_plan,
    paint_routes,
    paint_walk,
    route_lines,
    write_labels,
)
from memorymaze.drawing.label_placing import LabelSpace
from memorymaze.drawing.shapes import (
    INKS,
    PEOPLE_COLOR,
    THING_COLOR,
    VARIETIES,
    WALK_COLOR,
    Met,
    Points,
    Shape,
    part_of,
    route_color,
)
from memorymaze.errors import SettingsError
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.sites.records import Route, Site
from memorymaze.wording import counted, single_spaced

DRAWING_SUFFIXES = (".png", ".svg", ".pdf")
MARGIN = 2.0
"""Metres of paper round the plan."""
LONGEST_SIDE = 21.0
"""Inches."""
SCALES = (0.2, 0.36)
"""Inches per metre, at least and at most."""
LARGEST_SHEET = 60.0
"""Inches; a building for which the least scale would need more is drawn smaller."""
DOTS_PER_INCH = 130
NARROWEST = 9.0
"""Inches of paper that title and legend need."""
HEAD_GAP, FOOT = 0.38, 1.25
"""Inches round what is written above the plan, and for the legend below."""
WIDE_FROM = 0x2E80
"""Characters from here on are as wide as high."""
ARRIVED_COLOR, FAILED_COLOR = "#0b5d2a", "#8a1c1c"
BAR_LENGTHS = (1, 2, 5, 10, 20, 50, 100, 200, 500)
"""Metres that a scale bar may stand for."""
LONGEST_BAR = 3.0
"""Inches."""
CORNER = 4.0
"""Inches across the corner that holds scale bar and north arrow."""
AROUND = 6.0
"""Metres of plan shown round a walk and the way described."""
PIXELS_PER_INCH = 100

Bounds = tuple[float, float, float, float]
"""West, south, east, north; metres."""


@dataclass(frozen=True, slots=True)
class HeadLine:
    """Something to be written above a plan."""

    text: str
    size: float
    """Points."""
    color: str = "black"

    @property
    def height(self) -> float:
        """Return what a row of it takes, inches."""
        return 1.5 * self.size / 72


def draw_site(
    site: Site,
    path: str | Path,
    *,
    trajectories: Sequence[Trajectory | ArrayLike] = (),
    routes: bool | Collection[str] = True,
    met: Met | None = None,
) -> None:
    """Draw a site: rooms, floor, walls, doors, landmarks, turning points and routes.

    Args:
        site: What to draw.
        path: File to write; its suffix chooses the format: `.png`, `.svg` or `.pdf`.
        trajectories: Walks to draw on top, as trajectories or points in metres, (N, 2).
        routes: Whether to draw all routes or none, or the ids or names (`R1`) of those
            to draw.
        met: Things left in the way and people who walked about.

    Raises:
        SettingsError: The suffix is not one of these, or a route is not in the site.
        OSError: The file cannot be written.
    """
    path = _checked(path)
    shown = _chosen_routes(site, routes)
    walks = [_points(trajectory) for trajectory in trajectories]
    bounds = [site.walkable_floor.bounds]
    bounds += [room.polygon.bounds for room in site.rooms]
    bounds += [thing.footprint.bounds for thing in site.landmarks]
    bounds += [(*walk.min(axis=0), *walk.max(axis=0)) for walk in walks]
    west, south, east, north = site.walkable_floor.bounds
    facts = (
        f"{site.floor} · {east - west:.0f} x {north - south:.0f} m · "
        f"{counted(len(site.turning_points), 'turning point')} · "
        f"{counted(len(site.doors), 'door')} · "
        f"{counted(len(site.landmarks), 'landmark')}"
    )
    head = [HeadLine(site.title, 15), HeadLine(facts, 9.5, "#555555")]
    _write(path, site, _around(bounds, MARGIN), head, shown, walks, met)


def draw_walk(
    site: Site,
    route: Route,
    walk: Trajectory | ArrayLike,
    path: str | Path,
    *,
    instruction: str,
    outcome: str,
    arrived: bool,
    met: Met | None = None,
) -> None:
    """Draw the part of a plan where a walk was, with what was told and came of it.

    Args:
        site: Where.
        route: The way that the instruction describes.
        walk: As a trajectory or points in metres, (N, 2).
        path: File to write; its suffix chooses the format: `.png`, `.svg` or `.pdf`.
        instruction: The text; white space in it becomes single spaces.
        outcome: How the walk ended, in a line.
        arrived: Whether it ended at the goal.
        met: Things left in the way and people who walked about.

    Raises:
        SettingsError: The suffix is not one of these.
        OSError: The file cannot be written.
    """
    path = _checked(path)
    points = _points(walk)
    bounds = [route.line.bounds, (*points.min(axis=0), *points.max(axis=0))]
    shown = _around(bounds, AROUND)
    head = [
        HeadLine(f"{site.title} · {route.id}", 13),
        HeadLine(f"“{single_spaced(instruction)}”", 10.5),
        HeadLine(outcome, 10.5, ARRIVED_COLOR if arrived else FAILED_COLOR),
    ]
    _write(path, part_of(site, shown), shown, head, [route], [points], met)


def _checked(path: str | Path) -> Path:
    path = Path(path)
    if path.suffix.lower() not in DRAWING_SUFFIXES:
        raise SettingsError(
            f"{path}: expected a file name ending in {', '.join(DRAWING_SUFFIXES)}, got "
            f"{path.suffix or 'no suffix'!r}"
        )
    return path


def _chosen_routes(site: Site, routes: bool | Collection[str]) -> list[Route]:
    if isinstance(routes, bool):
        return list(site.routes) if routes else []
    for wanted in routes:
        if not any(wanted in {route.id, route.route} for route in site.routes):
            known = [route.id for route in site.routes]
            raise SettingsError(
                f"expected routes of {site.name}: {', '.join(known) or 'it has none'}; "
                f"got {wanted!r}"
            )
    return [
        route for route in site.routes if route.id in routes or route.route in routes
    ]


def _points(walk: Trajectory | ArrayLike) -> Points:
    points = walk.points if isinstance(walk, Trajectory) else walk
    array = np.asarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 2 or not len(array):
        raise ValueError(f"expected points of shape (N, 2), got {array.shape}")
    return array


def _around(bounds: Sequence[Sequence[float]], margin: float) -> Bounds:
    """Return what holds some bounds, with a margin."""
    table = np.array(bounds, dtype=np.float64)
    west, south = (table[:, :2].min(axis=0) - margin).tolist()
    east, north = (table[:, 2:].max(axis=0) + margin).tolist()
    return west, south, east, north


def _write(
    path: Path,
    site: Site,
    bounds: Bounds,
    head: Sequence[HeadLine],
    routes: Sequence[Route],
    walks: Sequence[Points],
    met: Met | None,
) -> None:
    undated = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    # Text in SVG stays text, and the same site gives the same file.
    with lettering(**{"svg.fonttype": "none", "svg.hashsalt": site.name}):
        _sheet(site, bounds, head, routes, walks, met or Met()).savefig(
            path, dpi=DOTS_PER_INCH, metadata=undated.get(path.suffix.lower())
        )


def _sheet(
    site: Site,
    bounds: Bounds,
    head: Sequence[HeadLine],
    routes: Sequence[Route],
    walks: Sequence[Points],
    met: Met,
) -> Figure:
    west, south, east, north = bounds
    wide, high = east - west, north - south
    scale = float(np.clip(LONGEST_SIDE / max(wide, high), *SCALES))
    scale = min(scale, LARGEST_SHEET / max(wide, high))
    sheet_wide = max(wide * scale, NARROWEST)
    rows = _rows(head, sheet_wide - CORNER)
    top = sum(row.height for row in rows) + HEAD_GAP
    sheet_high = high * scale + top + FOOT
    figure = Figure(figsize=(sheet_wide, sheet_high), facecolor="white")
    FigureCanvasAgg(figure)
    frame = (
        (1 - wide * scale / sheet_wide) / 2,
        FOOT / sheet_high,
        wide * scale / sheet_wide,
        high * scale / sheet_high,
    )
    axes = _axes_in(figure, frame, (west, south), (east, north))
    paint_plan(axes, site)
    paint_routes(axes, routes)
    paint_met(axes, met)
    for walk in walks:
        paint_walk(axes, walk)
    space = LabelSpace(metres_per_point=1 / (72 * scale))
    magnified = float(np.clip(scale / SCALES[0], 1.0, 1.6))
    left_out = write_labels(axes, site, routes, space, magnified)
    _write_head(figure, rows)
    draw_scale_and_north(figure, site, scale)
    _write_legend(figure, list(_marks(site, routes, bool(walks), met)), left_out)
    return figure


def _axes_in(
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


def _rows(head: Sequence[HeadLine], wide: float) -> list[HeadLine]:
    """Break what stands above a plan into rows that fit a width, inches."""
    rows: list[HeadLine] = []
    for line in head:
        # Letters of other scripts are as wide as high.
        letter = 1.0 if any(ord(each) >= WIDE_FROM for each in line.text) else 0.56
        most = max(20, int(wide * 72 / (letter * line.size)))
        rows += [replace(line, text=text) for text in textwrap.wrap(line.text, most)]
    return rows


def _write_head(figure: Figure, rows: Sequence[HeadLine]) -> None:
    """Write above the plan, from the top."""
    down = HEAD_GAP / 3
    for row in rows:
        down += row.height
        figure.text(
            0.25 / figure.get_figwidth(),
            1 - down / figure.get_figheight(),
            row.text,
            fontsize=row.size,
            color=row.color,
            parse_math=False,
        )


def draw_scale_and_north(figure: Figure, site: Site, scale: float) -> None:
    """Draw a scale bar and a north arrow in the upper right corner.

    Args:
        figure: The sheet.
        site: What is drawn on it.
        scale: Inches per metre.
    """
    wide, high = CORNER / figure.get_figwidth(), 0.85 / figure.get_figheight()
    corner = _axes_in(figure, (1 - wide, 1 - high, wide, high), (0, 0), (CORNER, 0.85))
    metres = max(each for each in BAR_LENGTHS if each * scale <= LONGEST_BAR)
    end = CORNER - 0.8
    start = end - metres * scale
    for part in range(5):
        corner.add_patch(
            Rectangle(
                (start + part * (end - start) / 5, 0.3),
                (end - start) / 5,
                0.07,
                facecolor="black" if part % 2 == 0 else "white",
                edgecolor="black",
                linewidth=0.7,
            )
        )
    corner.text(start, 0.44, "0", fontsize=8, ha="center")
    corner.text(end, 0.44, f"{metres} m", fontsize=8, ha="center")
    bearing = site.anchor.bearing if site.anchor else 0.0
    north = np.array([-np.sin(bearing), np.cos(bearing)])
    middle = np.array([CORNER - 0.28, 0.36])
    corner.annotate(
        "",
        xy=tuple(middle + 0.22 * north),
        xytext=tuple(middle - 0.22 * north),
        arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1.4},
    )
    x, y = (middle + 0.32 * north).tolist()
    corner.text(x, y, "N", fontsize=9, ha="center", va="center")


def _marks(
    site: Site, routes: Sequence[Route], walked: bool, met: Met
) -> Iterator[Line2D | Patch]:
    """Return what the colours and lines on a sheet mean."""
    floor, wall = INKS["floor"].paper, INKS["wall"].paper
    yield Patch(facecolor=floor, edgecolor=wall, label="floor")
    if site.rooms:
        edge = INKS["room_edge"].paper
        yield Patch(facecolor=INKS["room"].paper, edgecolor=edge, label="room")
    if any(area.open_air for area in site.areas):
        yield Patch(facecolor=INKS["open_air"].paper, label="open air")
    if site.turning_points:
        yield Patch(
            facecolor=INKS["turning_point"].paper,
            alpha=TURNING_POINT_ALPHA,
            label="turning point with its exits",
        )
    for style in dict.fromkeys(door.style for door in site.doors):
        name = f"{style.replace('_', ' ')} door"
        color = Shape("door", style).paper
        yield Line2D([], [], color=color, linewidth=3, label=name)
    if any(door.state == "open" for door in site.doors):
        yield Line2D(
            [], [], color="#555555", linewidth=3, dashes=(1, 2), label="open door"
        )
    for mount in dict.fromkeys(thing.mount for thing in site.landmarks):
        where = {"floor": "on the floor", "wall": "on a wall", "ceiling": "overhead"}
        color = VARIETIES["thing"][mount]
        overhead = mount == "ceiling"
        yield Patch(
            facecolor="none" if overhead else color,
            edgecolor=color,
            linestyle="dotted" if overhead else "solid",
            label=f"thing {where[mount]}",
        )
    for route, line in zip(routes, route_lines(routes), strict=True):
        role = " (alternative)" if route.role == "alternative" else ""
        line.set_data([], [])
        line.set_label(
            f"{route.route}{role}: {route.line.length:.2f} m to {route.goal}"
        )
        yield line
    if walked:
        yield Line2D([], [], color=WALK_COLOR, label="walked")
    if met.things:
        yield Patch(facecolor=THING_COLOR, label="left in the way")
    if met.walks:
        yield Line2D(
            [],
            [],
            color=PEOPLE_COLOR,
            marker="o",
            markersize=4,
            label="person, from the dot on",
        )
    if met.near_misses:
        yield Line2D(
            [],
            [],
            color=THING_COLOR,
            linestyle="",
            marker="o",
            fillstyle="none",
            label="near miss",
        )


def _write_legend(
    figure: Figure, marks: Sequence[Line2D | Patch], left_out: int
) -> None:
    """Explain below the plan what is on it, and how many labels found no room."""
    for mark in marks:
        mark.set_label("\n".join(textwrap.wrap(str(mark.get_label()), 36)))
    figure.legend(
        handles=marks,
        loc="lower center",
        ncol=max(2, int(figure.get_figwidth() / 2.9)),
        fontsize=8,
        frameon=False,
        bbox_to_anchor=(0.5, 0.12 / figure.get_figheight()),
    )
    if left_out:
        figure.text(
            1 - 0.25 / figure.get_figwidth(),
            0.08 / figure.get_figheight(),
            f"{left_out} labels left out for want of room",
            fontsize=7,
            color="#777777",
            horizontalalignment="right",
        )


@dataclass(frozen=True, slots=True, eq=False)
class PlanSheet:
    """A part of a plan as pixels, and where on it a place lies."""

    picture: NDArray[np.uint8]
    """Colours, (height, width, 3), first row at the top."""
    scale: float
    """Pixels per metre."""
    west: float
    """x of the left edge, metres."""
    north: float
    """y of the upper edge, metres."""

    def pixel(self, x: float, y: float) -> tuple[float, float]:
        """Return column and row of a place, metres."""
        return (x - self.west) * self.scale, (self.north - y) * self.scale


def draw_plan(
    site: Site,
    routes: Sequence[Route],
    shown: Points,
    size: tuple[int, int],
    *,
    magnified: float = 1.0,
) -> PlanSheet:
    """Draw the part of a plan round some places as pixels.

    Args:
        site: What to draw.
        routes: Those to draw.
        shown: Places that must be on it, at least one.
        size: Width and height, pixels.
        magnified: Factor on the sizes of letters and lines.
    """
    extent = np.array(size, dtype=np.float64)
    low, high = shown.min(axis=0) - AROUND, shown.max(axis=0) + AROUND
    scale = float((extent / (high - low)).min())
    middle, half = (low + high) / 2, extent / (2 * scale)
    dpi = PIXELS_PER_INCH * magnified
    width, height = size
    figure = Figure(figsize=(width / dpi, height / dpi), dpi=dpi, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    low, high = middle - half, middle + half
    site = part_of(site, _around([[*low, *high]], 0.0))
    axes = _axes_in(figure, (0, 0, 1, 1), low, high)
    with lettering():
        paint_plan(axes, site, turning_points=False)
        for route in routes:
            # Wider than the walk that will cover its line.
            ends = np.array(route.line.coords)[:, :2].T
            color = route_color(route.route)
            axes.plot(*ends, color=color, linewidth=6.5, alpha=0.45, zorder=7)
        paint_routes(axes, routes)
        write_labels(axes, site, routes, LabelSpace(dpi / (72 * scale)))
        canvas.draw()
    picture = np.asarray(canvas.buffer_rgba())[:height, :width, :3].copy()
    return PlanSheet(picture, scale, float(low[0]), float(high[1]))
