"""The words on a site's drawing: names of places, and labels of things."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from matplotlib.axes import Axes
from shapely import Polygon, box, get_coordinates, segmentize
from shapely.geometry.base import BaseGeometry

from memorymaze.drawing.label_placing import Box, LabelSpace, PlacedLabel, wrapped
from memorymaze.sites.records import Corridor, Landmark, Route, Site

ROOM_COLOR = "#444444"
LANDMARK_COLOR = "#1d5a2b"
DOOR_COLOR = "#6b3a10"
NAME_COLOR = "#7a5c1e"
NAME_SIZES = (7.0, 6.0, 5.0, 4.2)
"""Points."""
THING_SIZE = 4.4
"""Points."""
LONGEST_LABEL = 34
"""Characters."""
LONGEST_LINE = 18
"""Characters."""
NEIGHBOURS = 4.0
"""Equal things this many metres apart share a label."""
LINE_STEP = 0.25
"""Metres between the boxes that keep labels off lines."""
LINE_HALF = 0.06
"""Half the side of such a box, metres."""
SHARES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
"""Of a polygon's bounding box, tried for a box inside it."""


def draw_labels(
    axes: Axes,
    site: Site,
    routes: Sequence[Route],
    space: LabelSpace,
    magnified: float,
) -> int:
    """Write names of rooms, areas and corridors, and labels of things.

    Walls, doors, things and routes stay uncovered. Equal things beside each other share
    a label, and rare things are labelled first.
    """
    lines = [door.line for door in site.doors] + [route.line for route in routes]
    for line in (*lines, site.walkable_floor.boundary):
        for spot in _spots(line):
            space.take(spot)
    for thing in site.landmarks:
        space.take(_bounds(thing.footprint.bounds))
    names = [size * magnified for size in NAME_SIZES]
    labels = [
        *_room_names(site, space, names),
        *_place_names(site, space, names),
        *_thing_labels(
            site, space, THING_SIZE * magnified, _bounds(axes.viewLim.extents)
        ),
    ]
    for label, color, style in labels:
        if label:
            _write(axes, label, color, style)
    return sum(label is None for label, _, _ in labels)


def _spots(line: BaseGeometry) -> Iterator[Box]:
    """Return small boxes close together along a line."""
    for x, y in get_coordinates(segmentize(line, LINE_STEP)):
        yield x - LINE_HALF, y - LINE_HALF, x + LINE_HALF, y + LINE_HALF


Label = tuple[PlacedLabel | None, str, str]
"""With colour and style."""


def _room_names(
    site: Site, space: LabelSpace, sizes: Sequence[float]
) -> Iterator[Label]:
    for room in site.rooms:
        frame = _inner_frame(room.polygon)
        yield (
            space.inside(wrapped(room.name), [frame], sizes),
            ROOM_COLOR,
            "normal",
        )


def _place_names(
    site: Site, space: LabelSpace, sizes: Sequence[float]
) -> Iterator[Label]:
    for area in site.areas:
        if area.name:
            frames = _frames_across(area.polygon)
            label = space.inside(wrapped(area.name), frames, sizes)
            yield label, NAME_COLOR, "italic"
    for corridor in site.corridors:
        if corridor.name:
            yield (
                _corridor_name(corridor, corridor.name, space, sizes),
                NAME_COLOR,
                "italic",
            )


def _corridor_name(
    corridor: Corridor, name: str, space: LabelSpace, sizes: Sequence[float]
) -> PlacedLabel | None:
    way = corridor.centre_line
    start, end = way.coords[0], way.coords[-1]
    angle = math.atan2(end[1] - start[1], end[0] - start[0])
    aside = corridor.width / 4
    spots = [
        (
            start[0] + share * (end[0] - start[0]) - side * aside * math.sin(angle),
            start[1] + share * (end[1] - start[1]) + side * aside * math.cos(angle),
        )
        for share in (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
        for side in (1, -1, 0)
    ]
    for font_size in sizes:
        if space.extent(name, font_size)[0] <= way.length and (
            label := space.along(name, spots, angle, font_size)
        ):
            return label
    return None


def _thing_labels(
    site: Site, space: LabelSpace, font_size: float, sheet: Box
) -> Iterator[Label]:
    commonness = Counter(thing.category for thing in site.landmarks)
    groups = sorted(
        _equal_neighbours(site.landmarks),
        key=lambda group: (commonness[group[0].category], group[0].id),
    )
    for group in groups:
        thing = _bounds(group[len(group) // 2].footprint.bounds)
        label = space.beside(_thing_words(group), thing, font_size, sheet)
        yield label, LANDMARK_COLOR, "normal"
    rooms = {room.id: room.name for room in site.rooms}
    for door in site.doors:
        if door.label and door.label not in rooms.get(door.room or "", ""):
            line = _bounds(door.line.buffer(LINE_HALF).bounds)
            label = space.beside(_broken(f"“{door.label}”"), line, font_size, sheet)
            yield label, DOOR_COLOR, "normal"


def _thing_words(group: Sequence[Landmark]) -> str:
    thing = group[0]
    words = thing.name or thing.category
    if thing.text:
        words = f"{words}: “{thing.text}”"
    if len(words) > LONGEST_LABEL:
        words = words[: LONGEST_LABEL - 1].rstrip() + "…"
    if len(group) > 1:
        words = f"{words} x{len(group)}"
    return _broken(words)


def _broken(words: str) -> str:
    """Break a label into short lines."""
    lengths = {
        version: max(map(len, version.split("\n"))) for version in wrapped(words)
    }
    return next(
        (version for version, length in lengths.items() if length <= LONGEST_LINE),
        min(lengths, key=lengths.__getitem__),
    )


def _equal_neighbours(things: Iterable[Landmark]) -> list[list[Landmark]]:
    """Group things that look the same and stand beside each other."""
    groups: list[list[Landmark]] = []
    for thing in things:
        looks = (thing.category, thing.name, thing.text)
        for group in groups:
            other = group[-1]
            if looks == (other.category, other.name, other.text) and (
                thing.position.distance(other.position) <= NEIGHBOURS
            ):
                group.append(thing)
                break
        else:
            groups.append([thing])
    return groups


def _write(axes: Axes, label: PlacedLabel, color: str, style: str) -> None:
    axes.text(
        label.x,
        label.y,
        label.text,
        fontsize=label.font_size,
        color=color,
        style=style,
        rotation=math.degrees(label.angle),
        rotation_mode="anchor",
        horizontalalignment="center",
        verticalalignment="center",
        linespacing=1.1,
        parse_math=False,
        clip_on=True,
        zorder=10,
    )


def _inner_frame(polygon: Polygon) -> Box:
    """Return the largest easily found box in a polygon, about its middle."""
    middle = polygon.centroid
    if not polygon.contains(middle):
        middle = polygon.representative_point()
    west, south, east, north = polygon.bounds
    wide = min(middle.x - west, east - middle.x)
    high = min(middle.y - south, north - middle.y)
    ground = polygon.buffer(0.05)
    frames = [
        (
            middle.x - wide * across,
            middle.y - high * along,
            middle.x + wide * across,
            middle.y + high * along,
        )
        for across in SHARES
        for along in SHARES
    ]
    inside = [frame for frame in frames if ground.covers(box(*frame))] or frames[-1:]
    return max(inside, key=lambda frame: (frame[2] - frame[0]) * (frame[3] - frame[1]))


def _frames_across(polygon: Polygon) -> list[Box]:
    """Return boxes in a polygon, the middle ones and the largest ones first."""
    west, south, east, north = polygon.bounds
    middle = polygon.centroid
    frames = [_inner_frame(polygon)]
    for across in range(1, 8):
        for along in range(1, 8):
            x = west + (east - west) * across / 8
            y = south + (north - south) * along / 8
            wide, high = (east - west) / 6, (north - south) / 6
            frame = (x - wide, y - high, x + wide, y + high)
            if polygon.covers(box(*frame)):
                frames.append(frame)
    frames[1:] = sorted(
        frames[1:],
        key=lambda frame: math.hypot(
            (frame[0] + frame[2]) / 2 - middle.x, (frame[1] + frame[3]) / 2 - middle.y
        ),
    )
    return frames


def _bounds(bounds: Sequence[float]) -> Box:
    west, south, east, north = map(float, bounds)
    return west, south, east, north
