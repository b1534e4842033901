"""A site's plan as a small SVG that follows the reader's light or dark colours.

Walks are drawn over it in the pages; `plan_picture.py` draws sheets for paper.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import NamedTuple

from markupsafe import Markup
from shapely import LineString, get_coordinates

from memorymaze.world.drawing.label_placing import LabelSpace, PlacedLabel
from memorymaze.world.drawing.labels import PlanLabel, place_labels
from memorymaze.world.drawing.shapes import (
    INKS,
    PlanShape,
    Points,
    plan_bounds,
    plan_shapes,
)
from memorymaze.world.sites import Site

MARGIN = 1.5
"""Metres of paper round the plan."""
NAME_SIZES = (1.3, 1.0, 0.8, 0.65, 0.5)
"""Heights of letters, metres."""
THING_SIZE = 0.45
"""Height of letters, metres; read when one looks closer."""
SIMPLER = 0.12
"""Metres by which a drawn walk may differ from the real one."""
STROKE = 0.1
"""Metres that a line of one point is wide."""
TEXT_STYLE = """\
path{stroke-linejoin:round}.covering{opacity:.35}.way{font-style:italic}
text{font-family:system-ui,"Segoe UI","DejaVu Sans",sans-serif;text-anchor:middle}
"""


class ViewBox(NamedTuple):
    """A part of a plan in the coordinates of its SVG: metres, y down."""

    x: float
    y: float
    width: float
    height: float

    def __str__(self) -> str:
        """Return it as the value of `viewBox`."""
        return " ".join(svg_number(value) for value in self)


def plan_frame(site: Site) -> ViewBox:
    """Return the frame of a site's whole plan."""
    west, south, east, north = plan_bounds(site, MARGIN)
    return ViewBox(west, -north, east - west, north - south)


def svg_plan(site: Site) -> str:
    """Return a site's plan as an SVG document whose unit is the metre, y down."""
    frame = plan_frame(site)
    # Walks are driven beneath what hangs from the ceiling.
    below = tuple(thing for thing in site.landmarks if thing.mount != "ceiling")
    site = replace(site, landmarks=below)
    # A point of LabelSpace is a metre here.
    labels = place_labels(
        site,
        (),
        LabelSpace(metres_per_point=1.0),
        NAME_SIZES,
        THING_SIZE,
        plan_bounds(site, MARGIN),
    )
    head = Markup(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="{}" width="{}" height="{}">'
        "<title>{}</title><style>{}</style>"
    ).format(
        frame,
        svg_number(frame.width * 10),
        svg_number(frame.height * 10),
        site.title,
        Markup(_style()),
    )
    paths = (
        _path(kind, list(group))
        for kind, group in groupby(plan_shapes(site), key=lambda each: each.kind)
    )
    words = (_text(label) for label in labels)
    parts = (head, *filter(None, paths), *filter(None, words), Markup("</svg>\n"))
    return "\n".join(parts)


def simplified(points: Points) -> Points:
    """Return the places of a walk that are needed to draw it."""
    if len(points) < 2:
        return points
    return get_coordinates(LineString(points).simplify(SIMPLER))


def path_data(line: Sequence[Sequence[float]], *, closed: bool = False) -> str:
    """Return a line in metres, y up, as the `d` of an SVG path, y down.

    A closed one ends where it began.
    """
    points = [f"{svg_number(x)} {svg_number(-y)}" for x, y, *_ in line]
    return f"M{'L'.join(points[:-1])}Z" if closed else f"M{'L'.join(points)}"


def svg_number(value: float) -> str:
    """Write metres to the centimetre, without needless zeros.

    >>> svg_number(12.0), svg_number(-0.004), svg_number(3.456)
    ('12', '0', '3.46')
    """
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _style() -> str:
    """Return the style sheet of plans: a colour of day and of night for each kind."""

    def colours(number: int) -> str:
        return ";".join(f"--{kind}:{ink[number]}" for kind, ink in INKS.items())

    def width(kind: str) -> str:
        return svg_number(INKS[kind].width * STROKE)

    rules = [
        f":root{{{colours(1)}}}",
        f"@media(prefers-color-scheme:dark){{:root{{{colours(2)}}}}}",
        *(f".{kind}{{fill:var(--{kind})}}" for kind in INKS),
        ".covering{fill:var(--thing)}",
        f".room{{stroke:var(--room_edge);stroke-width:{width('room')}}}",
        *(
            f".{kind}{{fill:none;stroke:var(--{kind});stroke-width:{width(kind)}}}"
            for kind in ("wall", "door")
        ),
    ]
    return "\n".join(rules) + "\n" + TEXT_STYLE


def _path(kind: str, shapes: Sequence[PlanShape]) -> Markup:
    data = "".join(
        path_data(line.tolist(), closed=bool(shape.polygons))
        for shape in shapes
        for line in shape.outlines()
    )
    if not data:
        return Markup("")
    return Markup('<path class="{}" fill-rule="evenodd" d="{}"/>').format(kind, data)


def _text(label: PlanLabel) -> Markup:
    placed = label.placed
    if placed is None:
        return Markup("")
    size = svg_number(placed.font_size)
    x, y = svg_number(placed.x), svg_number(-placed.y)
    # Writing never stands on its head.
    degrees = (90 - math.degrees(placed.angle)) % 180 - 90
    turned = Markup(' transform="rotate({} {} {})"').format(svg_number(degrees), x, y)
    return Markup('<text class="{}" font-size="{}"{}>{}</text>').format(
        label.kind, size, turned if degrees else "", Markup("").join(_rows(placed))
    )


def _rows(placed: PlacedLabel) -> Iterator[Markup]:
    lines = placed.text.split("\n")
    step = 1.15 * placed.font_size
    top = -placed.y - step * (len(lines) - 1) / 2 + 0.35 * placed.font_size
    for number, line in enumerate(lines):
        yield Markup('<tspan x="{}" y="{}">{}</tspan>').format(
            svg_number(placed.x), svg_number(top + number * step), line
        )
