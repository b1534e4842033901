"""Buildings that others drew as outlines: floor, rooms and doors made into a plan."""

from dataclasses import dataclass, field, replace

import shapely
from shapely import LineString, MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.wording import counted
from memorymaze.world.importing.centre_lines import centre_lines
from memorymaze.world.importing.found import FoundDoor, FoundRoom, FoundThing
from memorymaze.world.importing.imported import CentreLine, ImportNotes
from memorymaze.world.importing.placing import place_found
from memorymaze.world.importing.shapes import polygons
from memorymaze.world.importing.ways import OpenArea, plan_floor, widened
from memorymaze.world.sites.records import PlanPart

WALL = 0.4
"""Metres by which a wall is thick at most that a passage leads through."""


@dataclass
class Outlines:
    """What was drawn of one floor, in metres."""

    floor: list[tuple[Polygon, str | None]] = field(
        default_factory=list[tuple[Polygon, str | None]]
    )
    """Corridors and the like, with their names."""
    lines: list[CentreLine] = field(default_factory=list[CentreLine])
    """Ways that have no outline."""
    areas: list[OpenArea] = field(default_factory=list[OpenArea])
    blocks: list[Polygon] = field(default_factory=list[Polygon])
    """Pillars and walls that stand on the floor."""
    rooms: list[FoundRoom] = field(default_factory=list[FoundRoom])
    doors: list[tuple[FoundDoor, LineString | None]] = field(
        default_factory=list[tuple[FoundDoor, LineString | None]]
    )
    """With their lines where they are known, as a door can be a passage."""
    things: list[FoundThing] = field(default_factory=list[FoundThing])


def plan_outlines(drawn: Outlines, notes: ImportNotes) -> list[PlanPart]:
    """Return the parts of a building; doors between pieces of floor become passages."""
    notes.took.append(
        f"outlines of {counted(len(drawn.floor), 'corridor')}, "
        f"{counted(len(drawn.areas), 'open area')} and "
        f"{counted(len(drawn.rooms), 'room')}, {counted(len(drawn.lines), 'line')} of ways, "
        f"{counted(len(drawn.doors), 'door')}"
    )
    blocks = shapely.union_all(drawn.blocks)
    outlined = shapely.union_all([
        *(part for part, _ in drawn.floor),
        *widened(drawn.lines),
    ])
    open_floor = shapely.union_all([area.polygon for area in drawn.areas])
    whole = shapely.union_all([outlined, open_floor])
    passages: list[Polygon] = []
    doors: list[FoundDoor] = []
    for door, line in drawn.doors:
        if line is not None and _is_passage(line, whole):
            notes.guess("doors between two pieces of floor, made passages", door.source)
            passages.append(line.buffer(WALL, cap_style="flat"))
        else:
            doors.append(door)
    corridors = shapely.union_all([outlined, *passages]).difference(blocks)
    floor = MultiPolygon(polygons(corridors))
    areas = [
        OpenArea(part, area.name, area.open_air)
        for area in drawn.areas
        for part in polygons(area.polygon.difference(blocks))
    ]
    lines = centre_lines(floor) if not floor.is_empty else []
    lines = [replace(line, name=_name_along(line, drawn)) for line in lines]
    planned = plan_floor(lines, notes, floor, areas)
    placed = place_found(planned, drawn.rooms, doors, drawn.things, notes)
    return [*planned.parts, *placed]


def _is_passage(line: LineString, floor: BaseGeometry) -> bool:
    """Tell whether there is floor on both sides of a door."""
    sides = (line.offset_curve(side) for side in (-WALL, WALL))
    return all(floor.intersects(side.centroid) for side in sides)


def _name_along(line: CentreLine, drawn: Outlines) -> str | None:
    """Return the name of what was drawn where a line is."""
    middle = LineString(line.points).interpolate(0.5, normalized=True)
    ways = [
        (LineString(way.points).buffer(way.width / 2), way.name) for way in drawn.lines
    ]
    for outline, name in (*drawn.floor, *ways):
        if name and outline.covers(middle):
            return name
    return None
