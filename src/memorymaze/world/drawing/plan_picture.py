"""Pictures of sites: sheets as PNG, SVG or PDF, and pixels to draw a robot on."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray
from PIL.Image import Image, fromarray

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.basics.wording import counted, single_spaced
from memorymaze.world.drawing.axes import (
    axes_in,
    lettering,
    paint_met,
    paint_plan,
    paint_routes,
    paint_walk,
    write_labels,
)
from memorymaze.world.drawing.label_placing import LabelSpace
from memorymaze.world.drawing.margin import (
    CORNER,
    FOOT,
    HEAD_GAP,
    HeadLine,
    draw_scale_and_north,
    legend_marks,
    rows_of,
    write_head,
    write_legend,
)
from memorymaze.world.drawing.shapes import (
    ARRIVED_COLOR,
    FAILED_COLOR,
    Bounds,
    Met,
    Points,
    bounds_of,
    on_sheet,
    route_color,
)
from memorymaze.world.sites.records import Route, Site

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
AROUND = 6.0
"""Metres of plan shown round a walk and the way described."""
PIXELS_PER_INCH = 100


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
    _write(path, site, bounds_of(bounds, MARGIN), head, shown, walks, met)


def draw_walk(
    site: Site,
    route: Route,
    walk: Trajectory | ArrayLike,
    *,
    instruction: str,
    outcome: str,
    arrived: bool,
    met: Met | None = None,
) -> Figure:
    """Draw the part of a plan where a walk was, with what was told and came of it.

    Args:
        site: Where.
        route: The way that the instruction describes.
        walk: As a trajectory or points in metres, (N, 2).
        instruction: The text; white space in it becomes single spaces.
        outcome: How the walk ended, in a line.
        arrived: Whether it ended at the goal.
        met: Things left in the way and people who walked about.
    """
    points = _points(walk)
    bounds = [route.line.bounds, (*points.min(axis=0), *points.max(axis=0))]
    shown = bounds_of(bounds, AROUND)
    head = [
        HeadLine(f"{site.title} · {route.id}", 13),
        HeadLine(f"“{single_spaced(instruction)}”", 10.5),
        HeadLine(outcome, 10.5, ARRIVED_COLOR if arrived else FAILED_COLOR),
    ]
    with lettering():
        return _sheet(site, shown, head, [route], [points], met or Met())


def picture_of(sheet: Figure) -> Image:
    """Return a sheet as pixels."""
    sheet.set_dpi(DOTS_PER_INCH)
    canvas = FigureCanvasAgg(sheet)
    with lettering():
        canvas.draw()
    picture = fromarray(np.asarray(canvas.buffer_rgba())[:, :, :3])
    picture.info["dpi"] = (DOTS_PER_INCH, DOTS_PER_INCH)
    return picture


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
    rows = rows_of(head, sheet_wide - CORNER)
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
    axes = axes_in(figure, frame, (west, south), (east, north))
    paint_plan(axes, site)
    paint_routes(axes, routes)
    paint_met(axes, met)
    for walk in walks:
        paint_walk(axes, walk)
    space = LabelSpace(metres_per_point=1 / (72 * scale))
    magnified = float(np.clip(scale / SCALES[0], 1.0, 1.6))
    left_out = write_labels(axes, site, routes, space, magnified)
    write_head(figure, rows)
    draw_scale_and_north(figure, site, scale)
    marks = legend_marks(on_sheet(site, bounds), routes, bool(walks), met)
    write_legend(figure, list(marks), left_out)
    return figure


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
    """Draw the part of a plan round some places, letters and lines magnified."""
    extent = np.array(size, dtype=np.float64)
    low, high = shown.min(axis=0) - AROUND, shown.max(axis=0) + AROUND
    scale = float((extent / (high - low)).min())
    middle, half = (low + high) / 2, extent / (2 * scale)
    dpi = PIXELS_PER_INCH * magnified
    width, height = size
    figure = Figure(figsize=(width / dpi, height / dpi), dpi=dpi, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    low, high = middle - half, middle + half
    axes = axes_in(figure, (0, 0, 1, 1), low, high)
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
