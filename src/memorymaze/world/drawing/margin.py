"""What stands round a site's drawing: title, scale, north, legend."""

import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from memorymaze.world.drawing.axes import (
    TURNING_POINT_ALPHA,
    WIDE_FROM,
    axes_in,
    route_lines,
)
from memorymaze.world.drawing.shapes import (
    INKS,
    PEOPLE_COLOR,
    THING_COLOR,
    VARIETIES,
    WALK_COLOR,
    Met,
    OnSheet,
    PlanShape,
)
from memorymaze.world.sites.records import Route, Site

HEAD_GAP, FOOT = 0.38, 1.25
"""Inches round what is written above the plan, and for the legend below."""
BAR_LENGTHS = (1, 2, 5, 10, 20, 50, 100, 200, 500)
"""Metres that a scale bar may stand for."""
LONGEST_BAR = 3.0
"""Inches."""
CORNER = 4.0
"""Inches across the corner that holds scale bar and north arrow."""


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


def rows_of(head: Sequence[HeadLine], wide: float) -> list[HeadLine]:
    """Break what stands above a plan into rows that fit a width, inches."""
    rows: list[HeadLine] = []
    for line in head:
        # Letters of other scripts are as wide as high.
        letter = 1.0 if any(ord(each) >= WIDE_FROM for each in line.text) else 0.56
        most = max(20, int(wide * 72 / (letter * line.size)))
        rows += [replace(line, text=text) for text in textwrap.wrap(line.text, most)]
    return rows


def write_head(figure: Figure, rows: Sequence[HeadLine]) -> None:
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
    """Draw scale, in inches per metre, and north in the upper right corner."""
    wide, high = CORNER / figure.get_figwidth(), 0.85 / figure.get_figheight()
    corner = axes_in(figure, (1 - wide, 1 - high, wide, high), (0, 0), (CORNER, 0.85))
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


def legend_marks(
    shown: OnSheet, routes: Sequence[Route], walked: bool, met: Met
) -> Iterator[Line2D | Patch]:
    """Return what the colours and lines on a sheet mean."""
    floor, wall = INKS["floor"].paper, INKS["wall"].paper
    yield Patch(facecolor=floor, edgecolor=wall, label="floor")
    if shown.rooms:
        edge = INKS["room_edge"].paper
        yield Patch(facecolor=INKS["room"].paper, edgecolor=edge, label="room")
    if any(area.open_air for area in shown.areas):
        yield Patch(facecolor=INKS["open_air"].paper, label="open air")
    if shown.turning_points:
        yield Patch(
            facecolor=INKS["turning_point"].paper,
            alpha=TURNING_POINT_ALPHA,
            label="turning point with its exits",
        )
    for style in dict.fromkeys(door.style for door in shown.doors):
        name = f"{style.replace('_', ' ')} door"
        color = PlanShape("door", style).paper
        yield Line2D([], [], color=color, linewidth=3, label=name)
    if any(door.state == "open" for door in shown.doors):
        yield Line2D(
            [], [], color="#555555", linewidth=3, dashes=(1, 2), label="open door"
        )
    for mount in dict.fromkeys(thing.mount for thing in shown.landmarks):
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


def write_legend(
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
