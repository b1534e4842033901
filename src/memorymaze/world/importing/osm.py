"""OpenStreetMap indoor data: Simple Indoor Tagging, as .osm XML or Overpass JSON.

`indoor=corridor|area|room|wall|column|door` with `level` or `repeat_on`, doors and
entrances as nodes, footways as lines, and what stands about as nodes.
"""

import re
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import shapely
from shapely import LineString, MultiPoint, Point, Polygon
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, moved
from memorymaze.basics.wording import counted
from memorymaze.world.importing.found import FoundDoor, FoundRoom, FoundThing
from memorymaze.world.importing.imported import (
    FAR,
    CentreLine,
    ImportedSite,
    ImportNotes,
    LocalFrame,
    chosen_floor,
    imported_building,
)
from memorymaze.world.importing.osm_elements import Element, read_elements
from memorymaze.world.importing.outlines import Outlines, plan_outlines
from memorymaze.world.importing.shapes import polygons
from memorymaze.world.importing.ways import OpenArea

FOOTWAY_WIDTH = 2.0
"""Metres of a way that has neither an outline nor a width."""
WIDTHS = (0.9, 10.0)
"""Metres between which a width is believed."""
WALKED = ("corridor", "footway", "path", "pedestrian")
"""Values of `highway` for ways that one walks, indoors."""
WALKED_ROOMS = ("corridor", "entrance", "hallway", "lobby")
"""Values of `room` that are floor, though they are drawn as rooms."""
ROOMS = ("area", "corridor", "room")
"""Values of `indoor` whose doors are other elements."""
DOOR_KINDS = {"glass": "glass", "metal": "steel", "steel": "steel"}
DOOR_REACH = 2.0
"""Metres from a door to its wall, as elevators are often nodes on a way."""
WIDTH = re.compile(r"\s*([0-9]+(?:[.,][0-9]+)?)\s*(m|cm)?\s*")
ROOM_USES = {
    "amphitheatre": "hall", "auditorium": "hall", "bathroom": "restroom",
    "class": "classroom", "classroom": "classroom", "conference": "conference_room",
    "elevator": "stairwell", "kitchen": "kitchen", "laboratory": "lab",
    "lecture": "classroom", "library": "library", "meeting": "conference_room",
    "office": "office", "restroom": "restroom", "shop": "shop", "stairs": "stairwell",
    "storage": "storage", "technical": "storage", "toilet": "restroom",
    "toilets": "restroom", "cafe": "kitchen", "restaurant": "kitchen",
}  # fmt: skip
"""Uses of rooms by values of `room` and `amenity`."""
THINGS = {
    "advertising=board": "poster", "advertising=poster_box": "poster",
    "amenity=atm": "cash machine", "amenity=bench": "bench", "amenity=clock": "clock",
    "amenity=drinking_water": "drinking fountain", "amenity=locker": "lockers",
    "amenity=luggage_locker": "coin lockers", "amenity=lounger": "armchair",
    "amenity=piano": "piano", "amenity=post_box": "mailboxes",
    "amenity=recycling": "recycling bin", "amenity=table": "table",
    "amenity=telephone": "information kiosk", "amenity=vending_machine": "vending machine",
    "amenity=waste_basket": "trash can", "amenity=waste_disposal": "trash can",
    "amenity=water_point": "water cooler", "emergency=defibrillator": "AED",
    "emergency=fire_extinguisher": "fire extinguisher", "emergency=fire_hose": "fire hydrant box",
    "indoor=column": "pillar", "information=board": "notice board",
    "information=map": "floor map", "information=office": "information desk",
    "information=tactile_map": "floor map", "information=terminal": "information kiosk",
    "artwork_type=bust": "bust", "artwork_type=installation": "sculpture",
    "artwork_type=mural": "mural", "artwork_type=painting": "painting",
    "artwork_type=sculpture": "sculpture", "artwork_type=statue": "statue",
    "tourism=artwork": "sculpture", "amenity=reception_desk": "reception desk",
    "natural=plant": "potted plant", "natural=tree": "potted plant",
    "barrier=turnstile": "ticket machine", "vending=public_transport_tickets": "ticket machine",
}  # fmt: skip
"""Things by their tags."""


def import_osm(path: Path, floor: str | None = None) -> ImportedSite:
    """Return one level of OpenStreetMap indoor data as a building.

    Corridors and areas become floor, rooms rooms, doors and entrances doors, what stands
    about things; footways beside corridors' outlines become corridors of a guessed width.
    """
    notes = ImportNotes()
    elements = read_elements(path, notes)
    indoor = [element for element in elements.values() if _is_indoor(element)]
    if not indoor:
        raise ImportFileError(
            f"{path}: expected Simple Indoor Tagging (indoor=corridor, area, room), got "
            "none"
        )
    outside = sum(bool(each.tags) for each in elements.values()) - len(indoor)
    if outside:
        notes.missing.append(f"{counted(outside, 'element')} with tags, not indoors")
    levels = {level for element in indoor for level in element.levels()}
    if not levels:
        notes.guessed.append("the level: 0, as no element has one")
        levels = {0.0}
    names = {level: f"{level:g}" for level in sorted(levels)}
    chosen = chosen_floor(names, floor, str(path))
    places = [place for element in indoor for place in _places(element, elements)]
    if not places:
        raise ImportFileError(f"{path}: expected nodes with places, got none")
    building = _Building(elements, LocalFrame.around(places), notes)
    for element in indoor:
        found = element.levels() or building.levels_around(element)
        if chosen in (found or ({0.0} if levels == {0.0} else set())):
            building.draw(element)
        elif not found:
            notes.miss("indoor elements without a level", element.id)
    try:
        parts = plan_outlines(building.outlines(), notes)
    except ImportFileError as error:
        raise ImportFileError(f"{path}: level {names[chosen]}: {error}") from None
    title = next(
        (
            element.tags["name"]
            for element in elements.values()
            if "building" in element.tags and element.tags.get("name", "").strip()
        ),
        None,
    )
    anchor = building.frame.anchor
    return notes.imported(
        imported_building(path, title, f"level {names[chosen]}", anchor, parts)
    )


def _is_indoor(element: Element) -> bool:
    tags = element.tags
    return "building" not in tags and any(
        name in tags for name in ("indoor", "level", "repeat_on", "door", "entrance")
    )


def _places(element: Element, elements: Mapping[str, Element]) -> list[XY]:
    """Return longitudes and latitudes of an element's nodes that are in the file."""
    if element.place is not None:
        return [element.place]
    return [
        place
        for member, _ in element.members
        if member in elements
        for place in _places(elements[member], elements)
    ]


def _metres(text: str | None) -> float | None:
    """Return a width as tags have it; None for what is not one."""
    match = WIDTH.fullmatch(text or "")
    if not match:
        return None
    metres = float(match[1].replace(",", ".")) / (100 if match[2] == "cm" else 1)
    return metres if 0 < metres < WIDTHS[1] else None


class _Building:
    """The elements of one level, drawn in metres one by one."""

    def __init__(
        self, elements: Mapping[str, Element], frame: LocalFrame, notes: ImportNotes
    ) -> None:
        self.frame = frame
        self._elements = elements
        self._notes = notes
        self._drawn = Outlines()
        self._signs: list[tuple[str, Point, str]] = []
        self._ways: dict[str, list[Element]] = defaultdict(list)
        for element in elements.values():
            if element.id.startswith("way/"):
                for node in {member for member, _ in element.members}:
                    self._ways[node].append(element)

    def levels_around(self, element: Element) -> set[float]:
        """Return the levels of the ways that a node is part of."""
        return {level for way in self._ways[element.id] for level in way.levels()}

    def outlines(self) -> Outlines:
        """Return all that was drawn; nodes with a name name the rooms around them."""
        rooms = list(self._drawn.rooms)
        for node, spot, name in self._signs:
            for index, room in enumerate(rooms):
                if not room.name and room.polygon.covers(spot):
                    rooms[index] = replace(room, name=name)
                    break
            else:
                self._notes.miss("named nodes in no room that lacks a name", node)
        return replace(self._drawn, rooms=rooms)

    def draw(self, element: Element) -> None:
        """Draw an element of the level, or tell why not."""
        if not self.frame.reaches(_places(element, self._elements)):
            self._notes.miss(f"elements {FAR}", element.id)
            return
        if element.place is not None:
            self._draw_node(element, self.frame.metres(*element.place))
            return
        tags = element.tags
        indoor = tags.get("indoor", "")
        name = tags.get("name") or tags.get("ref")
        walked = indoor == "corridor" or tags.get("highway") in WALKED
        parts = self._polygons(element)
        if parts is None:
            self._notes.miss("ways and relations with broken outlines", element.id)
        elif not parts and walked:
            self._draw_line(element, name)
        elif indoor == "door" or (indoor not in ROOMS and tags.get("door")):
            self._draw_door(element, self._middle(element))
        elif not parts:
            what = (
                f"highway={tags['highway']}"
                if "highway" in tags
                else f"indoor={indoor}"
            )
            self._notes.miss(f"lines that are no ways to walk: {what}", element.id)
        elif walked or (indoor == "room" and tags.get("room") in WALKED_ROOMS):
            self._drawn.floor += [(part, name) for part in parts]
        elif indoor == "area":
            open_air = tags.get("covered") == "no"
            self._drawn.areas += [OpenArea(part, name, open_air) for part in parts]
        elif indoor == "room":
            self._drawn.rooms += [
                FoundRoom(element.id, part, name, _use(tags)) for part in parts
            ]
        elif indoor in ("column", "wall"):
            self._drawn.blocks += parts
        else:
            self._notes.miss(f"outlines that are no floor: indoor={indoor}", element.id)

    def _draw_node(self, node: Element, place: XY) -> None:
        tags = node.tags
        name = tags.get("name") or None
        is_door = tags.get("indoor") == "door" or "door" in tags or "entrance" in tags
        category = next(
            (thing for tag, thing in THINGS.items() if tag in _tag_texts(tags)), None
        )
        if is_door or tags.get("highway") == "elevator":
            self._draw_door(node, place)
        elif category is not None:
            self._drawn.things.append(FoundThing(node.id, place, category, name))
        elif name:
            self._signs.append((node.id, Point(place), name))
        else:
            what = ", ".join(sorted(_tag_texts(tags) - {f"level={tags.get('level')}"}))
            self._notes.miss(f"nodes that are no things: {what}", node.id)

    def _draw_line(self, way: Element, name: str | None) -> None:
        places = [self.frame.metres(*place) for place in _places(way, self._elements)]
        width = _metres(way.tags.get("width"))
        if width is None or not WIDTHS[0] <= width:
            self._notes.guess(f"widths of ways: {FOOTWAY_WIDTH} m", way.id)
            width = FOOTWAY_WIDTH
        self._drawn.lines.append(CentreLine(tuple(places), width, name))

    def _draw_door(self, element: Element, place: XY) -> None:
        tags = element.tags
        ways = self._ways[element.id]
        around = [tags, *(way.tags for way in ways)]
        if any(
            "elevator" in (each.get("highway"), each.get("room")) for each in around
        ):
            kind = "elevator"
        elif tags.get("automatic_door", "no") != "no":
            kind = "automatic"
        elif tags.get("entrance") == "emergency":
            kind = "fire"
        else:
            kind = DOOR_KINDS.get(tags.get("material", ""), "wood")
        found = FoundDoor(
            element.id,
            place,
            kind,
            tags.get("name") or tags.get("ref") or None,
            _metres(tags.get("door:width") or tags.get("width")),
            tags.get("door") == "no",
            DOOR_REACH,
        )
        self._drawn.doors.append((
            found,
            self._wall_at(element, ways, found.width or 1.0),
        ))

    def _wall_at(
        self, node: Element, ways: list[Element], width: float
    ) -> LineString | None:
        """Return a piece as long as a door of the wall that a node is part of."""
        for way in ways:
            nodes = [member for member, _ in way.members]
            if not way.is_closed or any(each not in self._elements for each in nodes):
                continue
            line = self._line(way)
            at = Point(self.frame.metres(*(node.place or (0.0, 0.0))))
            along = line.project(at)
            ends = [line.interpolate(max(along + step, 0)) for step in (-0.01, 0.01)]
            if ends[0].distance(ends[1]) > 0:
                heading = heading_to((ends[0].x, ends[0].y), (ends[1].x, ends[1].y))
                middle = (at.x, at.y)
                return LineString([
                    moved(middle, heading, -width / 2), moved(middle, heading, width / 2)
                ])  # fmt: skip
        return None

    def _line(self, way: Element) -> LineString:
        return LineString([
            self.frame.metres(*place) for place in _places(way, self._elements)
        ])

    def _middle(self, element: Element) -> XY:
        places = [self.frame.metres(*each) for each in _places(element, self._elements)]
        middle = MultiPoint(places).centroid
        return (middle.x, middle.y)

    def _polygons(self, element: Element) -> list[Polygon] | None:
        """Return what an element encloses: nothing for an open line, None if broken."""
        if element.id.startswith("way/"):
            if not self._is_whole(element):
                return None
            closed = element.is_closed and element.tags.get("area") != "no"
            outline = Polygon(self._line(element)) if closed else None
            return polygons(outline) or None if outline is not None else []
        rings: dict[str, list[LineString]] = {"outer": [], "inner": []}
        for member, role in element.members:
            way = self._elements.get(member)
            if way is None or not self._is_whole(way):
                return None
            rings.setdefault(role or "outer", []).append(self._line(way))
        enclosed: list[BaseGeometry] = []
        for role in ("outer", "inner"):
            found, *beside = shapely.polygonize_full(rings[role])
            if not all(each.is_empty for each in beside):
                return None
            enclosed.append(shapely.union_all(shapely.get_parts(found)))
        outer, inner = enclosed
        return polygons(outer.difference(inner)) or None

    def _is_whole(self, way: Element) -> bool:
        """Tell whether all nodes of a way are in the file."""
        whole = all(member in self._elements for member, _ in way.members)
        return whole and len(_places(way, self._elements)) >= 2


def _tag_texts(tags: Mapping[str, str]) -> set[str]:
    return {f"{name}={value}" for name, value in tags.items()}


def _use(tags: Mapping[str, str]) -> str | None:
    """Return the word of plans for the use of a room."""
    for name in ("room", "amenity", "office", "shop", "tourism", "highway"):
        value = tags.get(name)
        if value in ROOM_USES:
            return ROOM_USES[value]
        if value and name in ("office", "shop"):
            return name
    return "stairwell" if tags.get("stairs") == "yes" else None
