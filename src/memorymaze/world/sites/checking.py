"""All rules of the format over one plan, with those of the benchmark's floors.

What each rule means is in `docs/buildings.md`.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from memorymaze.world.sites import plan_models as models
from memorymaze.world.sites.floor_rules import (
    exact_floor,
    extent_findings,
    floor_findings,
    thing_findings,
)
from memorymaze.world.sites.loading import SNAKE_CASE, refuse, site_from_content
from memorymaze.world.sites.loading_rules import (
    FLOOR_RULES,
    floor_is_complete,
    loading_findings,
)
from memorymaze.world.sites.problems import PLAN, Rule, SiteProblem
from memorymaze.world.sites.reading import PlanContent, read_plan
from memorymaze.world.sites.records import Site
from memorymaze.world.sites.route_rules import route_findings
from memorymaze.world.sites.shape_rules import shape_problem
from memorymaze.world.sites.things import problems_of_categories


@dataclass(frozen=True, slots=True)
class _Expected:
    turning_points: int = 14
    things: int = 70
    route_lengths: dict[str, float] = field(default_factory=dict[str, float])
    """Metres of the reference routes as published (paper, Table I)."""


ANY_FLOOR = _Expected()
PUBLISHED = {
    "university": _Expected(20, 120, {"R1": 40.27, "R2": 156.68}),
    "museum_5f": _Expected(route_lengths={"R1": 71.18, "R2": 44.05}),
    "museum_7f": _Expected(route_lengths={"R1": 86.10, "R2": 79.40}),
}
LENGTH_SLACK = 0.005
"""Metres."""

FLOOR_MATERIALS = ("carpet", "linoleum", "wood", "concrete", "tile")
WALL_MATERIALS = ("plaster", "glass", "wood_panel", "brick", "concrete")
ROOM_USES = (
    "classroom",
    "office",
    "kitchen",
    "library",
    "conference_room",
    "restroom",
    "storage",
    "exhibit",
    "lab",
    "shop",
    "hall",
    "stairwell",
)
DOOR_STYLES = ("wood", "glass", "steel", "automatic_glass", "elevator", "fire")
WORDS = {
    "floor_material": FLOOR_MATERIALS,
    "wall_material": WALL_MATERIALS,
    "use": ROOM_USES,
    "style": DOOR_STYLES,
}
"""The words of the format, by member."""


def find_site_problems(path: str | Path) -> list[SiteProblem]:
    """Find everything in a plan that breaks a rule of the format.

    What `load_site` refuses comes first. Where floor is broken or in pieces, the rules
    that build on it are not looked at.

    Args:
        path: A GeoJSON file; it need not exist.

    Returns:
        All problems; no error among them means that the plan keeps the format.
    """
    path = Path(path)
    return plan_problems(read_plan(path), path)


def plan_problems(content: PlanContent, path: Path) -> list[SiteProblem]:
    """Find everything in what was read of a plan that breaks a rule of the format."""
    site, broken, findings = site_from_content(content, str(path))
    findings = [*content.findings, *findings]
    if site is not None:
        findings += _findings_together(site, broken, site.name in PUBLISHED)
    findings += _findings_as_written(content.header, content.features, path)
    return [each._replace(file=str(path)) for each in findings]


def made_site_problems(site: Site) -> list[SiteProblem]:
    """Find every rule that a building breaks which no plan was read of.

    It is held to the size of the benchmark's floors too. Broken shapes come alone.
    """
    findings = [
        SiteProblem(each, "unique-id", f"expected an id of its own, got {each!r} twice")
        for each, count in Counter(part.id for part in site.parts).items()
        if count > 1
    ]
    findings += filter(None, map(shape_problem, site.parts))
    if not findings:
        findings += _findings_together(site, {}, has_size=True)
        for part in site.parts:
            findings += _word_findings(part.id, part)
    return findings


def check_drawn(site: Site) -> None:
    """Refuse a building with words for surfaces or doors that have no look."""
    findings = [
        finding
        for part in (*site.floor_parts, *site.doors)
        for finding in _word_findings(part.id, part)
        if finding.rule == "known-word"
    ]
    refuse(site.source or site.name, findings)


def _findings_together(
    site: Site, broken: Mapping[str, str], has_size: bool
) -> list[SiteProblem]:
    """Find what is wrong with sound features seen together."""
    findings = [*loading_findings(site, broken), *problems_of_categories(site)]
    if floor_is_complete(broken) and not any(
        finding.rule in FLOOR_RULES for finding in findings
    ):
        findings += _findings_on_floor(site, has_size=has_size)
    if has_size and not broken:
        findings += _benchmark_findings(site)
    return findings


def _findings_on_floor(site: Site, *, has_size: bool) -> Iterator[SiteProblem]:
    floor = exact_floor(site)
    if has_size:
        yield from extent_findings(floor)
    yield from floor_findings(site, floor)
    yield from thing_findings(site, floor)
    yield from route_findings(site, floor)


def _benchmark_findings(site: Site) -> Iterator[SiteProblem]:
    """Find where a sound site differs in size from the benchmark's floors."""
    expected = PUBLISHED.get(site.name, ANY_FLOOR)
    things = len(site.doors) + len(site.landmarks)
    counts: tuple[tuple[Rule, str, int, int], ...] = (
        (
            "turning-point-count",
            "turning points",
            expected.turning_points,
            len(site.turning_points),
        ),
        ("thing-count", "doors and landmarks", expected.things, things),
    )
    for rule, what, least, got in counts:
        if got < least:
            yield SiteProblem(
                PLAN,
                rule,
                f"expected at least {least} {what}, as in the benchmark, got {got}",
                "warning",
            )
    references = {each.route: each for each in site.routes if each.role == "reference"}
    if references.keys() != {"R1", "R2"}:
        yield SiteProblem(
            PLAN,
            "route-names",
            "expected reference routes R1 and R2, as in the benchmark, got "
            f"{', '.join(sorted(references)) or 'none'}",
            "warning",
        )
    for name, length in expected.route_lengths.items():
        route = references.get(name)
        if route and abs(route.line.length - length) > LENGTH_SLACK + 1e-9:
            yield SiteProblem(
                route.id,
                "published-length",
                f"expected {length} m, the published length of {name} in {site.name}, "
                f"got {route.line.length:.3f} m",
            )


def _findings_as_written(
    header: models.PlanHeader | None,
    features: Sequence[models.AnyFeature],
    path: Path,
) -> Iterator[SiteProblem]:
    """Find words, names and angles that are usable but not those of the format."""
    if header and header.name != path.stem:
        yield SiteProblem(
            PLAN,
            "name-is-stem",
            f"expected the name to be the file's stem, {path.stem!r}, got "
            f"{header.name!r}; instructions refer to the name",
            "warning",
        )
    for feature in features:
        yield from _word_findings(feature.id, feature.properties)
        for member, degrees in _headings(feature):
            if not 0 <= degrees < 360:
                turned = math.fmod(math.fmod(degrees, 360) + 360, 360)
                yield SiteProblem(
                    feature.id,
                    "heading-range",
                    f"{member}: expected degrees in [0, 360), got {degrees:g}, which is "
                    f"read as {turned:g}",
                    "warning",
                )


def _word_findings(identity: str, said: object) -> Iterator[SiteProblem]:
    """Find an id and words that are not those of the format."""
    if not SNAKE_CASE.fullmatch(identity):
        yield SiteProblem(
            identity,
            "id-snake-case",
            "expected an id in lower-case letters, digits and underscores",
            "warning",
        )
    for member, known in WORDS.items():
        word = vars(said).get(member)
        if word is not None and word not in known:
            yield SiteProblem(
                identity,
                "known-word",
                f"{member}: expected one of {', '.join(known)}, got {word!r}, which is "
                + ("kept" if member == "use" else "refused by cameras and exports"),
                "warning",
            )


def _headings(feature: models.AnyFeature) -> Iterator[tuple[str, float]]:
    said = vars(feature.properties)
    for way in said.get("exits", ()):
        yield "exits.heading_deg", way.heading_deg
    for member in ("heading_deg", "start_heading_deg"):
        if member in said:
            yield member, said[member]
