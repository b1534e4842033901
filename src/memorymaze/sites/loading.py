"""Sites from plans: those of this package, files and folders, made into records."""

import json
import math
import re
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TypeVar

from shapely import LineString, Point, Polygon
from shapely.validation import explain_validity

from memorymaze.errors import SettingsError, SitePlanError, did_you_mean
from memorymaze.geometry.pose import wrap_angle
from memorymaze.sites import plan_models as models
from memorymaze.sites import records
from memorymaze.sites.loading_rules import loading_findings
from memorymaze.sites.problems import Rule, SiteProblem
from memorymaze.sites.reading import PlanContent, read_plan

_Record = TypeVar("_Record")

SNAKE_CASE = re.compile(r"[a-z0-9]+(_[a-z0-9]+)*")

SMALLEST_AREA = 0.01
"""A floor or room smaller than this many square metres is a slip of the pen."""
SHORTEST_LINE = 0.01
"""Metres."""
CONVEX_SLACK = 1e-6
"""Square metres a four-cornered corridor may lack of its hull."""

BUILTIN_SITE_NAMES: tuple[str, ...] = ("university", "museum_5f", "museum_7f")
"""The three floors of the benchmark."""


def load_site(site: str | Path) -> records.Site:
    """Load one of the benchmark's sites, or a plan.

    Args:
        site: `university`, `museum_5f` or `museum_7f`; else a GeoJSON file in the
            format of `docs/site_plans.md`.

    Raises:
        SettingsError: There is neither.
        SitePlanError: The plan cannot be used. The message names file, feature and
            rule of the first problem, and how many more there are.
    """
    path = plan_file(site)
    return sound_site(read_plan(path), str(path))


def sound_site(plan: PlanContent, source: str) -> records.Site:
    """Return the site of a plan, or say why it cannot be used."""
    site, broken, shape_findings = site_from_content(plan, source)
    findings = [*plan.findings, *shape_findings]
    if site is not None:
        findings += loading_findings(site, broken)
    if findings or site is None:
        first, *others = findings
        more = (
            f" ({len(others)} more: see them all with `memorymaze sites check {source}`)"
            if others
            else ""
        )
        raise SitePlanError(
            f"{source}: {first.feature}: {first.rule}: {first.message}{more}"
        )
    return site


def load_sites(folder: str | Path | None = None) -> dict[str, records.Site]:
    """Load all plans of a folder, or the benchmark's own.

    Args:
        folder: Holds `*.geojson`; None means the plans in this package.

    Returns:
        Sites by name, in the order of the file names.

    Raises:
        SitePlanError: A plan cannot be used, two have the same name, or the folder is
            missing or has no plan in it.
    """
    if folder is None:
        return {name: load_site(name) for name in BUILTIN_SITE_NAMES}
    paths = plan_paths(Path(folder))
    sites: dict[str, records.Site] = {}
    for path in paths:
        site = load_site(path)
        if site.name in sites:
            raise SitePlanError(
                f"{path}: -: name: expected a name of its own for every plan in the "
                f"folder, got {site.name!r} as in {sites[site.name].source}; change one"
            )
        sites[site.name] = site
    return sites


def plan_paths(folder: Path) -> list[Path]:
    """Return the plans in a folder by file name; there has to be one at least."""
    if not folder.is_dir():
        raise SitePlanError(
            f"{folder}: expected a folder with site plans (*.geojson), got "
            f"{'a file' if folder.exists() else 'none: no such folder'}"
        )
    paths = sorted(folder.glob("*.geojson"))
    if not paths:
        raise SitePlanError(
            f"{folder}: expected at least one site plan (*.geojson), got none"
        )
    return paths


def plan_file(site: str | Path) -> Path:
    """Return the plan's file of one of the benchmark's sites, or the file of this name."""
    if site in BUILTIN_SITE_NAMES:
        return Path(__file__).parent / "data" / f"{site}.geojson"
    if not site or not Path(site).exists():
        raise SettingsError(
            f"site: expected a plan's file or one of {', '.join(BUILTIN_SITE_NAMES)}, "
            f"got {str(site)!r}: no such file{did_you_mean(site, BUILTIN_SITE_NAMES)}"
        )
    return Path(site)


class _ShapeError(Exception):
    """A shape breaks a rule."""

    def __init__(self, rule: Rule, message: str) -> None:
        super().__init__(message)
        self.rule: Rule = rule


def new_plan(name: str) -> bytes:
    """Return a small plan to begin with: two corridors, a corner, a door, a route.

    Raises:
        SettingsError: The name is not of small letters, digits and underscores.
    """
    if not SNAKE_CASE.fullmatch(name):
        raise SettingsError(
            "name: expected small letters, digits and underscores, such as annex_2, got "
            f"{name!r}"
        )
    plan = (Path(__file__).parent / "data/skeleton.geojson").read_text("utf-8")
    title = name.replace("_", " ").capitalize()
    return (
        plan
        .replace('"name": "annex"', f'"name": "{name}"')
        .replace('"title": "Annex"', f'"title": "{title}"')
        .encode()
    )


def site_from_content(
    content: PlanContent, source: str
) -> tuple[records.Site | None, dict[str, str], list[SiteProblem]]:
    """Make a Site of all features whose shapes are sound; None without a usable header.

    With it come the kinds of the features that are in the file but not in the site, by
    id, and what is wrong with shapes.
    """
    header = content.header
    broken = dict(content.broken)
    findings: list[SiteProblem] = []
    made: list[object] = []
    for feature in content.features:
        try:
            made.append(_CONVERSIONS[type(feature)](feature))
        except _ShapeError as error:
            broken[feature.id] = _KINDS[type(feature)]
            findings.append(SiteProblem(feature.id, error.rule, str(error)))
    if header is None:
        return None, broken, findings

    def all_of(kind: type[_Record]) -> tuple[_Record, ...]:
        return tuple(each for each in made if isinstance(each, kind))

    anchor = header.anchor
    site = records.Site(
        name=header.name,
        title=header.title,
        floor=header.floor,
        ceiling_height=header.ceiling_height_m,
        description=header.description,
        anchor=anchor
        and records.Anchor(
            anchor.latitude, anchor.longitude, _radians(anchor.bearing_deg)
        ),
        corridors=all_of(records.Corridor),
        areas=all_of(records.Area),
        turning_points=all_of(records.TurningPoint),
        rooms=all_of(records.Room),
        doors=all_of(records.Door),
        landmarks=all_of(records.Landmark),
        routes=all_of(records.Route),
        source=source,
        # Halves of characters in members that nothing reads stay what they are in JSON.
        plan=json.dumps(content.document, ensure_ascii=False).encode(
            "utf-8", "backslashreplace"
        ),
    )
    return site, broken, findings


def _radians(degrees: float) -> float:
    return wrap_angle(math.radians(degrees))


def _points(positions: Sequence[Sequence[float]]) -> list[tuple[float, float]]:
    return [(position[0], position[1]) for position in positions]


def _polygon(rings: Sequence[Sequence[Sequence[float]]]) -> Polygon:
    for number, ring in enumerate(rings):
        which = "outline" if number == 0 else f"hole {number}"
        if len(ring) < 4:
            raise _ShapeError(
                "ring-closed",
                f"expected at least 3 corners and the first one again in the {which}, "
                f"got {len(ring)} positions",
            )
        if ring[0][:2] != ring[-1][:2]:
            raise _ShapeError(
                "ring-closed",
                f"expected the {which} to end where it starts, at {ring[0][:2]}, got "
                f"{ring[-1][:2]}; repeat the first position at the end",
            )
    polygon = Polygon(_points(rings[0]), [_points(ring) for ring in rings[1:]])
    if not polygon.is_valid:
        raise _ShapeError(
            "polygon-valid",
            "expected a simple polygon with its holes inside, got: "
            f"{explain_validity(polygon)}",
        )
    if polygon.area < SMALLEST_AREA:
        raise _ShapeError(
            "polygon-valid",
            f"expected an area of at least {SMALLEST_AREA} m², got {polygon.area:.2g} m²; "
            "coordinates are metres, not degrees of longitude and latitude",
        )
    return polygon


def _line(positions: Sequence[Sequence[float]]) -> LineString:
    points = _points(positions)
    for first, second in pairwise(points):
        if math.dist(first, second) < SHORTEST_LINE:
            raise _ShapeError(
                "line-steps",
                f"expected positions at least {SHORTEST_LINE} m apart, got {first} and "
                f"{second}; remove one",
            )
    return LineString(points)


# Where a record is shaped as a plan is, its fields are called as the plan's members.


def _corridor(feature: models.CorridorFeature) -> records.Corridor:
    rings = feature.geometry.coordinates
    polygon = _polygon(rings)
    corners = len(rings[0]) - 1
    sides = [
        math.dist(a[:2], b[:2]) for a, b in zip(rings[0], rings[0][1:], strict=False)
    ]
    hull = polygon.convex_hull.area
    if len(rings) > 1 or corners != 4 or min(sides) < SHORTEST_LINE:
        raise _ShapeError(
            "corridor-four-corners",
            f"expected exactly 4 corners and no holes, got {corners} corners and "
            f"{len(rings) - 1} holes; split a bent corridor in two, or make it an area",
        )
    if hull - polygon.area > CONVEX_SLACK:
        raise _ShapeError(
            "corridor-convex",
            f"expected a convex shape, got one that lacks {hull - polygon.area:.3f} m² "
            "of its hull; move the corner that points inwards, or make it an area",
        )
    return records.Corridor(feature.id, polygon, **dict(feature.properties))


def _area(feature: models.AreaFeature) -> records.Area:
    polygon = _polygon(feature.geometry.coordinates)
    return records.Area(feature.id, polygon, **dict(feature.properties))


def _turning_point(feature: models.TurningPointFeature) -> records.TurningPoint:
    properties = feature.properties
    return records.TurningPoint(
        feature.id,
        _polygon(feature.geometry.coordinates),
        properties.name,
        properties.shape,
        tuple(
            records.Exit(way.to, _radians(way.heading_deg)) for way in properties.exits
        ),
    )


def _room(feature: models.RoomFeature) -> records.Room:
    polygon = _polygon(feature.geometry.coordinates)
    return records.Room(feature.id, polygon, **dict(feature.properties))


def _door(feature: models.DoorFeature) -> records.Door:
    line = _line(feature.geometry.coordinates)
    return records.Door(feature.id, line, **dict(feature.properties))


def _landmark(feature: models.LandmarkFeature) -> records.Landmark:
    properties = feature.properties
    length, depth, height = properties.size_m
    return records.Landmark(
        feature.id,
        Point(_points([feature.geometry.coordinates])[0]),
        properties.category,
        properties.color,
        properties.name,
        properties.text,
        _radians(properties.heading_deg),
        (length, depth, height),
        properties.mount,
        properties.obstacle,
    )


def _route(feature: models.RouteFeature) -> records.Route:
    properties = feature.properties
    line = _line(feature.geometry.coordinates)
    return records.Route(
        feature.id,
        line,
        properties.route,
        properties.role,
        _radians(properties.start_heading_deg),
        properties.goal,
        properties.goal_landmark,
        line.length if properties.length_m is None else properties.length_m,
        tuple(records.RouteTurn(turn.at, turn.direction) for turn in properties.turns),
        properties.note,
    )


_CONVERSIONS: dict[type[models.FeatureModel], Callable[..., object]] = {
    models.CorridorFeature: _corridor,
    models.AreaFeature: _area,
    models.TurningPointFeature: _turning_point,
    models.RoomFeature: _room,
    models.DoorFeature: _door,
    models.LandmarkFeature: _landmark,
    models.RouteFeature: _route,
}

_KINDS = {model: kind for kind, model in models.FEATURE_MODELS.items()}
