"""Plots and word clouds of the statistics, each with words for those who do not see it."""

import base64
import io
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from zlib import crc32

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from matplotlib.typing import RcKeyType
from wordcloud import WordCloud

from memorymaze.basics.wording import counted
from memorymaze.texts.corpus.statistics import FUNCTION_WORDS, tokens
from memorymaze.texts.statistics.study import (
    ALL_SITES,
    BOTH_ITERATIONS,
    InstructionStudy,
)
from memorymaze.texts.statistics.tables import SPEECH, THINGS, title_of_place

COLORS = {"online": "#1d5fae", "onsite": "#b8481c"}
OTHER_COLOR = "#5d3aa8"
DARK = "#22242a"
DASHES = ("-", "--", ":", "-.")
MARKERS = {"metres": "o", "steps": "s", "time": "^", "vague": "x"}
THING_COLORS = ("#1d5fae", "#3f8f6b", "#d29b2c", "#8566b8", "#7c6a55", "#b9bcc2")
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
    "legend.frameon": False,
    "svg.fonttype": "path",
    # A dollar sign in a name is no formula.
    "text.parse_math": False,
    "svg.hashsalt": "memorymaze",
}

CLOUD_SIZE = (560, 340)
"""Pixels."""
CLOUD_WORDS = 120
CLOUD_COLORS = {
    "online": ("#0b3c7d", "#1d5fae", "#3a6fb0", "#14606e"),
    "onsite": ("#7c2305", "#a83a06", "#b8481c", "#7a4a12"),
}
OTHER_CLOUD_COLORS = ("#3f2a73", "#5d3aa8", "#6a4c8c", "#53306b")
"""Dark enough to be read on white."""
TOLD_WORDS = 15
"""Words of a cloud that are told to those who do not see it."""


@dataclass(frozen=True, slots=True)
class _Picture:
    """A picture inside a page."""

    source: str
    """Data URL."""
    alt: str
    caption: str


def study_plots(study: InstructionStudy) -> Mapping[str, _Picture]:
    """Return by name the plots for which there is something to show."""
    plots = {"lengths": _lengths(study), "speech": _speech(study)}
    plots["things"] = _things(study)
    if study.curves:
        plots["curves"] = _curves(study)
    if any(text.distances for text in study.texts):
        plots["distances"] = _distances(study)
    return plots


def _drawn(
    draw: Callable[[Axes], None], size: tuple[float, float], alt: str, caption: str
) -> _Picture:
    """Draw; the figures themselves are in the table above."""
    with rc_context(STYLE), warnings.catch_warnings():
        # Characters that no installed font has are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        draw(figure.add_subplot())
        picture = io.StringIO()
        figure.savefig(picture, format="svg", metadata={"Date": None, "Title": alt})
    svg = base64.b64encode(picture.getvalue().encode()).decode()
    alt += "; the figures are in the table."
    return _Picture(f"data:image/svg+xml;base64,{svg}", alt, caption)


def _color(study: str) -> str:
    return COLORS.get(study, OTHER_COLOR)


def _lengths(study: InstructionStudy) -> _Picture:
    """Draw words per text in every cell of Table I, with the published means."""
    cells = study.rows("table_1", "study", "place", "route", "iteration")
    words: dict[tuple[object, ...], list[int]] = {}
    for text in study.texts:
        told = text.instruction
        key = (told.study, told.site, told.route, told.iteration)
        words.setdefault(key, []).append(text.words)

    def draw(axes: Axes) -> None:
        heights = range(len(cells), 0, -1)
        about = ("study", "place", "route", "iteration")
        boxes = axes.boxplot(
            [words[tuple(cell[field] for field in about)] for cell in cells],
            positions=list(heights),
            orientation="horizontal",
            widths=0.6,
            patch_artist=True,
            medianprops={"color": DARK},
            flierprops={"markersize": 2.5, "markeredgecolor": "#565a63"},
        )
        for cell, box in zip(cells, boxes["boxes"], strict=True):
            box.set(facecolor=_color(cell["study"]), alpha=0.55)
        known = [
            (cell["words_mean published"], height)
            for cell, height in zip(cells, heights, strict=True)
            if cell["words_mean published"] is not None
        ]
        if known:
            axes.plot(
                *zip(*known, strict=True),
                "D",
                color=DARK,
                markersize=4,
                label="published mean",
            )
            axes.legend(loc="lower right", bbox_to_anchor=(1, 1))
        titles = [
            f"{c['study']}, {title_of_place(c['place'])} {c['route']}, {c['iteration']}"
            for c in cells
        ]
        axes.set_yticks(list(heights), titles)
        axes.set_xlabel("words per text")
        axes.grid(axis="x")
        axes.set_xlim(left=0)

    return _drawn(
        draw,
        (8.2, 1.0 + 0.26 * len(cells)),
        "Box plots of words per text for every study, route and iteration",
        "Words per text: median, quartiles, and texts beyond 1.5 times their distance as "
        "points; diamonds are the published means on human texts.",
    )


def _curves(study: InstructionStudy) -> _Picture:
    """Draw type-token curves, one per study and place."""

    def draw(axes: Axes) -> None:
        places = sorted({place for _, place in study.curves})
        for (name, place), curve in study.curves.items():
            dashes = DASHES[places.index(place) % len(DASHES)]
            label = f"{title_of_place(place)}, {name}"
            axes.plot(
                curve.tokens, curve.types, dashes, color=_color(name), label=label
            )
        axes.set_xlabel("words read")
        axes.set_ylabel("distinct words")
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
        axes.legend(fontsize=8)

    return _drawn(
        draw,
        (6.4, 4.2),
        "Type-token curves, rising ever more slowly",
        "Distinct words among the first words read, mean over 20 orders of the texts.",
    )


def _speech(study: InstructionStudy) -> _Picture:
    """Draw hedges, fillers and corrections per 100 words."""
    about = ("study", "iteration")
    rows = study.rows("per_text", *about, place=ALL_SITES)
    groups = [row for row in rows if row["iteration"] != BOTH_ITERATIONS]

    def draw(axes: Axes) -> None:
        width = 0.8 / len(groups)
        for number, group in enumerate(groups):
            axes.bar(
                np.arange(len(SPEECH)) + (number - (len(groups) - 1) / 2) * width,
                [group[f"{name} per 100 words"] for name in SPEECH],
                0.9 * width,
                color=_color(group["study"]),
                alpha=0.55 if group["iteration"] == 1 else 1.0,
                label=f"{group['study']}, iteration {group['iteration']}",
            )
        axes.set_xticks(range(len(SPEECH)), SPEECH)
        axes.set_ylabel("per 100 words")
        axes.legend()

    return _drawn(
        draw,
        (6.4, 3.6),
        "Bars of marks of speech per 100 words",
        "Hedges, fillers and corrections per 100 words, by study and iteration.",
    )


def _things(study: InstructionStudy) -> _Picture:
    """Draw things named per text, by what of the plan they are."""
    rows = study.rows("per_text", "study", "place", "iteration")
    groups = [
        row
        for row in rows
        if row["place"] != ALL_SITES and row["iteration"] != BOTH_ITERATIONS
    ]

    def draw(axes: Axes) -> None:
        heights = np.arange(len(groups), 0, -1)
        left = np.zeros(len(groups))
        for (name, title), color in zip(THINGS.items(), THING_COLORS, strict=True):
            values = np.array([group[f"{name} mean"] for group in groups])
            axes.barh(heights, values, 0.72, left=left, color=color, label=title)
            left += values
        titles = [
            f"{g['study']}, {title_of_place(g['place'])}, {g['iteration']}"
            for g in groups
        ]
        axes.set_yticks(heights, titles)
        axes.set_xlabel("things named per text")
        axes.grid(axis="x")
        axes.grid(visible=False, axis="y")
        axes.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.4, 1))

    return _drawn(
        draw,
        (7.4, 1.4 + 0.28 * len(groups)),
        "Stacked bars of things named per text, by site and iteration",
        "Things named per text, by what of the site plan they fit best.",
    )


def _distances(study: InstructionStudy) -> _Picture:
    """Draw stated against true lengths of legs, both axes logarithmic."""
    groups: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for text in study.texts:
        for leg in text.distances:
            key = (leg.instruction.study, leg.unit)
            groups.setdefault(key, []).append((leg.true, leg.stated))
    true = [length for points in groups.values() for length, _ in points]

    def draw(axes: Axes) -> None:
        ends = (0.8 * min(true), 1.25 * max(true))
        axes.plot(ends, ends, color=DARK, linewidth=1, label="as it is")
        for (name, unit), points in sorted(groups.items()):
            axes.plot(
                *zip(*points, strict=True),
                MARKERS[unit],
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
        axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))

    return _drawn(
        draw,
        (7.2, 4.8),
        "Points of stated over true length of legs, around the diagonal",
        "Stated and true length of legs, by study and by what was counted in; on the "
        "line they agree.",
    )


def word_clouds(study: InstructionStudy, *, seed: int) -> Iterator[_Picture]:
    """Draw the words of every study and site, larger the more often they are said.

    Function words (the, you, then) are left out, as in the counting rule `content`;
    fillers such as "um" are not. The same seed gives the same pictures.
    """
    texts: dict[tuple[str, str], list[str]] = {}
    for each in study.instructions:
        texts.setdefault((each.site, each.study), []).append(each.text)
    for (site, name), told in sorted(texts.items()):
        counts = Counter(
            word
            for text in told
            for word in tokens(text)
            if len(word) > 1 and word not in FUNCTION_WORDS
        )
        if not counts:
            continue
        # Equal counts are put in order of the alphabet, so that nothing is left to the
        # order of the texts.
        ordered = sorted(counts.items(), key=lambda each: (-each[1], each[0]))
        words = ", ".join(f"{word} ({count})" for word, count in ordered[:TOLD_WORDS])
        place = f"{title_of_place(site)}, {name}"
        png = _cloud(dict(ordered[:CLOUD_WORDS]), name, seed)
        yield _Picture(
            f"data:image/png;base64,{base64.b64encode(png).decode()}",
            f"Word cloud of {place}. Commonest words: {words}.",
            f"{place}: {counted(len(told), 'text')} of {' '.join(study.written)}",
        )


def _cloud(counts: dict[str, int], study: str, seed: int) -> bytes:
    cloud = WordCloud(
        width=CLOUD_SIZE[0],
        height=CLOUD_SIZE[1],
        scale=2,
        background_color="white",
        color_func=_painter(CLOUD_COLORS.get(study, OTHER_CLOUD_COLORS)),
        max_words=CLOUD_WORDS,
        prefer_horizontal=0.95,
        random_state=seed,
    ).generate_from_frequencies(counts)
    picture = io.BytesIO()
    cloud.to_image().quantize(48).save(picture, "PNG", optimize=True)
    return picture.getvalue()


def _painter(colors: Sequence[str]) -> Callable[..., str]:
    def paint(word: str, **_: object) -> str:
        return colors[crc32(word.encode()) % len(colors)]

    return paint
