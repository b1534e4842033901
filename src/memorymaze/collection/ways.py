"""The ways of a route told to annotators, in words and as pictures."""

from pathlib import Path

from memorymaze.drawing.plan_picture import draw_site
from memorymaze.errors import SettingsError
from memorymaze.sites.records import Route, Site, TurningPoint

BEYOND = 0.5
"""Metres after a turning point at which one is in the hallway turned into."""


def ways_of(site: Site, route: str) -> list[Route]:
    """Return the ways of a route, the reference first."""
    ways = [each for each in site.routes if each.route == route]
    return sorted(ways, key=lambda each: each.role != "reference")


def way_in_words(site: Site, way: Route) -> str:
    """Return a way's length, turns and goal in a line."""
    points = {point.id: point for point in site.turning_points}
    turns: list[str] = []
    for turn in way.turns:
        into = _name_beyond(site, way, points[turn.at])
        words = turn.direction.replace("_", " ") + (f" into {into}" if into else "")
        turns.append(f"{words} ({turn.at})")
    walk = ", ".join(turns) or "no turn"
    return f"{way.role}, {way.length:.0f} m: {walk}; to {way.goal}"


def _name_beyond(site: Site, way: Route, point: TurningPoint) -> str | None:
    """Return the name of where a way goes on after a turning point."""
    crossing = way.line.project(point.polygon.centroid)
    reach = point.polygon.length / 4 + BEYOND
    beyond = way.line.interpolate(min(crossing + reach, way.line.length))
    for place in (*site.corridors, *site.areas):
        if place.name and place.polygon.covers(beyond):
            return place.name
    return None


def draw_ways(folder: str | Path, site: Site, route: str) -> Path:
    """Draw the plan with the ways of a route, unless the picture is there already.

    Raises:
        SettingsError: The picture cannot be written.
    """
    picture = Path(folder) / f"{site.name}_{route}.png"
    if not picture.exists():
        try:
            picture.parent.mkdir(parents=True, exist_ok=True)
            draw_site(site, picture, routes=[route])
        except OSError as error:
            raise SettingsError(
                f"--pictures {folder}: cannot be written ({error.strerror or error})"
            ) from None
    return picture
