"""A made floor as a building."""

from collections.abc import Iterator, Sequence
from itertools import chain

from shapely import LineString

from memorymaze.construction.floor import MadeFloor, corridor_id, hall_id
from memorymaze.construction.rooms import MadeDoor, MadeRoom
from memorymaze.construction.vocabulary import Vocabulary
from memorymaze.construction.ways import MadeRoute
from memorymaze.geometry.pose import heading_to
from memorymaze.sites.plan import in_millimetres
from memorymaze.sites.records import (
    Area,
    Corridor,
    Door,
    Landmark,
    Room,
    Route,
    Site,
)


def building_of(
    name: str,
    description: str,
    ceiling_height: float,
    titles: tuple[str, str],
    floor: MadeFloor,
    words: Vocabulary,
    rooms: Sequence[MadeRoom],
    doors: Sequence[MadeDoor],
    things: Sequence[Landmark],
    routes: Sequence[MadeRoute],
) -> Site:
    """Return all as one building.

    `titles` are those of the building and of the floor; `doors` those that lead to no
    room.
    """
    placed = [
        *(
            (door, f"room_{n}")
            for n, room in enumerate(rooms, 1)
            for door in room.doors
        ),
        *((door, None) for door in doors),
    ]
    door_ids = {id(door): f"door_{n}" for n, (door, _) in enumerate(placed, 1)}
    site = Site(
        name=name,
        title=titles[0],
        floor=titles[1],
        ceiling_height=ceiling_height,
        description=description,
        anchor=None,
        corridors=tuple(_corridors(floor, words)),
        areas=tuple(_areas(floor, words)),
        turning_points=tuple(floor.turning_points.values()),
        rooms=tuple(
            Room(f"room_{number}", room.polygon, room.name, room.use)
            for number, room in enumerate(rooms, 1)
        ),
        doors=tuple(_door(door_ids[id(door)], door, room) for door, room in placed),
        landmarks=tuple(things),
        routes=tuple(
            chain.from_iterable(
                _routes(number, route, door_ids[id(route.destination.door)])
                for number, route in enumerate(routes, 1)
            )
        ),
    )
    return in_millimetres(site)


def _corridors(floor: MadeFloor, words: Vocabulary) -> Iterator[Corridor]:
    for (number, piece), polygon in floor.corridors.items():
        street = floor.layout.streets[number]
        program = words.programs[street.program]
        yield Corridor(
            corridor_id(number, piece),
            polygon,
            street.name,
            program.floor,
            program.wall,
        )


def _areas(floor: MadeFloor, words: Vocabulary) -> Iterator[Area]:
    for number, hall in enumerate(floor.layout.halls):
        program = words.programs[hall.program]
        yield Area(
            hall_id(number),
            floor.halls[number],
            hall.name,
            program.floor,
            program.wall,
            hall.open_air,
        )


def _door(identity: str, door: MadeDoor, room: str | None) -> Door:
    line = LineString([door.wall.at(door.start), door.wall.at(door.end)])
    return Door(identity, line, room, door.style, door.color, door.label, "closed")


def _routes(number: int, route: MadeRoute, goal: str) -> Iterator[Route]:
    """Yield the ways of a route, the reference first."""
    for count, way in enumerate(route.ways):
        yield Route(
            f"route_r{number}_" + (f"alternative_{count}" if count else "reference"),
            LineString(way.line),
            route=f"R{number}",
            role="alternative" if count else "reference",
            start_heading=heading_to(way.line[0], way.line[1]),
            goal=route.destination.name,
            goal_landmark=goal,
            length=way.length,
            turns=way.turns,
            note="",
        )
