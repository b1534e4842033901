"""A made floor written down in the format of `docs/site_plans.md`."""

from collections.abc import Iterator, Sequence

from shapely import LineString

from memorymaze.construction.floor import MadeFloor, corridor_id, hall_id
from memorymaze.construction.rooms import MadeDoor, MadeRoom
from memorymaze.construction.things import MadeThing
from memorymaze.construction.vocabulary import Vocabulary
from memorymaze.construction.ways import MadeRoute, MadeWay
from memorymaze.geometry.pose import heading_to
from memorymaze.sites.plan_writing import (
    Feature,
    degrees,
    line_feature,
    point_feature,
    polygon_feature,
    position,
)


def features_of(
    floor: MadeFloor,
    words: Vocabulary,
    rooms: Sequence[MadeRoom],
    doors: Sequence[MadeDoor],
    things: Sequence[MadeThing],
    routes: Sequence[MadeRoute],
) -> list[Feature]:
    """Return all features; `doors` are those that lead to no room."""
    features = list(_floor_features(floor, words))
    for index, room in enumerate(rooms, start=1):
        features.append(
            polygon_feature(
                f"room_{index}", "room", room.polygon, name=room.name, use=room.use
            )
        )
    numbered = [
        (door, f"room_{index}")
        for index, room in enumerate(rooms, start=1)
        for door in room.doors
    ]
    door_ids: dict[int, str] = {}
    for index, (door, room_id) in enumerate(
        [*numbered, *((door, None) for door in doors)], start=1
    ):
        door_ids[id(door)] = f"door_{index}"
        features.append(_door(f"door_{index}", door, room_id))
    counts: dict[str, int] = {}
    for thing in things:
        stem = thing.category.lower().replace(" ", "_")
        counts[stem] = counts.get(stem, 0) + 1
        features.append(_landmark(f"{stem}_{counts[stem]}", thing))
    for index, route in enumerate(routes, start=1):
        goal = route.destination.door
        if goal is None:
            raise ValueError(f"{route.destination.name} has no door")
        for number, way in enumerate(route.ways):
            features.append(_route(index, number, way, route, door_ids[id(goal)]))
    return features


def _floor_features(floor: MadeFloor, words: Vocabulary) -> Iterator[Feature]:
    layout = floor.layout
    for (number, piece), polygon in floor.corridors.items():
        street = layout.streets[number]
        program = words.programs[street.program]
        yield polygon_feature(
            corridor_id(number, piece),
            "corridor",
            polygon,
            name=street.name,
            floor_material=program.floor,
            wall_material=program.wall,
        )
    for number, (hall, polygon) in enumerate(
        zip(layout.halls, floor.halls, strict=True)
    ):
        program = words.programs[hall.program]
        yield polygon_feature(
            hall_id(number),
            "area",
            polygon,
            name=hall.name,
            floor_material=program.floor,
            wall_material=program.wall,
            open_air=hall.open_air,
        )
    entrances = {
        floor.skeleton.node_at(place): name for place, name in layout.entrances
    }
    for point in floor.turning_points:
        hall = floor.hall_around(floor.skeleton.places[point.node])
        yield polygon_feature(
            point.id,
            "turning_point",
            point.polygon,
            name=entrances.get(point.node)
            or (None if hall is None else layout.halls[hall].name),
            shape=point.shape,
            exits=[
                {"to": each.to, "heading_deg": degrees(each.heading)}
                for each in point.exits
            ],
        )


def _door(identity: str, door: MadeDoor, room: str | None) -> Feature:
    ends = (door.wall.at(door.start), door.wall.at(door.end))
    return line_feature(
        identity,
        "door",
        ends,
        room=room,
        style=door.style,
        color=door.color,
        label=door.label,
        state="closed",
    )


def _landmark(identity: str, thing: MadeThing) -> Feature:
    return point_feature(
        identity,
        "landmark",
        thing.place,
        category=thing.category,
        color=thing.color,
        name=None,
        text=thing.text,
        heading_deg=degrees(thing.heading),
        size_m=list(thing.size),
        mount=thing.mount,
        obstacle=thing.obstacle,
    )


def _route(
    index: int, number: int, way: MadeWay, route: MadeRoute, goal: str
) -> Feature:
    role = f"alternative_{number}" if number else "reference"
    line = [position(place) for place in way.line]
    return line_feature(
        f"route_r{index}_{role}",
        "route",
        way.line,
        route=f"R{index}",
        role=role.split("_")[0],
        start_heading_deg=degrees(heading_to(way.line[0], way.line[1])),
        goal=route.destination.name,
        goal_landmark=goal,
        length_m=round(LineString(line).length, 3),
        turns=[
            {"at": f"tp_{turn.node + 1}", "direction": turn.direction}
            for turn in way.turns
        ],
        note="",
    )
