"""A made floor as the parts of a building."""

from collections.abc import Iterator, Sequence

from shapely import LineString

from memorymaze.basics.geometry.pose import heading_to
from memorymaze.world.construction.floor import MadeFloor, corridor_id, hall_id
from memorymaze.world.construction.rooms import MadeDoor, MadeRoom
from memorymaze.world.construction.vocabulary import Vocabulary
from memorymaze.world.construction.ways import MadeRoute
from memorymaze.world.sites.records import Area, Corridor, Door, PlanPart, Room, Route


def parts_of(
    floor: MadeFloor,
    words: Vocabulary,
    rooms: Sequence[MadeRoom],
    doors: Sequence[MadeDoor],
    routes: Sequence[MadeRoute],
) -> Iterator[PlanPart]:
    """Yield all but what stands and hangs on a floor; `doors` lead to no room."""
    for (number, piece), polygon in floor.corridors.items():
        street = floor.layout.streets[number]
        program = words.programs[street.program]
        identity = corridor_id(number, piece)
        yield Corridor(identity, polygon, street.name, program.floor, program.wall)
    for number, hall in enumerate(floor.layout.halls):
        program, polygon = words.programs[hall.program], floor.halls[number]
        materials = program.floor, program.wall
        yield Area(hall_id(number), polygon, hall.name, *materials, hall.open_air)
    yield from floor.turning_points.values()
    placed: list[tuple[MadeDoor, str | None]] = []
    for number, room in enumerate(rooms, start=1):
        yield Room(f"room_{number}", room.polygon, room.name, room.use)
        placed += [(door, f"room_{number}") for door in room.doors]
    placed += [(door, None) for door in doors]
    ids: dict[int, str] = {}
    for number, (door, behind) in enumerate(placed, start=1):
        ids[id(door)] = f"door_{number}"
        line = LineString([door.wall.at(door.start), door.wall.at(door.end)])
        looks = door.style, door.color, door.label
        yield Door(ids[id(door)], line, behind, *looks, "closed")
    for number, route in enumerate(routes, start=1):
        for count, way in enumerate(route.ways):
            role = f"alternative_{count}" if count else "reference"
            yield Route(
                f"route_r{number}_{role}",
                LineString(way.line),
                route=f"R{number}",
                role="alternative" if count else "reference",
                start_heading=heading_to(way.line[0], way.line[1]),
                goal=route.destination.name,
                goal_landmark=ids[id(route.destination.door)],
                length=way.length,
                turns=way.turns,
                note="",
            )
