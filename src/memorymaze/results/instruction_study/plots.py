"""Plots of the statistics as SVG pictures."""

import io
import warnings
from collections.abc import Callable, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from matplotlib.typing import RcKeyType

from memorymaze.instructions.published import published_tables
from memorymaze.results.instruction_study.study import InstructionStudy, Vocabulary
from memorymaze.results.instruction_study.study_table import place_title

Plot = Callable[[InstructionStudy], str]

COLORS = {"online": "#1d5fae", "onsite": "#b8481c"}
OTHER_COLOR = "#5d3aa8"
DASHES = ("-", "--", ":", "-.")
STYLE: dict[RcKeyType, object] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.grid.axis": "y",
    "grid.color": "#e4e1da",
    "axes.axisbelow": True,
    "axes.edgecolor": "#8d8f96",
    "figure.facecolor": "#ffffff",
    "svg.fonttype": "path",
    # A dollar sign in a name is no formula.
    "text.parse_math": False,
    "svg.hashsalt": "memorymaze",
}


def _drawn(
    draw: Callable[[Axes], None], size: tuple[float, float], *, title: str
) -> str:
    with rc_context(STYLE), warnings.catch_warnings():
        # Characters that no installed font has are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        draw(figure.add_subplot())
        picture = io.StringIO()
        figure.savefig(picture, format="svg", metadata={"Date": None, "Title": title})
    return picture.getvalue()


def _color(study: str) -> str:
    return COLORS.get(study, OTHER_COLOR)


def lengths_plot(study: InstructionStudy) -> str:
    """Words per text in every cell of Table I, with the published means."""
    published = {
        (row.study, row.site, row.route, row.iteration): row.words_mean
        for row in published_tables().descriptions
    }
    cells = [(c.study, c.site, c.route, c.iteration) for c in study.cells]
    words: dict[tuple[str, str, str, int], list[int]] = {}
    for text in study.texts:
        told = text.instruction
        key = (told.study, told.site, told.route, told.iteration)
        words.setdefault(key, []).append(text.words)

    def draw(axes: Axes) -> None:
        places = range(len(cells), 0, -1)
        boxes = axes.boxplot(
            [words[cell] for cell in cells],
            positions=list(places),
            orientation="horizontal",
            widths=0.6,
            patch_artist=True,
            medianprops={"color": "#22242a"},
            flierprops={"markersize": 2.5, "markeredgecolor": "#565a63"},
        )
        for cell, box in zip(cells, boxes["boxes"], strict=True):
            box.set(facecolor=_color(cell[0]), alpha=0.55)
        known = [
            (published[cell], place)
            for cell, place in zip(cells, places, strict=True)
            if cell in published
        ]
        if known:
            axes.plot(
                *zip(*known, strict=True),
                "D",
                color="#22242a",
                markersize=4,
                label="published mean",
            )
            axes.legend(frameon=False, loc="lower right", bbox_to_anchor=(1, 1))
        axes.set_yticks(
            list(places),
            [f"{s}, {place_title(site)} {r}, {n}" for s, site, r, n in cells],
        )
        axes.set_xlabel("words per text")
        axes.grid(axis="x")
        axes.set_xlim(left=0)

    return _drawn(draw, (8.2, 1.0 + 0.26 * len(cells)), title="Words per text")


def curves_plot(study: InstructionStudy) -> str:
    """Type-token curves, one per study and place."""

    def draw(axes: Axes) -> None:
        places = sorted({each.place for each in study.vocabularies})
        for each in study.vocabularies:
            dashes = DASHES[places.index(each.place) % len(DASHES)]
            axes.plot(
                each.curve.tokens,
                each.curve.types,
                dashes,
                color=_color(each.study),
                label=_vocabulary_title(each),
            )
        axes.set_xlabel("words read")
        axes.set_ylabel("distinct words")
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
        axes.legend(frameon=False, fontsize=8)

    return _drawn(draw, (6.4, 4.2), title="Type-token curves")


def _vocabulary_title(each: Vocabulary) -> str:
    return f"{place_title(each.place)}, {each.study}"


def speech_plot(study: InstructionStudy) -> str:
    """Hedges, fillers and corrections per 100 words."""
    names = ("hedges", "fillers", "corrections")
    groups = [g for g in study.groups if g.site is None and g.iteration is not None]

    def draw(axes: Axes) -> None:
        width = 0.8 / len(groups)
        for number, group in enumerate(groups):
            axes.bar(
                np.arange(len(names)) + (number - (len(groups) - 1) / 2) * width,
                [100 * group.means[name] / max(group.words, 1) for name in names],
                0.9 * width,
                color=_color(group.study),
                alpha=0.55 if group.iteration == 1 else 1.0,
                label=f"{group.study}, iteration {group.iteration}",
            )
        axes.set_xticks(range(len(names)), names)
        axes.set_ylabel("per 100 words")
        axes.legend(frameon=False)

    return _drawn(draw, (6.4, 3.6), title="Hedges, fillers and corrections")


def things_plot(study: InstructionStudy) -> str:
    """Things named per text, by what of the plan they are."""
    sorts: Sequence[tuple[str, str, str]] = (
        ("landmarks", "landmarks", "#1d5fae"),
        ("doors", "doors", "#3f8f6b"),
        ("rooms", "rooms", "#d29b2c"),
        ("ways", "hallways", "#8566b8"),
        ("floors", "floors", "#7c6a55"),
        ("unknown_things", "not in the plan", "#b9bcc2"),
    )
    groups = [g for g in study.groups if g.site is not None and g.iteration is not None]

    def draw(axes: Axes) -> None:
        places = np.arange(len(groups), 0, -1)
        left = np.zeros(len(groups))
        for name, title, color in sorts:
            values = np.array([group.means[name] for group in groups])
            axes.barh(places, values, 0.72, left=left, color=color, label=title)
            left += values
        axes.set_yticks(
            places,
            [f"{g.study}, {place_title(g.site or '')}, {g.iteration}" for g in groups],
        )
        axes.set_xlabel("things named per text")
        axes.grid(axis="x")
        axes.grid(visible=False, axis="y")
        axes.legend(frameon=False, ncols=3, loc="lower center", bbox_to_anchor=(0.4, 1))

    return _drawn(draw, (7.4, 1.4 + 0.28 * len(groups)), title="Things named")


def distances_plot(study: InstructionStudy) -> str:
    """Stated against true lengths of legs, both axes logarithmic."""
    markers = {"metres": "o", "steps": "s", "time": "^", "vague": "x"}
    legs = [leg for text in study.texts for leg in text.distances]

    def draw(axes: Axes) -> None:
        ends = [
            0.8 * min(leg.true for leg in legs),
            1.25 * max(leg.true for leg in legs),
        ]
        axes.plot(ends, ends, color="#22242a", linewidth=1, label="as it is")
        groups: dict[tuple[str, str], list[tuple[float, float]]] = {}
        for leg in legs:
            key = (leg.instruction.study, leg.unit)
            groups.setdefault(key, []).append((leg.true, leg.stated))
        for (name, unit), points in sorted(groups.items()):
            axes.plot(
                *zip(*points, strict=True),
                markers[unit],
                color=_color(name),
                alpha=0.45,
                markersize=4,
                label=f"{name}, {unit}",
            )
        axes.set_xscale("log")
        axes.set_yscale("log")
        ticks = [1, 2, 5, 10, 20, 50, 100]
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_ticks(ticks, [str(tick) for tick in ticks])
            axis.set_minor_locator(NullLocator())
        axes.set_xlim(*ends)
        axes.set_xlabel("true length of the leg, metres")
        axes.set_ylabel("stated length, metres")
        axes.grid(axis="both")
        axes.legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))

    return _drawn(draw, (7.2, 4.8), title="Stated and true distances")


PLOTS: dict[str, Plot] = {
    "lengths": lengths_plot,
    "curves": curves_plot,
    "speech": speech_plot,
    "things": things_plot,
    "distances": distances_plot,
}
"""By name; `distances` only where a stated distance could be compared, `curves` only
where there are words."""
