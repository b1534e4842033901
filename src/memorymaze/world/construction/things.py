"""Things along the walls and in the halls of a floor, and the signs beside doors."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from shapely import MultiLineString, Point, Polygon, STRtree

from memorymaze.basics.geometry.points import XY
from memorymaze.world.construction.floor import MadeFloor
from memorymaze.world.construction.rooms import MadeRoom
from memorymaze.world.construction.vocabulary import Program, Vocabulary
from memorymaze.world.construction.walls import MadeWall
from memorymaze.world.sites.records import Landmark
from memorymaze.world.sites.things import ThingKind, thing_kinds

FROM_MIDDLE_LINES = 0.65
"""Metres kept free on both sides of every way."""
FREE_BEFORE_THINGS = 0.75
"""Metres between things that stand at different walls, or about in a hall."""
OFF_WALL = 0.005
"""Metres between a thing and the wall that it is at."""
NUMBER_SIGNS = 0.4
"""Share of numbered doors with a sign beside them."""
FLOOR_PER_PIECE = 16.0
"""Square metres of a hall for each piece of furniture."""
PRINTED = 0.7
"""Share of things with words that have some on them."""


class Furnisher:
    """Puts things where they are in nobody's way."""

    def __init__(
        self,
        floor: MadeFloor,
        words: Vocabulary,
        rooms: Sequence[MadeRoom],
        rng: np.random.Generator,
    ) -> None:
        """Begin with no things."""
        self.things: list[Landmark] = []
        self._counts: dict[str, int] = {}
        self._floor = floor
        self._words = words
        self._rng = rng
        skeleton = floor.skeleton
        self._ways = MultiLineString([
            skeleton.line(node, other) for node, other in skeleton.graph.edges
        ])
        self._points = STRtree([
            point.polygon for point in floor.turning_points.values()
        ])
        self._behind = STRtree([room.polygon for room in rooms])
        self._standing: list[tuple[Polygon, MadeWall | None]] = []

    def furnish_wall(self, wall: MadeWall) -> None:
        """Put things along a wall, as many as its program says."""
        program = self._words.programs[wall.program]
        for _ in range(self._rng.poisson(program.density * wall.length / 10)):
            kind = thing_kinds()[self._draw(program)]
            for along in self._rng.uniform(0.0, wall.length, 3):
                if self.put_at_wall(kind, wall, float(along)):
                    break

    def put_at_wall(
        self, kind: ThingKind, wall: MadeWall, along: float, text: str | None = None
    ) -> bool:
        """Put a thing at a wall where there is room; tell whether there was."""
        length, depth, _ = kind.size
        start, end = along - length / 2 - 0.1, along + length / 2 + 0.1
        if not wall.is_free(start, end):
            return False
        thing = self._made(
            kind, wall.at(along, depth / 2 + OFF_WALL), wall.facing, text
        )
        if kind.name == "window" and len(
            self._behind.query(wall.strip(start, end, -0.2, -1.5), "intersects")
        ):
            return False
        if thing.obstacle and not self._is_free(thing.footprint, wall):
            return False
        wall.take(start, end)
        self._keep(thing, wall)
        return True

    def furnish_hall(self, number: int) -> None:
        """Put furniture about in a hall."""
        hall = self._floor.layout.halls[number]
        program = self._words.programs[hall.program]
        inside = self._floor.halls[number].buffer(-1.0)
        if not program.furniture or inside.is_empty:
            return
        west, south, east, north = inside.bounds
        edge = hall.polygon.exterior.coords
        along = math.atan2(edge[1][1] - edge[0][1], edge[1][0] - edge[0][0])
        wanted = int(inside.area / FLOOR_PER_PIECE)
        for name in self._rng.choice(program.furniture, wanted):
            kind = thing_kinds()[str(name)]
            for _ in range(6):
                place = (
                    float(self._rng.uniform(west, east)),
                    float(self._rng.uniform(south, north)),
                )
                heading = along + float(self._rng.integers(4)) * math.pi / 2
                thing = self._made(kind, place, heading, None)
                footprint = thing.footprint
                if not inside.contains(footprint):
                    continue
                if kind.mount == "ceiling" or self._is_free(footprint, None):
                    self._keep(thing, None)
                    break

    def label_doors(self, rooms: Iterable[MadeRoom]) -> None:
        """Put numbers and names beside doors."""
        number = thing_kinds()["room number sign"]
        restroom = thing_kinds()["restroom sign"]
        for room in rooms:
            if not room.doors:
                continue
            door = room.doors[0]
            for along in (door.end + 0.32, door.start - 0.32):
                if room.sign is not None:
                    put = self.put_at_wall(restroom, room.wall, along, room.sign)
                elif room.number is not None:
                    if self._rng.random() > NUMBER_SIGNS:
                        break
                    put = self.put_at_wall(number, room.wall, along, room.number)
                else:
                    break
                if put:
                    break
            if room.destination:
                self._name_beside(room)

    def _name_beside(self, room: MadeRoom) -> None:
        for along in (
            room.doors[-1].end + 0.85,
            room.doors[0].start - 0.85,
            room.doors[0].end + 1.2,
        ):
            if self.put_at_wall(thing_kinds()["sign"], room.wall, along, room.name):
                return

    def hang(self, name: str, place: XY, heading: float, text: str) -> None:
        """Hang a kind of sign from the ceiling."""
        kind = thing_kinds()[name]
        self._keep(_landmark(kind, place, heading, kind.colors[0], text), None)

    def _draw(self, program: Program) -> str:
        weights = np.array(list(program.things.values()))
        return list(program.things)[
            self._rng.choice(len(weights), p=weights / weights.sum())
        ]

    def _made(
        self, kind: ThingKind, place: XY, heading: float, text: str | None
    ) -> Landmark:
        texts = self._words.texts.get(kind.name, kind.texts)
        color = kind.colors[self._rng.integers(len(kind.colors))]
        if text is None and texts and self._rng.random() < PRINTED:
            text = texts[self._rng.integers(len(texts))]
        return _landmark(kind, place, heading, color, text)

    def _is_free(self, footprint: Polygon, wall: MadeWall | None) -> bool:
        if footprint.distance(self._ways) < FROM_MIDDLE_LINES:
            return False
        if len(self._points.query(footprint, "intersects")):
            return False
        return all(
            footprint.distance(other) > (0.05 if at is wall else FREE_BEFORE_THINGS)
            for other, at in self._standing
        )

    def _keep(self, thing: Landmark, wall: MadeWall | None) -> None:
        stem = thing.category.lower().replace(" ", "_")
        self._counts[stem] = self._counts.get(stem, 0) + 1
        self.things.append(replace(thing, id=f"{stem}_{self._counts[stem]}"))
        if thing.obstacle:
            self._standing.append((thing.footprint, wall))


def _landmark(
    kind: ThingKind, place: XY, heading: float, color: str, text: str | None
) -> Landmark:
    """Return a thing that has no id yet."""
    return Landmark(
        "",
        Point(place),
        kind.name,
        color,
        None,
        text,
        heading,
        kind.size,
        kind.mount,
        kind.in_the_way,
    )
