"""A site's plan as a small SVG that follows the reader's light or dark colours.

Walks are drawn over it in the pages. `drawing/plan_picture.py` draws sheets for paper, with
legend, scale and labels of all things; these plans are backgrounds.
"""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from markupsafe import Markup
from shapely import Polygon, get_coordinates

from memorymaze.drawing.label_placing import Box, LabelSpace, PlacedLabel, wrapped
from memorymaze.drawing.style import PLAN_STYLE
from memorymaze.sites import Corridor, Landmark, Site

MARGIN = 1.5
"""Metres of paper round the plan."""
NAME_SIZES = (1.3, 1.0, 0.8, 0.65)
"""Heights of letters, metres."""
THING_SIZE = 0.45
"""Height of letters, metres; read when one looks closer."""
FLAT = 0.05
"""Metres; what is no higher covers the floor."""


class Frame(NamedTuple):
    """A part of a plan in the coordinates of its SVG: metres, y down."""

    x: float
    y: float
    width: float
    height: float

    def __str__(self) -> str:
        """Return it as the value of `viewBox`."""
        return " ".join(svg_number(value) for value in self)


def plan_frame(site: Site) -> Frame:
    """Return the frame of a site's whole plan."""
    bounds = [site.walkable_floor.bounds]
    bounds += [room.polygon.bounds for room in site.rooms]
    west = min(each[0] for each in bounds) - MARGIN
    south = min(each[1] for each in bounds) - MARGIN
    east = max(each[2] for each in bounds) + MARGIN
    north = max(each[3] for each in bounds) + MARGIN
    return Frame(west, -north, east - west, north - south)


def plan_picture(site: Site) -> str:
    """Return a site's plan as an SVG document whose unit is the metre, y down."""
    frame = plan_frame(site)
    parts = [
        Markup(
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="{}" width="{}" '
            'height="{}"><title>{}</title><style>{}</style>'
        ).format(
            frame,
            svg_number(frame.width * 10),
            svg_number(frame.height * 10),
            site.title,
            PLAN_STYLE,
        ),
        _shapes("room", (room.polygon for room in site.rooms)),
        _shapes("floor", [site.walkable_floor]),
        _shapes("open", (area.polygon for area in site.areas if area.open_air)),
        _shapes("covering", (t.footprint for t in site.landmarks if _is_flat(t))),
        _shapes("turning", (place.polygon for place in site.turning_points)),
        _shapes("wall", [site.walkable_floor]),
        _lines("door", (get_coordinates(door.line).tolist() for door in site.doors)),
        _shapes("thing", (t.footprint for t in _things(site))),
        *_labels(site),
        Markup("</svg>\n"),
    ]
    return "\n".join(part for part in parts if part)


def path_data(
    lines: Iterable[Sequence[Sequence[float]]], *, closed: bool = False
) -> str:
    """Return lines in metres, y up, as the `d` of an SVG path, y down."""
    return "".join(
        "M"
        + "L".join(f"{svg_number(x)} {svg_number(-y)}" for x, y, *_ in line)
        + ("Z" if closed else "")
        for line in lines
    )


def svg_number(value: float) -> str:
    """Write metres to the centimetre, without needless zeros.

    >>> svg_number(12.0), svg_number(-0.004), svg_number(3.456)
    ('12', '0', '3.46')
    """
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _shapes(kind: str, polygons: Iterable[Polygon]) -> Markup:
    rings = [
        get_coordinates(ring).tolist()[:-1]
        for polygon in polygons
        for ring in (polygon.exterior, *polygon.interiors)
    ]
    if not rings:
        return Markup("")
    data = path_data(rings, closed=True)
    return Markup('<path class="{}" fill-rule="evenodd" d="{}"/>').format(kind, data)


def _lines(kind: str, lines: Iterable[Sequence[Sequence[float]]]) -> Markup:
    data = path_data(lines)
    return (
        Markup('<path class="{}" d="{}"/>').format(kind, data) if data else Markup("")
    )


def _labels(site: Site) -> Iterator[Markup]:
    """Write names of rooms, areas and corridors, then of things, where there is room."""
    # A point of LabelSpace is a metre here.
    space = LabelSpace(metres_per_point=1.0)
    for thing in _things(site):
        space.take(thing.footprint.bounds)
    for place in (*site.areas, *site.rooms):
        if place.name:
            frame = _middle_box(place.polygon)
            yield _text("name", space.inside(wrapped(place.name), [frame], NAME_SIZES))
    for corridor in site.corridors:
        if corridor.name:
            yield _text("way", _corridor_label(corridor, corridor.name, space))
    whole = plan_frame(site)
    sheet = (whole.x, -whole.y - whole.height, whole.x + whole.width, -whole.y)
    common = Counter(thing.category for thing in site.landmarks)
    rare_first = sorted(
        site.landmarks, key=lambda each: (common[each.category], each.id)
    )
    for thing in rare_first:
        west, south, east, north = thing.footprint.bounds
        words = thing.name or thing.category
        text = min(
            wrapped(words), key=lambda lines: abs(len(lines.split("\n")[0]) - 14)
        )
        box = (west, south, east, north)
        if _is_flat(thing):
            yield _text("word", space.inside(wrapped(words), [box], [THING_SIZE]))
        else:
            yield _text("word", space.beside(text, box, THING_SIZE, sheet))


def _is_flat(thing: Landmark) -> bool:
    """Tell whether a thing is a covering of the floor, such as a carpet."""
    return thing.mount == "floor" and thing.size[2] <= FLAT


def _things(site: Site) -> list[Landmark]:
    """Return what stands on the floor or hangs on a wall."""
    return [t for t in site.landmarks if t.mount != "ceiling" and not _is_flat(t)]


def _corridor_label(
    corridor: Corridor, name: str, space: LabelSpace
) -> PlacedLabel | None:
    start, end = corridor.centre_line.coords[0], corridor.centre_line.coords[-1]
    angle = math.atan2(end[1] - start[1], end[0] - start[0])
    middles = [
        (
            start[0] + share * (end[0] - start[0]) - aside * math.sin(angle),
            start[1] + share * (end[1] - start[1]) + aside * math.cos(angle),
        )
        for share in (0.5, 0.35, 0.65, 0.2, 0.8)
        for aside in (corridor.width / 4, -corridor.width / 4)
    ]
    for size in NAME_SIZES[1:]:
        if space.extent(name, size)[0] <= corridor.length and (
            label := space.along(name, middles, angle, size)
        ):
            return label
    return None


def _middle_box(polygon: Polygon) -> Box:
    """Return a box about the middle of a polygon, as wide as the polygon is there."""
    middle = polygon.centroid
    if not polygon.contains(middle):
        middle = polygon.representative_point()
    west, south, east, north = polygon.bounds
    wide = min(middle.x - west, east - middle.x) * 0.94
    high = min(middle.y - south, north - middle.y) * 0.94
    return middle.x - wide, middle.y - high, middle.x + wide, middle.y + high


def _text(kind: str, label: PlacedLabel | None) -> Markup:
    if label is None:
        return Markup("")
    lines = label.text.split("\n")
    size = label.font_size
    x, y = svg_number(label.x), svg_number(-label.y)
    top = -1.15 * size * (len(lines) - 1) / 2 + 0.35 * size
    rows = Markup("").join(
        Markup('<tspan x="{}" y="{}">{}</tspan>').format(
            x, svg_number(-label.y + top + 1.15 * size * number), line
        )
        for number, line in enumerate(lines)
    )
    degrees = _readable(-math.degrees(label.angle))
    turned = Markup(' transform="rotate({} {} {})"').format(svg_number(degrees), x, y)
    return Markup('<text class="{}" font-size="{}"{}>{}</text>').format(
        kind, svg_number(size), turned if degrees else "", rows
    )


def _readable(degrees: float) -> float:
    """Turn writing so that it never stands on its head."""
    return (degrees + 90) % 180 - 90
