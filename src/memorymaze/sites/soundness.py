"""Rules without which a plan cannot be used at all; breaking one refuses loading."""

from collections.abc import Iterator

from shapely import Point

from memorymaze.sites.floor import floor_pieces
from memorymaze.sites.problems import SiteProblem
from memorymaze.sites.reading import PLAN
from memorymaze.sites.records import Site

__all__ = ["soundness_problems"]

Finding = tuple[str, str, str]
"""Feature, rule, message."""


def soundness_problems(site: Site, broken: frozenset[str]) -> list[SiteProblem]:
    """Return what keeps a site from being used, though each feature is sound.

    Args:
        site: Made of the sound features of a plan.
        broken: Ids of the plan's other features; referring to one of them is no
            further problem, and with any of them missing the floor is not judged.
    """
    findings = [*_references(site, broken), *_routes(site)]
    if not broken:
        floor = list(_floor(site))
        findings += floor or list(_routes_on_floor(site))
    return [
        SiteProblem(site.source, feature, rule, "error", message)
        for feature, rule, message in findings
    ]


def _references(site: Site, broken: frozenset[str]) -> Iterator[Finding]:
    floor = {each.id for each in (*site.corridors, *site.areas, *site.turning_points)}
    turning_points = {each.id for each in site.turning_points}
    rooms = {each.id for each in site.rooms}
    goals = rooms | {each.id for each in (*site.doors, *site.landmarks)}

    def check(
        owner: str, member: str, wanted: str, target: str, known: set[str]
    ) -> Iterator[Finding]:
        if target not in known and target not in broken:
            yield (
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


def _routes(site: Site) -> Iterator[Finding]:
    references: dict[str, str] = {}
    for route in site.routes:
        if route.role != "reference":
            continue
        if route.route in references:
            yield (
                route.id,
                "one-reference",
                f"expected one reference route called {route.route}, got "
                f"{references[route.route]!r} too; make one an alternative",
            )
        references[route.route] = route.id
    for route in site.routes:
        if route.route not in references:
            yield (
                route.id,
                "one-reference",
                f"expected a reference route called {route.route} beside this "
                "alternative, got none",
            )


def _floor(site: Site) -> Iterator[Finding]:
    named = (*site.corridors, *site.areas, *site.turning_points)
    if not named:
        yield PLAN, "floor-connected", "expected corridors or areas, got none"
        return
    main, *others = floor_pieces([each.polygon for each in named])
    for piece in others:
        on_it = [
            each.id
            for each in named
            if piece.intersects(each.polygon.representative_point())
        ]
        where = piece.representative_point()
        gap = main.distance(piece)
        yield (
            on_it[0] if on_it else PLAN,
            "floor-connected",
            "expected a floor that hangs together, got a separate piece of "
            f"{piece.area:.2f} m² at ({where.x:.2f}, {where.y:.2f}), {gap:.3f} m from "
            f"the rest ({', '.join(on_it)}); let neighbours overlap or share an edge",
        )


def _routes_on_floor(site: Site) -> Iterator[Finding]:
    floor = site.walkable_floor
    for route in site.routes:
        for end, position in (
            ("start", route.line.coords[0]),
            ("goal", route.line.coords[-1]),
        ):
            if not floor.intersects(Point(position)):
                yield (
                    route.id,
                    "route-on-floor",
                    f"expected the {end} on the walkable floor, got "
                    f"({position[0]:.2f}, {position[1]:.2f}), "
                    f"{floor.distance(Point(position)):.2f} m outside it",
                )
