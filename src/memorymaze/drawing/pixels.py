"""The part of a plan where an episode took place, as pixels to draw a robot on."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from memorymaze.drawing import layers
from memorymaze.drawing.label_placing import LabelSpace
from memorymaze.drawing.labels import draw_labels
from memorymaze.drawing.routes import draw_routes, route_color
from memorymaze.sites import Route, Site

AROUND = 6.0
"""Metres of plan shown round the walk and the way described."""
DOTS_PER_INCH = 100


@dataclass(frozen=True, slots=True, eq=False)
class PlanSheet:
    """A picture of a plan, and where on it a place lies."""

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
    shown: NDArray[np.float64],
    size: tuple[int, int],
    *,
    magnified: float = 1.0,
) -> PlanSheet:
    """Draw the part of a plan round some places.

    Args:
        site: What to draw.
        routes: Those to draw.
        shown: Places that must be on it, metres, (N, 2) with N >= 1.
        size: Width and height, pixels.
        magnified: Factor on the sizes of letters and lines.
    """
    width, height = size
    low, high = shown.min(axis=0) - AROUND, shown.max(axis=0) + AROUND
    span = high - low
    scale = float(min(width / span[0], height / span[1]))
    middle = (low + high) / 2
    west, south = middle - np.array([width, height]) / (2 * scale)
    east, north = middle + np.array([width, height]) / (2 * scale)
    dpi = DOTS_PER_INCH * magnified
    figure = Figure(figsize=(width / dpi, height / dpi), dpi=dpi, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_xlim(float(west), float(east))
    axes.set_ylim(float(south), float(north))
    axes.set_axis_off()
    with rc_context({"font.family": ["DejaVu Sans"]}), warnings.catch_warnings():
        # Characters that the font lacks are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        layers.draw_floor(axes, site)
        layers.draw_rooms(axes, site)
        layers.draw_doors(axes, site)
        layers.draw_landmarks(axes, site)
        for route in routes:
            # Wider than the walk that will cover its line.
            ends = np.array(route.line.coords)[:, :2].T
            color = route_color(route.route)
            axes.plot(*ends, color=color, linewidth=6.5, alpha=0.45, zorder=7)
        draw_routes(axes, routes)
        draw_labels(axes, site, routes, LabelSpace(dpi / (72 * scale)), 1.0)
        canvas.draw()
    picture = np.asarray(canvas.buffer_rgba())[:height, :width, :3].copy()
    return PlanSheet(picture, scale, float(west), float(north))
