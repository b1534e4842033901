"""Drawings of sites as PNG, SVG or PDF: the sheet and what goes on it."""

import warnings
from collections.abc import Collection, Sequence
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import fontManager
from matplotlib.typing import RcKeyType
from numpy.typing import ArrayLike, NDArray

from memorymaze.drawing import layers
from memorymaze.drawing.label_placing import LabelSpace
from memorymaze.drawing.labels import draw_labels
from memorymaze.drawing.margin import (
    FOOT,
    HEAD,
    draw_scale_and_north,
    write_head,
    write_legend,
)
from memorymaze.drawing.obstacles import Met, draw_met
from memorymaze.drawing.routes import draw_routes, draw_walk
from memorymaze.errors import SettingsError
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.sites.records import Route, Site

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
    path = Path(path)
    if path.suffix.lower() not in DRAWING_SUFFIXES:
        raise SettingsError(
            f"{path}: expected a file name ending in {', '.join(DRAWING_SUFFIXES)}, got "
            f"{path.suffix or 'no suffix'!r}"
        )
    shown = _chosen_routes(site, routes)
    walks = [_points(trajectory) for trajectory in trajectories]
    # Text in SVG stays text, and the same site gives the same file.
    style: dict[RcKeyType, object] = {
        "font.family": ["DejaVu Sans", *_other_scripts()],
        "svg.fonttype": "none",
        "svg.hashsalt": site.name,
    }
    undated = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    with rc_context(style), warnings.catch_warnings():
        # Characters that no installed font has are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        _sheet(site, shown, walks, met or Met()).savefig(
            path, dpi=DOTS_PER_INCH, metadata=undated.get(path.suffix.lower())
        )


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


def _points(walk: Trajectory | ArrayLike) -> NDArray[np.float64]:
    points = walk.points if isinstance(walk, Trajectory) else walk
    array = np.asarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 2 or not len(array):
        raise ValueError(f"expected points of shape (N, 2), got {array.shape}")
    return array


def _other_scripts() -> list[str]:
    installed = {font.name for font in fontManager.ttflist}
    return [name for name in OTHER_SCRIPTS if name in installed]


def _sheet(
    site: Site,
    routes: Sequence[Route],
    walks: Sequence[NDArray[np.float64]],
    met: Met,
) -> Figure:
    everything = [site.walkable_floor.bounds]
    everything += [room.polygon.bounds for room in site.rooms]
    everything += [thing.footprint.bounds for thing in site.landmarks]
    everything += [(*walk.min(axis=0), *walk.max(axis=0)) for walk in walks]
    table = np.array(everything)
    west, south = table[:, :2].min(axis=0) - MARGIN
    east, north = table[:, 2:].max(axis=0) + MARGIN
    wide, high = east - west, north - south
    scale = float(np.clip(LONGEST_SIDE / max(wide, high), *SCALES))
    scale = min(scale, LARGEST_SHEET / max(wide, high))
    sheet_wide = max(wide * scale, NARROWEST)
    sheet_high = high * scale + HEAD + FOOT
    figure = Figure(figsize=(sheet_wide, sheet_high), facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.add_axes((
        (1 - wide * scale / sheet_wide) / 2,
        FOOT / sheet_high,
        wide * scale / sheet_wide,
        high * scale / sheet_high,
    ))
    axes.set_xlim(west, east)
    axes.set_ylim(south, north)
    axes.set_axis_off()
    space = LabelSpace(metres_per_point=1 / (72 * scale))
    magnified = float(np.clip(scale / SCALES[0], 1.0, 1.6))
    layers.draw_floor(axes, site)
    layers.draw_turning_points(axes, site)
    layers.draw_rooms(axes, site)
    layers.draw_doors(axes, site)
    layers.draw_landmarks(axes, site)
    draw_routes(axes, routes)
    draw_met(axes, met)
    for walk in walks:
        draw_walk(axes, walk)
    left_out = draw_labels(axes, site, routes, space, magnified)
    write_head(figure, site, sheet_high)
    draw_scale_and_north(figure, site, scale, sheet_wide, sheet_high)
    write_legend(figure, site, routes, bool(walks), left_out, met)
    return figure
