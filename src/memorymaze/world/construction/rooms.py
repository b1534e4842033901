"""Rooms along the walls of a floor, their doors, and the numbers on them."""

import string
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import cast

import numpy as np
from shapely import LineString, Point, Polygon, get_parts

from memorymaze.basics.geometry.points import XY
from memorymaze.world.construction.floor import MadeFloor, rounded
from memorymaze.world.construction.layout import (
    Street,
    UnsuitableFloor,
)
from memorymaze.world.construction.vocabulary import RoomKind, Special, Vocabulary
from memorymaze.world.construction.walls import MadeWall
from memorymaze.world.sites.things import DoorKind, door_kinds

WALL_DEPTH = 0.12
"""Metres between the floor and a room, and between two rooms."""
LEAST_ROOM = 4.0
"""Square metres."""
LEAST_COMPACT = 0.62
"""Share that a room must have of the rectangle around it."""
NARROWEST_ROOM = 1.5
"""Metres."""
TWO_DOORS = 8.5
"""Rooms at least so many metres wide have two doors."""
DOOR_MARGIN = 0.25
"""Metres between a door and the side of its room."""


@dataclass
class MadeRoom:
    """A room, named once all rooms are placed."""

    polygon: Polygon
    wall: MadeWall
    start: float
    """Metres along the wall."""
    end: float
    name: str
    """With `{number}` until it has one."""
    use: str
    door: str
    """Name of a kind of door."""
    destination: bool = False
    sign: str | None = None
    number: str | None = None
    doors: list["MadeDoor"] = field(default_factory=list["MadeDoor"])

    @property
    def middle(self) -> float:
        """Metres along the wall."""
        return (self.start + self.end) / 2


@dataclass
class MadeDoor:
    """A door in a wall."""

    wall: MadeWall
    start: float
    """Metres along the wall."""
    end: float
    style: str
    color: str
    label: str | None = None

    @property
    def middle(self) -> float:
        """Metres along the wall."""
        return (self.start + self.end) / 2

    @property
    def place(self) -> XY:
        """Its middle."""
        return self.wall.at(self.middle)


@dataclass
class _Slot:
    """A stretch of wall for a room."""

    wall: MadeWall
    start: float
    end: float
    kind: RoomKind


class RoomPlanner:
    """Puts rooms along walls."""

    def __init__(
        self, floor: MadeFloor, words: Vocabulary, rng: np.random.Generator
    ) -> None:
        """Begin with no rooms."""
        self.rooms: list[MadeRoom] = []
        self._floor = floor
        self._words = words
        self._rng = rng
        self._kept_free = floor.walkable.buffer(WALL_DEPTH, join_style="mitre")

    def place(self, walls: Sequence[MadeWall], digit: int) -> list[MadeRoom]:
        """Place special rooms first, then those there are many of, and number them."""
        slots = [slot for wall in walls for slot in self._slots(wall)]
        for special in self._words.specials:
            for _ in range(special.count):
                self._place_special(special, walls, slots)
        for slot in slots:
            kind = slot.kind
            self._add(slot.wall, slot.start, slot.end, kind.depth, kind)
        self._name(digit)
        return self.rooms

    def add_behind(self, wall: MadeWall, kind: Special) -> bool:
        """Place a room behind the middle of a wall; tell whether there was room."""
        half, middle = kind.width / 2, wall.length / 2
        return self._add(wall, middle - half, middle + half, kind.depth, kind)

    def _slots(self, wall: MadeWall) -> Iterator[_Slot]:
        kinds = self._words.programs[wall.program].rooms
        if not kinds or wall.street is None or wall.taken:
            return
        if not _has_rooms(self._floor.layout.streets[wall.street], wall):
            return
        weights = np.array([kind.weight for kind in kinds])
        drawn: list[tuple[RoomKind, float]] = []
        left = wall.length
        while left > 0:
            kind = kinds[self._rng.choice(len(kinds), p=weights / weights.sum())]
            width = float(self._rng.uniform(*kind.width))
            if width > left:
                break
            drawn.append((kind, width))
            left -= width
        if not drawn:
            if wall.length >= min(kind.width[0] for kind in kinds) * 0.8:
                narrow = min(kinds, key=lambda kind: kind.width[0])
                yield _Slot(wall, 0.0, wall.length, narrow)
            return
        stretch = wall.length / (wall.length - left)
        start = 0.0
        for kind, width in drawn:
            yield _Slot(wall, start, start + width * stretch, kind)
            start += width * stretch

    def _place_special(
        self, special: Special, walls: Sequence[MadeWall], slots: list[_Slot]
    ) -> None:
        width = special.width * (2 if special.beside else 1)
        runs = [
            run
            for run in _runs(slots, width)
            if run[0].wall.program in special.programs
        ]
        halls = [
            (wall, start)
            for wall in walls
            if wall.hall is not None and wall.program in special.programs
            for start in (0.3, (wall.length - width) / 2)
            if wall.is_free(start, start + width)
        ]
        choices = len(runs) + len(halls)
        for choice in self._rng.permutation(choices):
            if choice < len(runs):
                run = runs[choice]
                wall, start, end = run[0].wall, run[0].start, run[-1].end
            else:
                run = []
                wall, start = halls[choice - len(runs)]
                end = start + width
            if not self._add_special(special, wall, start, end):
                continue
            for slot in run:
                slots.remove(slot)
            return
        if special.destination and special.count == 1:
            raise UnsuitableFloor(f"no room for {special.name}")

    def _add_special(
        self, special: Special, wall: MadeWall, start: float, end: float
    ) -> bool:
        if not special.beside:
            return self._add(wall, start, end, special.depth, special)
        middle = (start + end) / 2
        if not self._add(wall, start, middle, special.depth, special):
            return False
        other = special.model_copy(
            update={
                "name": special.beside,
                "sign": special.beside.split("'")[0],
            }
        )
        if not self._add(wall, middle, end, special.depth, other):
            self.rooms.pop()
            return False
        return True

    def _add(
        self,
        wall: MadeWall,
        start: float,
        end: float,
        depth: float,
        kind: RoomKind | Special,
    ) -> bool:
        polygon = self._polygon(wall, start, end, depth)
        if polygon is None:
            return False
        line = LineString([
            wall.at(start, -WALL_DEPTH - 0.05),
            wall.at(end, -WALL_DEPTH - 0.05),
        ])
        fronts = [
            sorted((
                wall_along(wall, piece.coords[0]),
                wall_along(wall, piece.coords[-1]),
            ))
            for piece in get_parts(line.intersection(polygon))
            if isinstance(piece, LineString)
        ]
        if not fronts:
            return False
        low, high = max(fronts, key=lambda front: front[1] - front[0])
        low, high = max(low, 0.0), min(high, wall.length)
        doors = self._doors(wall, low, high, door_kinds()[kind.door])
        if not doors:
            return False
        special = isinstance(kind, Special)
        self.rooms.append(
            MadeRoom(
                polygon,
                wall,
                low,
                high,
                kind.name,
                kind.use,
                kind.door,
                special and kind.destination,
                kind.sign if special else None,
                doors=doors,
            )
        )
        for door in doors:
            wall.take(door.start - 0.1, door.end + 0.1)
        return True

    def _polygon(
        self, wall: MadeWall, start: float, end: float, depth: float
    ) -> Polygon | None:
        """Return what is left of a room beside the floor and other rooms."""
        shape = wall.strip(
            start + WALL_DEPTH / 2, end - WALL_DEPTH / 2, -WALL_DEPTH, -depth
        )
        free = shape.difference(self._kept_free)
        for room in self.rooms:
            if room.polygon.intersects(shape):
                near = room.polygon.buffer(WALL_DEPTH, join_style="mitre")
                free = free.difference(near)
        front = LineString([wall.at(start, -WALL_DEPTH), wall.at(end, -WALL_DEPTH)])
        pieces = [
            piece
            for piece in get_parts(free)
            if isinstance(piece, Polygon) and piece.distance(front) < 0.02
        ]
        if not pieces:
            return None
        biggest = max(pieces, key=lambda piece: piece.area)
        best = rounded(cast(Polygon, biggest.simplify(0.02)))
        inside = best.buffer(-NARROWEST_ROOM / 2)
        box = best.minimum_rotated_rectangle
        if best.area < max(LEAST_ROOM, LEAST_COMPACT * box.area) or inside.is_empty:
            return None
        return best

    def _doors(
        self, wall: MadeWall, low: float, high: float, kind: DoorKind
    ) -> list[MadeDoor]:
        room = high - low
        color = kind.colors[self._rng.integers(len(kind.colors))]
        width = min(kind.width, room - 2 * DOOR_MARGIN)
        if width < 0.85:
            return []
        if kind.style == "elevator":
            count = max(int((room - 0.3) // (width + 0.5)), 1)
            middles = [low + room * (i + 0.5) / count for i in range(count)]
        elif room >= TWO_DOORS and kind.style == "wood":
            middles = [low + 1.3, high - 1.3]
        else:
            margin = DOOR_MARGIN + width / 2
            at = float(self._rng.choice([0.0, 0.12, 0.5, 0.88, 1.0]))
            middles = [low + margin + at * (room - 2 * margin)]
        return [
            MadeDoor(wall, middle - width / 2, middle + width / 2, kind.style, color)
            for middle in middles
        ]

    def _name(self, digit: int) -> None:
        for room, number in self._numbers(digit):
            room.number = number
        spare = {
            key: list(self._rng.permutation(names))
            for key, names in self._words.names.items()
        }
        for room in self.rooms:
            for key, names in spare.items():
                if f"{{{key}}}" in room.name:
                    if not names:
                        raise UnsuitableFloor(f"more rooms than names of a {key}")
                    room.name = str(names.pop())
            if room.number is not None:
                room.name = room.name.replace("{number}", room.number)
            for count, door in enumerate(room.doors, start=1):
                door.label = room.number or _label(room, count)

    def _numbers(self, digit: int) -> Iterator[tuple[MadeRoom, str]]:
        """Number rooms along their streets: odd on the left, even on the right."""
        counts: dict[int, int] = {}
        for number, street in enumerate(self._floor.layout.streets):
            line = LineString(street.points)
            base = counts.get(street.zone, 0)
            last = {0: base - 1, 1: base}
            along = sorted(
                (
                    (float(line.project(Point(room.wall.at(room.middle)))), index)
                    for index, room in enumerate(self.rooms)
                    if room.wall.street == number and "{number}" in room.name
                )
            )
            for _, index in along:
                room = self.rooms[index]
                side = 0 if _is_left(street, room.wall) else 1
                last[side] += 2
                yield (
                    room,
                    self._words.number.format(
                        floor=digit,
                        zone=street.zone + 1,
                        letter=string.ascii_uppercase[street.zone],
                        count=last[side],
                    ),
                )
            highest = max(last.values())
            if highest > 99:
                raise UnsuitableFloor("more than 99 rooms in a wing")
            counts[street.zone] = highest + highest % 2 if along else base


def _runs(slots: Sequence[_Slot], width: float) -> Iterator[list[_Slot]]:
    """Yield neighbouring slots that are together at least so wide, and not too wide."""
    for first in range(len(slots)):
        run: list[_Slot] = []
        for slot in slots[first : first + 5]:
            if run and (
                slot.wall is not run[0].wall or slot.start > run[-1].end + 0.01
            ):
                break
            run.append(slot)
            whole = slot.end - run[0].start
            if whole >= 0.95 * width:
                if whole <= 1.7 * width:
                    yield run
                break


def _label(room: MadeRoom, count: int) -> str:
    if room.door == "elevator":
        return f"Lift {count}"
    return room.sign or room.name


def wall_along(wall: MadeWall, place: Sequence[float]) -> float:
    """Return how far along a wall a place lies, metres."""
    ahead = wall.at(1.0)
    return sum(
        (place[axis] - wall.start[axis]) * (ahead[axis] - wall.start[axis])
        for axis in (0, 1)
    )


def _has_rooms(street: Street, wall: MadeWall) -> bool:
    if street.rooms == "both":
        return True
    if street.rooms == "none":
        return False
    return _is_left(street, wall) == (street.rooms == "left")


def _is_left(street: Street, wall: MadeWall) -> bool:
    """Return whether a wall is on the left of its street, seen along the street."""
    line = LineString(street.points)
    middle = Point(wall.at(wall.length / 2))
    along = float(line.project(middle))
    ahead = line.interpolate(min(along + 0.1, line.length))
    behind = line.interpolate(max(along - 0.1, 0.0))
    across = (ahead.x - behind.x) * (middle.y - behind.y) - (ahead.y - behind.y) * (
        middle.x - behind.x
    )
    return across > 0
