"""CaBot and HULOP map data: nodes, links, facilities, entrances and points of interest.

`MapData.geojson` of a CaBot site package, as HULOP's map service keeps it: a graph to
walk on, after the Japanese standard for pedestrian networks, without walls or rooms.
"""

import math
import re
from collections import Counter
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from shapely import LineString, Point

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.input_files import parse_json, read_text
from memorymaze.basics.wording import counted
from memorymaze.world.importing.found import FoundDoor, FoundThing
from memorymaze.world.importing.geojson_features import (
    SourceFeature,
    read_features,
    within_reach,
)
from memorymaze.world.importing.imported import (
    CentreLine,
    ImportedSite,
    ImportNotes,
    LocalFrame,
    chosen_floor,
    imported_building,
)
from memorymaze.world.importing.placing import place_found
from memorymaze.world.importing.ways import plan_floor
from memorymaze.world.sites.things import kind_of_thing

ROAD_WIDTH = 1.5
"""Metres of a link that has no width, as CaBot takes them."""
WIDTHS = (0.9, 10.0)
"""Metres between which a width is believed."""
ELEVATOR, ESCALATOR, STAIRS = 4, 5, 6
"""Route types of links that lead to other floors."""
DOOR_LINK = 3.0
"""Metres of a leaf link, at most, that leads through a door and is no way."""
DOOR_REACH = 3.0
"""Metres from the place of an entrance to its wall."""
DOOR, CAB = "_nav_door_", "_nav_elevator_cab_"
"""Points of interest that are doors and elevators."""
IDENTITIES = ("node_id", "link_id", "facil_id")
ENTRANCE = re.compile(r"ent\d+_node")
CAB_DOOR = (1.0, 0.0)
"""Metres ahead and to the left from the middle of an elevator's cab to its door."""
NAMES = ("name_en", "name", "name_ja")


@dataclass(frozen=True)
class _Node:
    place: XY
    floor: float


@dataclass(frozen=True)
class _Link:
    start: str
    end: str
    width: float
    name: str | None


@dataclass(frozen=True)
class _PointOfInterest:
    feature: SourceFeature
    place: XY
    category: str

    @property
    def is_automatic(self) -> bool:
        return "_flag_auto_" in (self.feature.text("hulop_minor_category") or "")

    def moved(self, ahead: float, left: float) -> XY:
        """Return a place seen from this one, whose heading is clockwise from north."""
        heading = math.radians(90 - (self.feature.number("hulop_heading") or 0.0))
        return Pose(*self.place, heading).at(ahead, left)


def import_cabot(path: Path, floor: str | None = None) -> ImportedSite:
    """Return one floor of CaBot's or HULOP's map data as a building.

    Links become corridors as wide as they say, entrances of facilities and elevators doors,
    points of interest things where their names are those of things.
    """
    notes = ImportNotes()
    features = read_features(read_text(path, ImportFileError), str(path), notes)
    places = [
        (feature.geometry.x, feature.geometry.y)
        for feature in features
        if feature.text("node_id") and isinstance(feature.geometry, Point)
    ]
    if not places:
        raise ImportFileError(
            f'{path}: expected nodes, points with a "node_id", got none; is it the '
            "MapData.geojson of a CaBot site package?"
        )
    frame = LocalFrame.around(places)
    features = within_reach(features, frame, notes)
    for feature in features:
        if not any(feature.text(name) for name in IDENTITIES):
            notes.miss("features that are no node, link or facility", feature.id)
    nodes = _nodes(features, frame, notes)
    floors = {
        level: _floor_name(level) for level in sorted({n.floor for n in nodes.values()})
    }
    level = chosen_floor(floors, floor, str(path))
    links, upwards = _links(features, nodes, level, notes)
    points = list(_points_of_interest(features, frame, floors, level, notes))
    entrances = _entrances(features, nodes, level, frame, points, notes)
    doors = [*entrances, *_ways_up(points, nodes, upwards, notes)]
    degrees = Counter(end for link in links for end in (link.start, link.end))
    behind = {end for end in (*entrances.values(), *upwards) if degrees[end] == 1}
    lines = [
        CentreLine(ends, link.width, link.name)
        for link in links
        for ends in [(nodes[link.start].place, nodes[link.end].place)]
        if math.dist(*ends) > DOOR_LINK or not behind & {link.start, link.end}
    ]
    notes.took.append(f"floor {floors[level]}: {counted(len(links), 'link')}")
    try:
        planned = plan_floor(lines, notes)
    except ImportFileError as error:
        raise ImportFileError(f"{path}: floor {floors[level]}: {error}") from None
    things = list(_things(points, notes))
    placed = place_found(planned, (), doors, things, notes)
    notes.missing.append("walls and rooms: floor is as wide as the links say")
    buildings = Counter(
        filter(None, (each.text("hulop_building") for each in features))
    )
    title = max(buildings, key=lambda each: buildings[each], default=None)
    parts = [*planned.parts, *placed]
    return notes.imported(
        imported_building(path, title, floors[level], frame.anchor, parts)
    )


def _nodes(
    features: Sequence[SourceFeature], frame: LocalFrame, notes: ImportNotes
) -> dict[str, _Node]:
    """Return all nodes by id."""
    found: dict[str, _Node] = {}
    for feature in features:
        identity = feature.text("node_id")
        if identity is None:
            continue
        level = feature.number("floor") if "floor" in feature.properties else 0.0
        if not isinstance(feature.geometry, Point) or level is None:
            notes.miss("nodes without a place or a floor", identity)
        elif identity in found:
            notes.miss("nodes that are in the file twice", identity)
        else:
            place = frame.metres(feature.geometry.x, feature.geometry.y)
            found[identity] = _Node(place, level)
    return found


def _floor_name(level: float) -> str:
    return f"B{-level:g}F" if level < 0 else f"{level:g}F"


def _links(
    features: Sequence[SourceFeature],
    nodes: Mapping[str, _Node],
    level: float,
    notes: ImportNotes,
) -> tuple[list[_Link], dict[str, float]]:
    """Return the links of a floor, and its nodes that lead to others by route type."""
    found: list[_Link] = []
    upwards: dict[str, float] = {}
    unsaid = 0
    for feature in features:
        identity = feature.text("link_id")
        if identity is None:
            continue
        ends = [feature.text("start_id") or "", feature.text("end_id") or ""]
        if not all(end in nodes for end in ends) or ends[0] == ends[1]:
            notes.miss("links that do not join two nodes of the file", identity)
            continue
        here = [end for end in ends if nodes[end].floor == level]
        kind = feature.number("route_type") or 1.0
        if kind in (ELEVATOR, ESCALATOR, STAIRS) or len(here) == 1:
            upwards |= dict.fromkeys(here, kind)
            continue
        if not here:
            continue
        width = feature.number("hulop_road_width")
        if width is not None and not WIDTHS[0] <= width <= WIDTHS[1]:
            notes.guess(f"widths of links out of {WIDTHS}: {ROAD_WIDTH} m", identity)
            width = ROAD_WIDTH
        unsaid += width is None
        name = feature.text("st_name_en", "st_name", "st_name_ja")
        found.append(_Link(ends[0], ends[1], width or ROAD_WIDTH, name))
    if unsaid:
        notes.guessed.append(f"widths of {counted(unsaid, 'link')}: {ROAD_WIDTH} m")
    return found, upwards


def _points_of_interest(
    features: Sequence[SourceFeature],
    frame: LocalFrame,
    floors: Container[float],
    level: float,
    notes: ImportNotes,
) -> Iterator[_PointOfInterest]:
    """Yield the points of interest of a floor."""
    for feature in features:
        if feature.text("hulop_major_category") != "_nav_poi_":
            continue
        height = feature.number("hulop_height") or 0.0
        if not isinstance(feature.geometry, Point):
            notes.miss("points of interest without a place", feature.id)
        elif height not in floors:
            notes.miss("points of interest on no floor of the file", feature.id)
        elif height == level:
            yield _PointOfInterest(
                feature,
                frame.metres(feature.geometry.x, feature.geometry.y),
                feature.text("hulop_sub_category") or "",
            )


def _entrances(
    features: Sequence[SourceFeature],
    nodes: Mapping[str, _Node],
    level: float,
    frame: LocalFrame,
    points: Sequence[_PointOfInterest],
    notes: ImportNotes,
) -> dict[FoundDoor, str]:
    """Return the doors of facilities with the nodes they are at."""
    marked = [point for point in points if point.category == DOOR]
    found: dict[FoundDoor, str] = {}
    used: set[str] = set()
    for feature in features:
        identity = feature.text("facil_id")
        if identity is None or feature.text("hulop_major_category") == "_nav_poi_":
            continue
        entrances = [name for name in feature.properties if ENTRANCE.fullmatch(name)]
        if not entrances:
            notes.miss("facilities without an entrance", identity)
        for name in entrances:
            node = feature.text(name) or ""
            if node not in nodes:
                notes.miss("entrances at nodes that are not in the file", identity)
                continue
            if nodes[node].floor != level:
                continue
            place = nodes[node].place
            if isinstance(feature.geometry, Point):
                place = _towards(place, frame.placed(feature.geometry))
            near = [each for each in marked if math.dist(each.place, place) < DOOR_LINK]
            used |= {each.feature.id for each in near}
            stem = name.removesuffix("_node")
            words = (feature.text(*NAMES), feature.text(f"{stem}_n_en", f"{stem}_n"))
            label = ", ".join(filter(None, words)) or None
            kind = "automatic" if any(each.is_automatic for each in near) else "wood"
            door = FoundDoor(f"{identity} {stem}", place, kind, label, reach=DOOR_REACH)
            found[door] = node
    for point in marked:
        if point.feature.id not in used:
            notes.miss("doors across a way, which plans do not have", point.feature.id)
    return found


def _towards(node: XY, facility: Point) -> XY:
    """Return the place of an entrance: on the side of its node where the facility is."""
    line = LineString([node, (facility.x, facility.y)])
    place = line.interpolate(min(line.length, ROAD_WIDTH))
    return (place.x, place.y)


def _ways_up(
    points: Sequence[_PointOfInterest],
    nodes: Mapping[str, _Node],
    upwards: Mapping[str, float],
    notes: ImportNotes,
) -> Iterator[FoundDoor]:
    """Yield the doors of elevators and stairs."""
    cabs: list[XY] = []
    for point in points:
        if point.category == CAB:
            cabs.append(point.place)
            door = point.moved(*_cab_door(point.feature, notes))
            name = point.feature.text(*NAMES)
            yield FoundDoor(point.feature.id, door, "elevator", name, reach=DOOR_REACH)
    for node, kind in upwards.items():
        place = nodes[node].place
        if kind == ELEVATOR and all(math.dist(cab, place) > DOOR_LINK for cab in cabs):
            yield FoundDoor(node, place, "elevator", reach=DOOR_REACH)
        elif kind == STAIRS:
            notes.guess("doors of stairs", node)
            yield FoundDoor(node, place, "fire", "Stairs", reach=DOOR_REACH)
        elif kind != ELEVATOR:
            notes.miss("ways to other floors", node)


def _cab_door(feature: SourceFeature, notes: ImportNotes) -> tuple[float, float]:
    """Return where a cab says its door is, ahead and to the left of its middle."""
    try:
        content = parse_json(feature.text("hulop_content") or "{}")
        ahead, left = content.get("door", CAB_DOOR)
        if math.hypot(ahead, left) < DOOR_REACH:
            return float(ahead), float(left)
    except (ValueError, TypeError, AttributeError):
        pass
    notes.guess(
        f"doors of elevators: {CAB_DOOR[0]} m before the cab's middle", feature.id
    )
    return CAB_DOOR


def _things(
    points: Sequence[_PointOfInterest], notes: ImportNotes
) -> Iterator[FoundThing]:
    """Yield the points of interest that are things with a look of their own."""
    for point in points:
        name = point.feature.text(*NAMES)
        if point.category in (DOOR, CAB):
            continue
        if name and kind_of_thing(name.lower()) is not None:
            yield FoundThing(point.feature.id, point.place, name.lower())
        elif point.category == "_nav_obstacle_":
            notes.guess(
                "obstacles without a name of a thing: pillars", point.feature.id
            )
            yield FoundThing(point.feature.id, point.place, "pillar")
        else:
            what = point.category or "no category"
            notes.miss(
                f"points of interest that are no things: {what}", point.feature.id
            )
