"""Rules without which a plan cannot be used at all; breaking one refuses loading."""

from collections.abc import Iterator, Mapping

import numpy as np
import shapely
from shapely import Point, union_all

from memorymaze.basics.geometry.grid import LARGEST_FLOOR
from memorymaze.basics.geometry.polyline import resample
from memorymaze.world.sites.problems import PLAN, SiteProblem
from memorymaze.world.sites.records import Site, floor_pieces

SMALLEST_FREE_FLOOR = 0.01
"""Square metres."""
FLOOR_ACROSS = 2000.0
"""Metres along the longer side of the floor's bounding box, at most."""
OFF_FLOOR = 0.5
"""Metres that a route's line may lie off the floor, as scoring allows; it is looked at in
steps of as many."""
FLOOR_RULES = frozenset({"floor-size", "floor-connected", "floor-free"})
"""Rules whose breach leaves no floor to judge anything else by."""


def loading_findings(site: Site, broken: Mapping[str, str]) -> list[SiteProblem]:
    """Return what keeps a site from being used, though each feature is sound.

    `broken` has the kinds of the plan's other features by id: to refer to one of them
    is no further problem, and where floor is missing it is not judged.
    """
    findings = [*_references(site, broken), *_routes(site, broken)]
    if floor_is_complete(broken):
        floor = list(_floor(site))
        findings += floor or list(_routes_on_floor(site))
    return findings


def floor_is_complete(broken: Mapping[str, str]) -> bool:
    """Return whether none of a plan's broken features is, or may be, floor.

    Their kinds by id are empty where not known.
    """
    return not {"", "corridor", "area", "turning_point"} & set(broken.values())


def _references(site: Site, broken: Mapping[str, str]) -> Iterator[SiteProblem]:
    floor = {each.id for each in site.floor_parts}
    turning_points = {each.id for each in site.turning_points}
    rooms = {each.id for each in site.rooms}
    goals = rooms | {each.id for each in (*site.doors, *site.landmarks)}

    def check(
        owner: str, member: str, wanted: str, target: str, known: set[str]
    ) -> Iterator[SiteProblem]:
        if target not in known and target not in broken:
            yield SiteProblem(
                owner,
                "known-reference",
                f"{member}: expected the id of a {wanted} in this plan, got {target!r}",
            )

    for point in site.turning_points:
        for way in point.exits:
            yield from check(
                point.id,
                "exits.to",
                "corridor, area or turning point",
                way.to,
                floor - {point.id},
            )
    for door in site.doors:
        if door.room is not None:
            yield from check(door.id, "room", "room", door.room, rooms)
    for route in site.routes:
        yield from check(
            route.id,
            "goal_landmark",
            "landmark, door or room",
            route.goal_landmark,
            goals,
        )
        for turn in route.turns:
            yield from check(
                route.id, "turns.at", "turning point", turn.at, turning_points
            )


def _routes(site: Site, broken: Mapping[str, str]) -> Iterator[SiteProblem]:
    references: dict[str, str] = {}
    for route in site.routes:
        if route.role != "reference":
            continue
        if route.route in references:
            yield SiteProblem(
                route.id,
                "one-reference",
                f"expected one reference route called {route.route}, got "
                f"{references[route.route]!r} too; make one an alternative",
            )
        references[route.route] = route.id
    for route in site.routes:
        if route.route not in references and not {"", "route"} & set(broken.values()):
            yield SiteProblem(
                route.id,
                "one-reference",
                f"expected a reference route called {route.route} beside this "
                "alternative, got none",
            )
        owner = references.get(route.id)
        if owner is not None and owner != route.id:
            yield SiteProblem(
                route.id,
                "one-reference",
                f"expected an id that no other route has as its name, got {route.id!r}, "
                f"which is what {owner!r} is called: it would be told apart by nothing",
            )


def _floor(site: Site) -> Iterator[SiteProblem]:
    named = site.floor_parts
    if not named:
        yield SiteProblem(
            PLAN, "floor-connected", "expected corridors or areas, got none"
        )
        return
    west, south, east, north = union_all([each.polygon for each in named]).bounds
    across = max(east - west, north - south)
    if across > FLOOR_ACROSS:
        yield SiteProblem(
            PLAN,
            "floor-size",
            f"expected a floor at most {FLOOR_ACROSS:.0f} m across, got {across:.0f} m; "
            "coordinates are metres, not centimetres, millimetres or feet",
        )
        return
    main, *others = floor_pieces([each.polygon for each in named])
    if main.area > LARGEST_FLOOR:
        yield SiteProblem(
            PLAN,
            "floor-size",
            f"expected a floor of at most {LARGEST_FLOOR:,.0f} m², got "
            f"{main.area:,.0f} m²; distances on a larger one take gigabytes and minutes: "
            "cut the building into several sites",
        )
        return
    for piece in others:
        on_it = [
            each.id
            for each in named
            if piece.intersects(each.polygon.representative_point())
        ]
        where = piece.representative_point()
        gap = main.distance(piece)
        yield SiteProblem(
            on_it[0] if on_it else PLAN,
            "floor-connected",
            "expected a floor that hangs together, got a separate piece of "
            f"{piece.area:.2f} m² at ({where.x:.2f}, {where.y:.2f}), {gap:.3f} m from "
            f"the rest ({', '.join(on_it)}); let neighbours overlap or share an edge",
        )
    covered = union_all([each.footprint for each in site.landmarks if each.obstacle])
    if main.difference(covered).area < SMALLEST_FREE_FLOOR:
        yield SiteProblem(
            PLAN,
            "floor-free",
            "expected some floor free of obstacles, got none; shrink landmarks that "
            "are obstacles",
        )


def _routes_on_floor(site: Site) -> Iterator[SiteProblem]:
    floor = site.walkable_floor
    for route in site.routes:
        for end, position in (
            ("start", route.line.coords[0]),
            ("goal", route.line.coords[-1]),
        ):
            if not floor.intersects(Point(position)):
                yield SiteProblem(
                    route.id,
                    "route-on-floor",
                    f"expected the {end} on the walkable floor, got "
                    f"({position[0]:.2f}, {position[1]:.2f}), "
                    f"{floor.distance(Point(position)):.2f} m outside it",
                )
        within = resample(route.line.coords, OFF_FLOOR)[1:-1, :2]
        off = np.asarray(shapely.distance(floor, shapely.points(within)))
        if (off > OFF_FLOOR).any():
            x, y = within[off.argmax()].tolist()
            yield SiteProblem(
                route.id,
                "route-on-floor",
                f"expected a line on the walkable floor, at most {OFF_FLOOR} m off it, "
                f"got ({x:.2f}, {y:.2f}), {off.max():.2f} m outside it",
            )
