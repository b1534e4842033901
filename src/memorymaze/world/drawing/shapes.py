"""What a plan consists of: shapes in the order they are painted, and their colours.

The back ends paint them and nothing else: `axes` on matplotlib's axes, `svg` on pages.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from shapely import LineString, Polygon, box, get_coordinates

from memorymaze.world.sites.records import (
    Area,
    Door,
    Landmark,
    Room,
    Route,
    Site,
    TurningPoint,
)

Points = NDArray[np.float64]
"""Places in metres, shape (N, 2)."""
Bounds = tuple[float, float, float, float]
"""West, south, east, north; metres."""
_Kind = Literal[
    "room",
    "floor",
    "area",
    "open_air",
    "covering",
    "turning_point",
    "wall",
    "thing",
    "door",
    "overhead",
]


class Ink(NamedTuple):
    """The colours of a kind of shape or word."""

    paper: str
    """On sheets and films."""
    day: str
    """On pages, beneath walks."""
    night: str
    """On pages of readers who prefer the dark."""
    width: float = 0.0
    """Of lines, points on paper; a tenth of that in metres on pages."""


INKS: dict[str, Ink] = {
    "room": Ink("#ebebeb", "#edebe6", "#26282c", 0.6),
    "room_edge": Ink("#a8a8a8", "#c9c5bc", "#3b3e44"),
    "floor": Ink("#fffaf0", "#fffdf8", "#17191c"),
    "area": Ink("#fdf1d8", "#fcf6e8", "#201e19"),
    "open_air": Ink("#e3f1da", "#e6f0de", "#1b2a1d"),
    "turning_point": Ink("#6aa5de", "#dfe9f3", "#1d2b3a"),
    "wall": Ink("#2f2f2f", "#4a4a4a", "#a9abb0", 1.5),
    "thing": Ink("#4c8c4a", "#b9c7b3", "#435443", 0.8),
    "door": Ink("#000000", "#8a5a2b", "#c99b66", 2.8),
    "name": Ink("#444444", "#4d4a44", "#b9bbc0"),
    "way": Ink("#7a5c1e", "#6d5a2e", "#cdb67f"),
    "word": Ink("#1d5a2b", "#3d5a3a", "#9dbf97"),
    "sign": Ink("#6b3a10", "#6b4a1e", "#c9a57a"),
}
VARIETIES: dict[str, dict[str, str]] = {
    "room": {
        "exhibit": "#e7e0f1",
        "hall": "#e9e4da",
        "kitchen": "#f7e7d6",
        "library": "#e2ecd8",
        "restroom": "#dcebf3",
        "shop": "#f7e7d6",
        "stairwell": "#dedede",
    },
    "door": {
        "wood": "#9c5a1e",
        "glass": "#2f9fd8",
        "steel": "#6f7f8a",
        "automatic_glass": "#12b5b0",
        "elevator": "#7a4fb5",
        "fire": "#e03131",
    },
    "thing": {"floor": "#4c8c4a", "wall": "#0b7a75", "ceiling": "#8c8c8c"},
}
"""Colours on paper by use, style and mount, where they are not those of their kind."""
EXIT_COLOR = "#2f6fb0"
WALK_COLOR = "#111111"
THING_COLOR, PEOPLE_COLOR, FOUND_COLOR = "#c2185b", "#0b7285", "#7a4fb5"
"""Of what no plan has, and of what a robot detects."""
ARRIVED_COLOR, FAILED_COLOR = "#0b5d2a", "#8a1c1c"
"""Of words on how a walk ended."""
ROUTE_COLORS = ("#d7301f", "#1f5fbf", "#2a8a3e", "#8a3ea8", "#c77700")

FLAT = 0.05
"""Metres; what is no higher covers the floor."""
POST = 0.22
"""Of an open door's width, drawn at each side of the way through."""
SHARED_WAY = 1.0
"""Metres two routes have in common before they are drawn side by side."""
ROUTES_APART = 0.16
"""Metres between routes drawn side by side where they share a way."""


class PlanShape(NamedTuple):
    """Something to be painted: areas, or lines."""

    kind: _Kind
    variety: str = ""
    """A room's use, a door's style, a thing's mount."""
    polygons: Sequence[Polygon] = ()
    lines: Sequence[Points] = ()

    @property
    def paper(self) -> str:
        """Its colour on paper."""
        family = "thing" if self.kind in {"covering", "overhead"} else self.kind
        return VARIETIES.get(family, {}).get(self.variety, INKS[family].paper)

    def outlines(self) -> Iterator[Points]:
        """Return its lines, and the edges of its areas, holes too."""
        yield from self.lines
        for polygon in self.polygons:
            for ring in (polygon.exterior, *polygon.interiors):
                yield get_coordinates(ring)


def plan_shapes(site: Site) -> Iterator[PlanShape]:
    """Return all shapes of a plan, the lowest first."""
    for room in site.rooms:
        yield PlanShape("room", room.use, [room.polygon])
    yield PlanShape("floor", polygons=[site.walkable_floor])
    for area in site.areas:
        yield PlanShape(
            "open_air" if area.open_air else "area", polygons=[area.polygon]
        )
    flat = [thing.footprint for thing in site.landmarks if is_covering(thing)]
    yield PlanShape("covering", "floor", flat)
    places = [place.polygon for place in site.turning_points]
    yield PlanShape("turning_point", polygons=places)
    yield PlanShape("wall", polygons=[site.walkable_floor])
    for mount in ("floor", "wall"):
        standing = [
            thing.footprint
            for thing in site.landmarks
            if thing.mount == mount and not is_covering(thing)
        ]
        yield PlanShape("thing", mount, standing)
    for door in site.doors:
        start, end = get_coordinates(door.line)
        lines = [np.array([start, end])]
        if door.state == "open":
            post = POST * (end - start)
            lines = [np.array([start, start + post]), np.array([end - post, end])]
        yield PlanShape("door", door.style, lines=lines)
    above = [thing.footprint for thing in site.landmarks if thing.mount == "ceiling"]
    yield PlanShape("overhead", "ceiling", above)


def is_covering(thing: Landmark) -> bool:
    """Tell whether a thing is a covering of the floor, such as a carpet."""
    return thing.mount == "floor" and thing.size[2] <= FLAT


def plan_bounds(site: Site, margin: float) -> Bounds:
    """Return the bounds of floor and rooms, with some paper round."""
    rooms = (room.polygon.bounds for room in site.rooms)
    return bounds_of([site.walkable_floor.bounds, *rooms], margin)


def bounds_of(parts: Sequence[Sequence[float]], margin: float) -> Bounds:
    """Return what holds some bounds, with a margin."""
    table = np.array(parts, dtype=np.float64)
    west, south = (table[:, :2].min(axis=0) - margin).tolist()
    east, north = (table[:, 2:].max(axis=0) + margin).tolist()
    return west, south, east, north


class OnSheet(NamedTuple):
    """What a sheet shows something of, each whole: to be named on it and explained."""

    rooms: Sequence[Room]
    areas: Sequence[Area]
    turning_points: Sequence[TurningPoint]
    doors: Sequence[Door]
    landmarks: Sequence[Landmark]


def on_sheet(site: Site, sheet: Bounds) -> OnSheet:
    """Return what a sheet shows of a site, all of it or a part."""
    paper = box(*sheet)
    return OnSheet(
        [each for each in site.rooms if each.polygon.intersection(paper).area],
        [each for each in site.areas if each.polygon.intersection(paper).area],
        [each for each in site.turning_points if each.polygon.intersects(paper)],
        [each for each in site.doors if each.line.intersects(paper)],
        [each for each in site.landmarks if each.footprint.intersects(paper)],
    )


class ThingInTheWay(NamedTuple):
    """A thing that no plan has."""

    category: str
    x: float
    """Of its middle, metres."""
    y: float
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
    walks: Sequence[Points] = ()
    """Where each person was."""
    near_misses: Sequence[tuple[float, float]] = ()
    """Where the robot was when a person came too close, metres."""


def route_color(route: str) -> str:
    """Return the colour of routes of a name, such as `R1`."""
    digits = "".join(letter for letter in route if letter.isdecimal())
    return ROUTE_COLORS[(int(digits[:4]) - 1 if digits else 0) % len(ROUTE_COLORS)]


def side_by_side(routes: Sequence[Route]) -> list[LineString]:
    """Return the lines of routes, moved aside where they share a way with others."""
    groups: list[list[Route]] = []
    for route in routes:
        touching = [
            group
            for group in groups
            if any(_share_a_way(route, other) for other in group)
        ]
        rest = [group for group in groups if group not in touching]
        groups = [*rest, [*(each for group in touching for each in group), route]]
    moved: dict[str, LineString] = {}
    for group in groups:
        for place, route in enumerate(group):
            aside = (place - (len(group) - 1) / 2) * ROUTES_APART
            line = route.line.offset_curve(aside, join_style="mitre")
            moved[route.id] = (
                line
                if aside and isinstance(line, LineString) and not line.is_empty
                else route.line
            )
    return [moved[route.id] for route in routes]


def _share_a_way(route: Route, other: Route) -> bool:
    return route.line.intersection(other.line.buffer(0.1)).length > SHARED_WAY
