"""Rooms, doors and things brought onto a floor as the rules of plans ask.

Rooms lie beside it, doors in its walls, things before or on them. What cannot is left
out, and each that is moved or left out is told.
"""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString, Point, Polygon, STRtree
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, moved
from memorymaze.basics.wording import counted
from memorymaze.world.importing.found import FoundDoor, FoundRoom, FoundThing
from memorymaze.world.importing.imported import ImportNotes
from memorymaze.world.importing.shapes import HAIR, polygons
from memorymaze.world.importing.ways import PlannedFloor
from memorymaze.world.sites.floor_rules import DOOR_WIDTHS, ROOM_OFF_DOOR, ROOM_ON_FLOOR
from memorymaze.world.sites.records import Door, Landmark, PlanPart, Room, rectangle
from memorymaze.world.sites.things import ThingKind, door_kinds, kind_of_thing

BESIDE = 1.0
"""Metres at most between the floor and a room beside it, a thing and its wall."""
SMALLEST_ROOM = 0.5
"""Square metres."""
JAMB = 0.05
"""Metres of wall at least beside a door."""
FARTHEST_UNTOLD = 0.3
"""Metres by which walls are thick; what is moved farther is told."""
PASSAGE = 0.5
"""Metres on both sides of the middle of a way that obstacles leave free."""
AROUND = 6.0
"""Metres around an obstacle within which it can block a way."""


@dataclass(frozen=True)
class _WallNearby:
    """A straight piece of the floor's boundary; the floor lies to its left."""

    line: LineString
    gap: float
    """Metres from the place that was asked for."""
    along: float
    """Metres from its start to what is nearest to that place."""

    @property
    def start(self) -> XY:
        x, y = self.line.coords[0]
        return (x, y)

    @property
    def heading(self) -> float:
        x, y = self.line.coords[-1]
        return heading_to(self.start, (x, y))

    @property
    def inward(self) -> float:
        """The heading from the wall onto the floor."""
        return self.heading + math.pi / 2

    def fitted(self, half: float) -> float:
        """Return the place along it nearest to `along` with so much wall on both sides."""
        return min(max(self.along, half), self.line.length - half)


def place_found(
    floor: PlannedFloor,
    rooms: Sequence[FoundRoom],
    doors: Sequence[FoundDoor],
    things: Sequence[FoundThing],
    notes: ImportNotes,
) -> list[PlanPart]:
    """Return rooms, doors and things on and beside a floor."""
    placer = _Placer(floor.polygon, notes)
    placed = [
        (list(placer.rooms(rooms)), "room"),
        (list(placer.doors(doors)), "door"),
        (list(placer.things(things)), "thing"),
    ]
    notes.took.append(", ".join(counted(len(each), what) for each, what in placed))
    notes.guess_looks()
    return [part for each, _ in placed for part in each]


class _Placer:
    """Walls of a floor, and what stands at them so far."""

    def __init__(self, floor: Polygon, notes: ImportNotes) -> None:
        self._floor = floor
        self._notes = notes
        rings = shapely.get_rings(shapely.orient_polygons(floor))
        self._walls = STRtree([
            LineString(pair)
            for ring in rings
            for pair in np.stack([ring.coords[:-1], ring.coords[1:]], axis=1)
        ])
        self._rooms: list[tuple[str, FoundRoom, Polygon]] = []
        self._doors: list[LineString] = []
        self._obstacles: list[Polygon] = []

    def rooms(self, found: Sequence[FoundRoom]) -> Iterator[Room]:
        """Yield the rooms that lie beside the floor, without what they cover of it."""
        for room in found:
            beside = polygons(room.polygon.difference(self._floor))
            covered = room.polygon.area - sum(part.area for part in beside)
            if not beside or beside[0].area < max(SMALLEST_ROOM, room.polygon.area / 2):
                self._notes.miss("rooms that are mostly walkable floor", room.source)
                continue
            if self._floor.distance(beside[0]) > BESIDE:
                self._notes.miss("rooms that do not lie beside the floor", room.source)
                continue
            if covered > ROOM_ON_FLOOR:
                self._notes.guess("rooms cut where they covered floor", room.source)
            if room.use is None:
                self._notes.guess("uses of rooms: office", room.source)
            identity = f"room_{len(self._rooms) + 1}"
            self._rooms.append((identity, room, beside[0]))
            yield Room(
                identity,
                beside[0],
                room.name or "",
                room.use or "office",
                more={"source": room.source},
            )

    def doors(self, found: Sequence[FoundDoor]) -> Iterator[Door]:
        """Yield the doors, each in the nearest wall that is long enough."""
        for door in found:
            kind = door_kinds()[door.kind]
            wanted = min(max(door.width or kind.width, DOOR_WIDTHS[0]), DOOR_WIDTHS[1])
            walls = self._walls_near(door.place, door.reach, DOOR_WIDTHS[0] + 2 * JAMB)
            if not walls:
                self._notes.miss("doors with no wall near them", door.source)
                continue
            wall = walls[0]
            half = min(wanted, wall.line.length - 2 * JAMB) / 2
            middle = wall.fitted(half + JAMB)
            ends = [
                moved(wall.start, wall.heading, middle + side) for side in (-half, half)
            ]
            line = LineString(ends)
            if any(other.distance(line) == 0 for other in self._doors):
                self._notes.miss("doors where another door is", door.source)
                continue
            self._tell_width(door, line.length)
            if line.centroid.distance(Point(door.place)) > FARTHEST_UNTOLD:
                self._notes.guess("doors moved onto a wall", door.source)
            self._doors.append(line)
            behind = moved(
                moved(wall.start, wall.heading, middle), wall.inward, -ROOM_OFF_DOOR / 2
            )
            room, name = self._room_behind(line, Point(behind))
            yield Door(
                f"door_{len(self._doors)}",
                line,
                room,
                kind.style,
                kind.colors[0],
                door.label or name,
                "open" if door.is_open else "closed",
                more={"source": door.source},
            )

    def _tell_width(self, door: FoundDoor, width: float) -> None:
        if door.width is None:
            self._notes.guess("widths of doors", door.source)
        elif abs(width - door.width) > HAIR:
            least, most = DOOR_WIDTHS
            self._notes.guess(
                f"widths of doors: {least} to {most} m, and no wider than their wall",
                door.source,
            )

    def things(self, found: Sequence[FoundThing]) -> Iterator[Landmark]:
        """Yield the things, those near a wall with their back to it."""
        counts: dict[str, int] = {}
        for thing in found:
            kind = kind_of_thing(thing.category)
            if kind is None:
                self._notes.miss("things of no known kind", thing.source)
                continue
            place, heading = self._stand(thing, kind)
            if place is None:
                self._notes.miss(
                    "things with no floor under them or wall behind them", thing.source
                )
                continue
            if math.dist(place, thing.place) > FARTHEST_UNTOLD + kind.size[1] / 2:
                self._notes.guess(
                    "things moved to a wall or onto the floor", thing.source
                )
            footprint = rectangle(kind.size, *place, heading)
            blocks = kind.in_the_way and self._blocks(footprint)
            if blocks:
                self._notes.guess(
                    "things that would block a way, made no obstacles", thing.source
                )
            elif kind.in_the_way:
                self._obstacles.append(footprint)
            stem = "_".join(re.findall("[a-z0-9]+", thing.category.lower())) or "thing"
            counts[stem] = counts.get(stem, 0) + 1
            yield Landmark(
                f"{stem}_{counts[stem]}",
                Point(place),
                thing.category,
                None,
                thing.name,
                None,
                heading,
                kind.size,
                kind.mount,
                kind.in_the_way and not blocks,
                more={"source": thing.source},
            )

    def _walls_near(self, place: XY, reach: float, least: float) -> list[_WallNearby]:
        """Return the walls of at least a length, the nearest first."""
        spot = Point(place)
        near = self._walls.geometries[
            self._walls.query(spot, predicate="dwithin", distance=reach)
        ]
        found = [
            _WallNearby(line, line.distance(spot), line.project(spot))
            for line in near
            if line.length >= least
        ]
        return sorted(found, key=lambda wall: (wall.gap, wall.line.coords[:]))

    def _room_behind(
        self, door: LineString, behind: Point
    ) -> tuple[str | None, str | None]:
        """Return id and name of the room that a door leads to."""
        rooms = [
            (polygon.distance(behind), identity, room.name)
            for identity, room, polygon in self._rooms
            if polygon.distance(door) <= ROOM_OFF_DOOR
        ]
        _, identity, name = min(rooms, default=(0.0, None, None))
        return identity, name

    def _stand(self, thing: FoundThing, kind: ThingKind) -> tuple[XY | None, float]:
        """Return where a thing stands or hangs and which way it faces."""
        length, depth, _ = kind.size
        on_floor = self._floor.covers(Point(thing.place))
        if kind.mount == "ceiling":
            return (thing.place if on_floor else None), 0.0
        for wall in self._walls_near(thing.place, BESIDE, min(length, 0.5)):
            half = min(length, wall.line.length) / 2
            at = moved(wall.start, wall.heading, wall.fitted(half))
            place = moved(at, wall.inward, depth / 2 + 0.01)
            front = moved(at, wall.inward, depth + 0.3)
            free = self._floor.covers(LineString([moved(at, wall.inward, 0.01), front]))
            if free and self._fits(rectangle(kind.size, *place, wall.inward)):
                return place, wall.inward
        standing = kind.mount == "floor" and on_floor
        if standing and self._fits(rectangle(kind.size, *thing.place, 0.0)):
            return thing.place, 0.0
        return None, 0.0

    def _fits(self, footprint: Polygon) -> bool:
        """Tell whether there is floor under a thing; a pillar may stand half in a wall."""
        return footprint.difference(self._floor).area <= 0.1 * footprint.area

    def _blocks(self, footprint: Polygon) -> bool:
        """Tell whether an obstacle cuts the floor around it in two."""
        around = footprint.centroid.buffer(AROUND)
        taken = shapely.union_all(self._obstacles)
        free = self._floor.intersection(around).difference(taken)

        def pieces(floor: BaseGeometry) -> int:
            parts = shapely.get_parts(floor.buffer(-PASSAGE))
            return sum(part.area > 0.1 for part in parts)

        return pieces(free.difference(footprint)) > pieces(free)
