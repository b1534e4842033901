"""Drawings of sites as PNG, SVG or PDF: the sheet, its title, scale and legend."""

import textwrap
import warnings
from collections.abc import Collection, Sequence
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import fontManager
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.typing import RcKeyType
from numpy.typing import ArrayLike, NDArray

from memorymaze.errors import SettingsError
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.sites import drawing_layers as layers
from memorymaze.sites.drawing_labels import draw_labels
from memorymaze.sites.label_placing import LabelSpace
from memorymaze.sites.records import Route, Site

__all__ = ["DRAWING_SUFFIXES", "draw_site"]

DRAWING_SUFFIXES = (".png", ".svg", ".pdf")
MARGIN = 2.0
"""Metres of paper round the plan."""
LONGEST_SIDE = 21.0
"""Inches."""
SCALES = (0.2, 0.36)
"""Inches per metre, at least and at most."""
DOTS_PER_INCH = 130
NARROWEST = 9.0
"""Inches of paper that title and legend need."""
HEAD = 0.9
"""Inches above the plan."""
FOOT = 1.25
"""Inches below the plan."""
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
) -> None:
    """Draw a site: rooms, floor, walls, doors, landmarks, turning points and routes.

    Args:
        site: What to draw.
        path: File to write; its suffix chooses the format: `.png`, `.svg` or `.pdf`.
        trajectories: Walks to draw on top, as trajectories or points in metres, (N, 2).
        routes: Whether to draw all routes or none, or the ids or names (`R1`) of those
            to draw.

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
        _sheet(site, shown, walks).savefig(
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
    site: Site, routes: Sequence[Route], walks: Sequence[NDArray[np.float64]]
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
    layers.draw_routes(axes, routes)
    for walk in walks:
        layers.draw_walk(axes, walk)
    left_out = draw_labels(axes, site, routes, space, magnified)
    _write_head(figure, site, sheet_high)
    _draw_scale_and_north(figure, site, scale, sheet_wide, sheet_high)
    _write_legend(figure, site, routes, bool(walks), left_out)
    return figure


def _write_head(figure: Figure, site: Site, sheet_high: float) -> None:
    west, south, east, north = site.walkable_floor.bounds
    facts = (
        f"{site.floor} · {east - west:.0f} x {north - south:.0f} m · "
        f"{len(site.turning_points)} turning points · {len(site.doors)} doors · "
        f"{len(site.landmarks)} landmarks"
    )
    for text, from_top, size, color in (
        (site.title, 0.36, 15, "black"),
        (facts, 0.66, 9.5, "#555555"),
    ):
        figure.text(
            0.25 / figure.get_figwidth(),
            1 - from_top / sheet_high,
            text,
            fontsize=size,
            color=color,
            parse_math=False,
        )


def _draw_scale_and_north(
    figure: Figure, site: Site, scale: float, sheet_wide: float, sheet_high: float
) -> None:
    corner = figure.add_axes((
        1 - 3.0 / sheet_wide,
        1 - 0.85 / sheet_high,
        3.0 / sheet_wide,
        0.85 / sheet_high,
    ))
    corner.set_xlim(0, 3.0)
    corner.set_ylim(0, 0.85)
    corner.set_axis_off()
    metres = 10 if scale < 0.35 else 5
    start, end = 2.2 - metres * scale, 2.2
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
    middle = np.array([2.72, 0.36])
    corner.annotate(
        "",
        xy=tuple(middle + 0.22 * north),
        xytext=tuple(middle - 0.22 * north),
        arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1.4},
    )
    corner.text(
        float(middle[0] + 0.32 * north[0]),
        float(middle[1] + 0.32 * north[1]),
        "N",
        fontsize=9,
        ha="center",
        va="center",
    )


def _write_legend(
    figure: Figure, site: Site, routes: Sequence[Route], walked: bool, left_out: int
) -> None:
    marks: list[Line2D | Patch] = [
        Patch(facecolor=layers.FLOOR_COLOR, edgecolor=layers.WALL_COLOR, label="floor"),
    ]
    if site.rooms:
        marks.append(
            Patch(facecolor=layers.ROOM_COLOR, edgecolor="#a8a8a8", label="room")
        )
    if any(area.open_air for area in site.areas):
        marks.append(Patch(facecolor=layers.OPEN_AIR_COLOR, label="open air"))
    if site.turning_points:
        marks.append(
            Patch(
                facecolor=layers.TURNING_POINT_COLOR,
                alpha=0.4,
                label="turning point with its exits",
            )
        )
    for style in dict.fromkeys(door.style for door in site.doors):
        color = layers.DOOR_COLORS.get(style, layers.OTHER_DOOR_COLOR)
        name = f"{style.replace('_', ' ')} door"
        marks.append(Line2D([], [], color=color, linewidth=3, label=name))
    if any(door.state == "open" for door in site.doors):
        marks.append(
            Line2D(
                [], [], color="#555555", linewidth=3, dashes=(1, 2), label="open door"
            )
        )
    for mount in dict.fromkeys(thing.mount for thing in site.landmarks):
        where = {"floor": "on the floor", "wall": "on a wall", "ceiling": "overhead"}
        color = layers.LANDMARK_COLORS[mount]
        marks.append(
            Patch(
                facecolor="none" if mount == "ceiling" else color,
                edgecolor=color,
                linestyle="dotted" if mount == "ceiling" else "solid",
                label=f"thing {where[mount]}",
            )
        )
    for route, line in zip(routes, layers.route_lines(routes), strict=True):
        role = " (alternative)" if route.role == "alternative" else ""
        line.set_data([], [])
        line.set_label(
            f"{route.route}{role}: {route.line.length:.2f} m to {route.goal}"
        )
        marks.append(line)
    if walked:
        marks.append(Line2D([], [], color=layers.WALK_COLOR, label="walked"))
    columns = max(2, int(figure.get_figwidth() / 2.9))
    for mark in marks:
        mark.set_label("\n".join(textwrap.wrap(str(mark.get_label()), 36)))
    figure.legend(
        handles=marks,
        loc="lower center",
        ncol=columns,
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
