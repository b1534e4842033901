"""Things left in the way and people who walked about, on a site's drawing."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from numpy.typing import NDArray

THING_COLOR = "#e0218a"
PEOPLE_COLOR = "#0b8f8f"
LEAST_SIDE = 0.45
"""Metres that things are drawn large at least, so that one finds them."""
ARROW_EVERY = 6.0
"""Metres of a person's walk from one arrow to the next."""


class ThingInTheWay(NamedTuple):
    """A thing that no plan has."""

    category: str
    x: float
    """Of its middle, metres."""
    y: float
    """Of its middle, metres."""
    heading: float
    """The way its front faces, radians."""
    length: float
    """Across the front, metres."""
    depth: float
    """Metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Met:
    """What a robot could meet beyond the plan, in one episode."""

    things: Sequence[ThingInTheWay] = ()
    walks: Sequence[NDArray[np.float64]] = ()
    """Where each person was, metres, shape (N, 2)."""
    near_misses: Sequence[tuple[float, float]] = ()
    """Where the robot was when a person came too close, metres."""


def draw_met(axes: Axes, met: Met) -> None:
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
            Polygon(
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


def met_marks(met: Met) -> list[Line2D | Patch]:
    """Return what the legend says of them."""
    marks: list[Line2D | Patch] = []
    if met.things:
        marks.append(Patch(facecolor=THING_COLOR, label="left in the way"))
    if met.walks:
        marks.append(
            Line2D(
                [],
                [],
                color=PEOPLE_COLOR,
                marker="o",
                markersize=4,
                label="person, from the dot on",
            )
        )
    if met.near_misses:
        marks.append(
            Line2D(
                [],
                [],
                color=THING_COLOR,
                linestyle="",
                marker="o",
                fillstyle="none",
                label="near miss",
            )
        )
    return marks


def _arrows(
    walk: NDArray[np.float64],
) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    steps = np.linalg.norm(np.diff(walk, axis=0), axis=1)
    come = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.arange(ARROW_EVERY / 2, come[-1], ARROW_EVERY)
    places = np.searchsorted(come, wanted)
    return [(walk[at - 1], walk[at]) for at in places.tolist() if steps[at - 1] > 0.1]


def _corners(thing: ThingInTheWay) -> NDArray[np.float64]:
    half_x = max(thing.depth, LEAST_SIDE) / 2
    half_y = max(thing.length, LEAST_SIDE) / 2
    cosine, sine = math.cos(thing.heading), math.sin(thing.heading)
    box = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (half_x, half_y)
    turned = box @ np.array([(cosine, sine), (-sine, cosine)])
    return turned + np.array([thing.x, thing.y])
