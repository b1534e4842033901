"""The words on a plan and where they go: names of places, and labels of things."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Literal, NamedTuple

from shapely import LineString, Polygon, box, get_coordinates, get_parts, segmentize
from shapely.geometry.base import BaseGeometry

from memorymaze.world.drawing.label_placing import Box, LabelSpace, PlacedLabel, wrapped
from memorymaze.world.drawing.shapes import OnSheet, is_covering, on_sheet
from memorymaze.world.sites.records import Area, Corridor, Landmark, Route, Site

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


class PlanLabel(NamedTuple):
    """A word on a plan."""

    placed: PlacedLabel | None
    """None where it found no room."""
    kind: Literal["name", "way", "word", "sign"]
    """Of a room, of an area or corridor, of a thing, on a door."""


def place_labels(
    site: Site,
    routes: Sequence[Route],
    space: LabelSpace,
    names: Sequence[float],
    thing: float,
    sheet: Box,
) -> list[PlanLabel]:
    """Place names of rooms, areas and corridors, and labels of things.

    Walls, doors, things and routes stay uncovered. Equal things beside each other share
    a label, and rare things are labelled first.

    Args:
        site: Whose plan.
        routes: Those that are drawn.
        space: Where labels go.
        names: Font sizes of names, the largest first.
        thing: Font size of what is said of things.
        sheet: What is drawn of the plan.
    """
    shown = on_sheet(site, sheet)
    lines = [door.line for door in shown.doors] + [route.line for route in routes]
    for line in (*lines, site.walkable_floor.boundary):
        for spot in _spots(line, sheet):
            space.take(spot)
    for each in shown.landmarks:
        if not is_covering(each):
            space.take(_bounds(each.footprint.bounds))
    return [
        *_room_names(shown, space, names, sheet),
        *_place_names(shown.areas, site.corridors, space, names, sheet),
        *_thing_labels(shown, space, thing, sheet),
    ]


def _spots(line: BaseGeometry, sheet: Box) -> Iterator[Box]:
    """Return small boxes close together along what a sheet shows of a line."""
    west, south, east, north = sheet
    for x, y in get_coordinates(segmentize(line, LINE_STEP)).tolist():
        if west <= x <= east and south <= y <= north:
            yield x - LINE_HALF, y - LINE_HALF, x + LINE_HALF, y + LINE_HALF


def _room_names(
    shown: OnSheet, space: LabelSpace, sizes: Sequence[float], sheet: Box
) -> Iterator[PlanLabel]:
    for room in shown.rooms:
        texts, polygon = wrapped(room.name), _seen(room.polygon, sheet)
        label = space.inside(texts, [_inner_frame(polygon)], sizes)
        yield PlanLabel(label or _slanted_name(texts, polygon, space, sizes), "name")


def _seen(polygon: Polygon, sheet: Box) -> Polygon:
    """Return the largest piece that a sheet shows of a polygon."""
    paper = box(*sheet)
    if paper.covers(polygon):
        return polygon
    pieces = get_parts(polygon.intersection(paper)).tolist()
    return max(pieces, key=lambda piece: piece.area)


def _slanted_name(
    texts: Sequence[str], polygon: Polygon, space: LabelSpace, sizes: Sequence[float]
) -> PlacedLabel | None:
    """Write a name along the longer side of a room that stands aslant."""
    rectangle = polygon.minimum_rotated_rectangle
    if not isinstance(rectangle, Polygon):
        return None
    corners = get_coordinates(rectangle)
    sides = corners[1:3] - corners[:2]
    long, short = sorted(sides.tolist(), key=lambda side: -math.hypot(*side))
    angle = math.atan2(long[1], long[0])
    angle = (angle + math.pi / 2) % math.pi - math.pi / 2
    middle = (rectangle.centroid.x, rectangle.centroid.y)
    for size in sizes:
        for text in texts:
            length, height = space.extent(text, size)
            if length > 0.95 * math.hypot(*long) or height > 0.95 * math.hypot(*short):
                continue
            if label := space.along(text, [middle], angle, size):
                return label
    return None


def _place_names(
    areas: Sequence[Area],
    corridors: Sequence[Corridor],
    space: LabelSpace,
    sizes: Sequence[float],
    sheet: Box,
) -> Iterator[PlanLabel]:
    for area in areas:
        if area.name:
            frames = _frames_across(_seen(area.polygon, sheet))
            yield PlanLabel(space.inside(wrapped(area.name), frames, sizes), "way")
    for corridor in corridors:
        way = corridor.centre_line.intersection(box(*sheet))
        if corridor.name and isinstance(way, LineString) and way.length:
            label = _corridor_name(corridor.name, way, corridor.width, space, sizes)
            yield PlanLabel(label, "way")


def _corridor_name(
    name: str, way: LineString, wide: float, space: LabelSpace, sizes: Sequence[float]
) -> PlacedLabel | None:
    start, end = way.coords[0], way.coords[-1]
    angle = math.atan2(end[1] - start[1], end[0] - start[0])
    aside = wide / 4
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
    shown: OnSheet,
    space: LabelSpace,
    font_size: float,
    sheet: Box,
) -> Iterator[PlanLabel]:
    commonness = Counter(thing.category for thing in shown.landmarks)
    groups = sorted(
        _equal_neighbours(shown.landmarks),
        key=lambda group: (commonness[group[0].category], group[0].id),
    )
    for group in groups:
        thing = group[len(group) // 2]
        bounds = _bounds(thing.footprint.bounds)
        words = _thing_words(group)
        on_it = is_covering(thing) and space.inside([words], [bounds], [font_size])
        yield PlanLabel(on_it or space.beside(words, bounds, font_size, sheet), "word")
    names = {room.id: room.name for room in shown.rooms}
    for door in shown.doors:
        if door.label and door.label not in names.get(door.room or "", ""):
            line = _bounds(door.line.buffer(LINE_HALF).bounds)
            words = _broken(f"“{door.label}”")
            yield PlanLabel(space.beside(words, line, font_size, sheet), "sign")


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
