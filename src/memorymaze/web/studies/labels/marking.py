"""What is marked on a plan: the way that a description tells, and its errors."""

import json
import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from memorymaze.texts.corpus.records import Failure
from memorymaze.texts.labels.labels import LABEL_KINDS, NO_WAY
from memorymaze.texts.labels.questions import read_kind, read_way, way_in_words
from memorymaze.world.drawing.shapes import ROUTE_COLORS
from memorymaze.world.drawing.svg import path_data, plan_frame
from memorymaze.world.sites import Route, Site

START = "start"
"""The place of an error where the way begins, as generated texts have it."""
MOST_FAILURES = 12
LONGEST_DETAIL = 500
"""Characters."""


@dataclass(frozen=True, slots=True)
class NumberedPlace:
    """A turning point as it is numbered on the plan."""

    number: int
    id: str
    name: str
    x: float
    """Metres of the picture, as `y`: down."""
    y: float


@dataclass(frozen=True, slots=True)
class Marks:
    """What somebody marked."""

    way: str
    """Id of the route that is told, or `none`."""
    places: tuple[str, ...]
    """The turning points of a way that is none of the plan's, in order."""
    failures: tuple[Failure, ...]

    def as_json(self) -> str:
        """Return it as it is kept."""
        return json.dumps(asdict(self), ensure_ascii=False)


def numbered_places(site: Site) -> list[NumberedPlace]:
    """Return the turning points of a plan, numbered from west to east."""
    points = sorted(site.turning_points, key=lambda each: each.polygon.centroid.x)
    return [
        NumberedPlace(
            number,
            point.id,
            point.name or point.shape.replace("_", " "),
            round(point.polygon.centroid.x, 2),
            round(-point.polygon.centroid.y, 2),
        )
        for number, point in enumerate(points, start=1)
    ]


def plan_view(site: Site, route: str) -> dict[str, Any]:
    """Return what a page shows of a plan for marking a description of a route."""
    ways, places = site.ways(route), numbered_places(site)

    def words(way: Route) -> str:
        said = way_in_words(site, way)
        for place in places:
            said = said.replace(f"({place.id})", f"({place.number})")
        return said

    return {
        "frame": plan_frame(site),
        "places": places,
        "things": list(_things(site)),
        "kinds": LABEL_KINDS,
        "most": MOST_FAILURES,
        "ways": [
            (
                way.id,
                words(way),
                path_data(list(way.line.coords)),
                ROUTE_COLORS[number % len(ROUTE_COLORS)],
            )
            for number, way in enumerate(ways)
        ],
    }


def _things(site: Site) -> Iterator[tuple[str, str]]:
    """Return what a description may speak of: its start, things, doors and rooms."""
    yield START, "where the way begins"
    for thing in site.landmarks:
        said = " ".join(filter(None, (thing.color, thing.category)))
        yield thing.id, f"{said} {thing.name or thing.text or ''}".strip()
    for door in site.doors:
        yield door.id, f"{door.style.replace('_', ' ')} door {door.label or ''}".strip()
    for room in site.rooms:
        yield room.id, room.name


def read_marks(fields: dict[str, str], site: Site, route: str) -> Marks:
    """Read the form of marks; ValueError says what is missing or wrong."""
    ways = site.ways(route)
    way = read_way(fields.get("way", ""), [each.id for each in ways])
    places: tuple[str, ...] = ()
    if way == NO_WAY:
        places = _read_places(fields.get("places", ""), site)
        way = next((each.id for each in ways if _goes_by(site, each, places)), way)
        places = () if way != NO_WAY else places
    known = {place.id for place in site.turning_points} | dict(_things(site)).keys()
    failures: list[Failure] = []
    for number in range(MOST_FAILURES):
        kind, where, detail = (
            fields.get(f"{name}.{number}", "").strip()
            for name in ("kind", "where", "detail")
        )
        if not kind:
            if where or detail:
                raise ValueError(f"error {number + 1}: expected a kind, got none")
            continue
        if where not in known:
            raise ValueError(
                f"error {number + 1}: expected a place or thing of the plan, got "
                f"{where or 'none'}"
            )
        failures.append(Failure(read_kind(kind), where, detail[:LONGEST_DETAIL]))
    return Marks(way, places, tuple(failures))


def _read_places(text: str, site: Site) -> tuple[str, ...]:
    by_number = {str(place.number): place.id for place in numbered_places(site)}
    given = re.split(r"[\s,>]+", text.strip()) if text.strip() else []
    unknown = [each for each in given if each not in by_number]
    if unknown:
        raise ValueError(
            f"expected numbers of places from 1 to {len(by_number)}, got "
            f"{', '.join(unknown)}"
        )
    return tuple(by_number[each] for each in given)


def points_crossed(site: Site, way: Route) -> tuple[str, ...]:
    """Return the turning points that a way goes through, in order."""
    through = [
        (way.line.project(point.polygon.centroid), point.id)
        for point in site.turning_points
        if way.line.intersects(point.polygon)
    ]
    return tuple(name for _, name in sorted(through))


def _goes_by(site: Site, way: Route, places: tuple[str, ...]) -> bool:
    """Tell whether places are those of a way: all it crosses, or where it turns."""
    turns = tuple(turn.at for turn in way.turns)
    return bool(places) and places in {points_crossed(site, way), turns}
