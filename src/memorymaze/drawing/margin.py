"""What stands round a site's drawing: title, scale, north, legend."""

import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from memorymaze.drawing import layers
from memorymaze.drawing.obstacles import Met, met_marks
from memorymaze.drawing.routes import WALK_COLOR, route_lines
from memorymaze.sites.records import Route, Site

HEAD = 0.9
"""Inches above the plan."""
FOOT = 1.25
"""Inches below the plan."""
BAR_LENGTHS = (1, 2, 5, 10, 20, 50, 100, 200, 500)
"""Metres that a scale bar may stand for."""
LONGEST_BAR = 3.0
"""Inches."""
CORNER = 4.0
"""Inches across the corner that holds scale bar and north arrow."""


def write_head(figure: Figure, site: Site, sheet_high: float) -> None:
    """Write title and counts above the plan; `sheet_high` in inches."""
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


def draw_scale_and_north(
    figure: Figure, site: Site, scale: float, sheet_wide: float, sheet_high: float
) -> None:
    """Draw a scale bar and a north arrow in the upper right corner."""
    corner = figure.add_axes((
        1 - CORNER / sheet_wide,
        1 - 0.85 / sheet_high,
        CORNER / sheet_wide,
        0.85 / sheet_high,
    ))
    corner.set_xlim(0, CORNER)
    corner.set_ylim(0, 0.85)
    corner.set_axis_off()
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
    corner.text(
        float(middle[0] + 0.32 * north[0]),
        float(middle[1] + 0.32 * north[1]),
        "N",
        fontsize=9,
        ha="center",
        va="center",
    )


def write_legend(
    figure: Figure,
    site: Site,
    routes: Sequence[Route],
    walked: bool,
    left_out: int,
    met: Met,
) -> None:
    """Explain below the plan what its colours and lines mean.

    Args:
        figure: The sheet.
        site: What is drawn on it.
        routes: Those that are drawn.
        walked: Whether walks are drawn.
        left_out: How many labels found no room.
        met: Things in the way and people that are drawn.
    """
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
    for route, line in zip(routes, route_lines(routes), strict=True):
        role = " (alternative)" if route.role == "alternative" else ""
        line.set_data([], [])
        line.set_label(
            f"{route.route}{role}: {route.line.length:.2f} m to {route.goal}"
        )
        marks.append(line)
    if walked:
        marks.append(Line2D([], [], color=WALK_COLOR, label="walked"))
    marks += met_marks(met)
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
