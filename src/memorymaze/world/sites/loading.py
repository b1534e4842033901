"""Sites from plans: those of this package, files and folders, made into records."""

import os
import re
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, cast

from pydantic import BaseModel
from shapely import LineString, Point, Polygon

from memorymaze.basics.errors import SettingsError, SitePlanError, did_you_mean
from memorymaze.basics.options import check_kind
from memorymaze.world.sites import plan_models as models
from memorymaze.world.sites import records
from memorymaze.world.sites.loading_rules import loading_findings
from memorymaze.world.sites.plan import heading_of
from memorymaze.world.sites.problems import SiteProblem
from memorymaze.world.sites.reading import PlanContent, read_plan
from memorymaze.world.sites.shape_rules import shape_problem

SNAKE_CASE = re.compile(r"[a-z0-9]+(_[a-z0-9]+)*")

BUILTIN_SITE_NAMES: tuple[str, ...] = ("university", "museum_5f", "museum_7f")
"""The three floors of the benchmark."""


def load_site(site: str | Path) -> records.Site:
    """Load one of the benchmark's sites, or a plan.

    Args:
        site: `university`, `museum_5f` or `museum_7f`; else a GeoJSON file in the
            format of `docs/buildings.md`.

    Raises:
        SettingsError: There is neither.
        SitePlanError: The plan cannot be used. The message names file, feature and
            rule of the first problem, and how many more there are.
    """
    if site in BUILTIN_SITE_NAMES:
        return _builtin_site(str(site))
    return _site_of(plan_file(site))


@cache
def _builtin_site(name: str) -> records.Site:
    """Load one of the benchmark's sites once: neither its plan nor a `Site` changes."""
    return _site_of(plan_file(name))


def _site_of(path: Path) -> records.Site:
    return sound_site(read_plan(path), str(path))


def sound_site(plan: PlanContent, source: str) -> records.Site:
    """Return the site of a plan, or say why it cannot be used."""
    site, broken, findings = site_from_content(plan, source)
    findings = [*plan.findings, *findings]
    if site is not None:
        findings += loading_findings(site, broken)
    refuse(source, findings)
    return cast(records.Site, site)  # without one there are findings


def check_sound(site: records.Site) -> None:
    """Refuse a building that was made in memory and cannot be used."""
    flaws = [flaw for flaw in map(shape_problem, site.parts) if flaw is not None]
    refuse(site.source or site.name, flaws or loading_findings(site, {}))


def refuse(source: str, findings: Sequence[SiteProblem]) -> None:
    """Raise with the first thing that is wrong, and how many more there are."""
    if not findings:
        return
    first, *others = findings
    more = (
        f" ({len(others)} more: see them all with `memorymaze sites check {source}`)"
        if others
        else ""
    )
    raise SitePlanError(
        f"{source}: {first.feature}: {first.rule}: {first.message}{more}"
    )


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
    return sites_by_name(map(load_site, plan_paths(Path(folder))))


def sites_by_name(sites: Iterable[records.Site]) -> dict[str, records.Site]:
    """Return sites by name; SitePlanError says that two have the same."""
    named: dict[str, records.Site] = {}
    for site in sites:
        if site.name in named:
            raise SitePlanError(
                f"{site.source}: -: name: expected a name of its own for every plan, "
                f"got {site.name!r} as in {named[site.name].source}; change one"
            )
        named[site.name] = site
    return named


def plan_paths(folder: Path) -> list[Path]:
    """Return the plans in a folder by file name; there has to be one at least."""
    if not folder.is_dir():
        raise SitePlanError(
            f"{folder}: expected a folder with site plans (*.geojson), got "
            f"{'a file' if folder.exists() else 'none: no such folder'}",
            is_missing=not folder.exists(),
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
    wanted = f"a plan's file or one of {', '.join(BUILTIN_SITE_NAMES)}"
    check_kind("site", site, str | os.PathLike, wanted)
    if not site or not Path(site).exists():
        raise SettingsError(
            f"site: expected {wanted}, got {str(site)!r}: no such file"
            f"{did_you_mean(site, BUILTIN_SITE_NAMES)}"
        )
    return Path(site)


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
    made: list[records.PlanPart] = []
    for feature in content.features:
        part = _part_or_problem(feature)
        if isinstance(part, SiteProblem):
            broken[feature.id] = _more(feature.properties)["kind"]
            findings.append(part)
        else:
            made.append(part)
    if header is None:
        return None, broken, findings
    told, more = _told_in(header), _more(header)
    del told["type"]
    more.pop("features", None)
    site = records.Site(**told, **records.parts_by_kind(made), more=more, source=source)
    return site, broken, findings


def _told_in(said: BaseModel) -> dict[str, Any]:
    """Return what members say, called and measured as records have it."""
    told: dict[str, Any] = {}
    for member in type(said).model_fields:
        name, _, unit = member.rpartition("_")
        value = getattr(said, member)
        if unit == "deg":
            told[name] = heading_of(value)
        elif unit == "m":
            told[name] = tuple(value) if isinstance(value, list) else value
        elif member in _WITHIN and value is not None:
            kind, many = _WITHIN[member], isinstance(value, list)
            made = [kind(**_told_in(each)) for each in (value if many else [value])]
            told[member] = tuple(made) if many else made[0]
        else:
            told[member] = value
    return told


def _part_or_problem(feature: models.AnyFeature) -> records.PlanPart | SiteProblem:
    geometry = feature.geometry
    if isinstance(geometry, models.PolygonGeometry):
        for number, ring in enumerate(geometry.coordinates):
            problem = _open_ring(feature.id, number, ring)
            if problem is not None:
                return problem
        outline, *holes = map(_points, geometry.coordinates)
        shape = Polygon(outline, holes)
    elif isinstance(geometry, models.PointGeometry):
        shape = Point(_points([geometry.coordinates]))
    else:
        shape = LineString(_points(geometry.coordinates))
    told, more = _told_in(feature.properties), _more(feature.properties)
    if told.get("length", shape) is None:
        told["length"] = shape.length
    part = _RECORDS[more.pop("kind")](feature.id, shape, **told, more=more)
    return shape_problem(part) or part


def _open_ring(
    identity: str, number: int, ring: Sequence[Sequence[float]]
) -> SiteProblem | None:
    """Return what is wrong with a ring of a polygon as it is written."""
    which = "outline" if number == 0 else f"hole {number}"
    if len(ring) < 4:
        return SiteProblem(
            identity,
            "ring-closed",
            f"expected at least 3 corners and the first one again in the {which}, "
            f"got {len(ring)} positions",
        )
    if ring[0][:2] != ring[-1][:2]:
        return SiteProblem(
            identity,
            "ring-closed",
            f"expected the {which} to end where it starts, at {ring[0][:2]}, got "
            f"{ring[-1][:2]}; repeat the first position at the end",
        )
    return None


def _points(positions: Sequence[Sequence[float]]) -> list[tuple[float, float]]:
    return [(position[0], position[1]) for position in positions]


def _more(members: BaseModel) -> dict[str, Any]:
    """Return the members that no model reads."""
    return dict(members.model_extra or {})


_WITHIN: dict[str, Callable[..., object]] = {
    "anchor": records.Anchor,
    "exits": records.Exit,
    "turns": records.RouteTurn,
}
_RECORDS: dict[str, Callable[..., records.PlanPart]] = {
    record.kind: record for record in records.PART_KINDS
}
