"""All rules of the format over one plan; what each means is in `docs/site_plans.md`."""

from collections.abc import Iterator
from pathlib import Path

from memorymaze.sites.benchmark_rules import benchmark_findings, wording_findings
from memorymaze.sites.conversion import site_from_content
from memorymaze.sites.floor_rules import exact_floor, floor_findings
from memorymaze.sites.problems import Finding, SiteProblem
from memorymaze.sites.reading import read_plan
from memorymaze.sites.records import Site
from memorymaze.sites.route_rules import route_findings
from memorymaze.sites.soundness import (
    FLOOR_RULES,
    floor_is_complete,
    soundness_findings,
)
from memorymaze.sites.thing_rules import thing_findings


def check_site(path: str | Path) -> list[SiteProblem]:
    """Find everything in a plan that breaks a rule of the format.

    What `load_site` refuses comes first. Where floor is broken or in pieces, the rules
    that build on it are not looked at.

    Args:
        path: A GeoJSON file; it need not exist.

    Returns:
        All problems; no error among them means that the plan keeps the format.
    """
    path = Path(path)
    content = read_plan(path)
    site, broken, findings = site_from_content(content, str(path))
    findings = [*content.findings, *findings]
    if site is not None:
        unsound = soundness_findings(site, broken)
        findings += unsound
        if floor_is_complete(broken) and not any(
            finding.rule in FLOOR_RULES for finding in unsound
        ):
            findings += _findings_on_floor(site)
        if not broken:
            findings += benchmark_findings(site)
    findings += wording_findings(content.header, content.features, path)
    return [finding.in_file(str(path)) for finding in findings]


def _findings_on_floor(site: Site) -> Iterator[Finding]:
    floor = exact_floor(site)
    yield from floor_findings(site, floor)
    yield from thing_findings(site, floor)
    yield from route_findings(site, floor)
