"""Loading sites from plans in files, from folders, and from this package."""

from pathlib import Path

from memorymaze.errors import SettingsError, SitePlanError, did_you_mean
from memorymaze.sites.conversion import site_from_content
from memorymaze.sites.reading import read_plan
from memorymaze.sites.records import Site
from memorymaze.sites.soundness import soundness_findings

BUILTIN_SITE_NAMES: tuple[str, ...] = ("university", "museum_5f", "museum_7f")
"""The three floors of the benchmark."""


def load_site(site: str | Path) -> Site:
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
    plan = read_plan(path)
    made, broken, shape_findings = site_from_content(plan, str(path))
    findings = [*plan.findings, *shape_findings]
    if made is not None:
        findings += soundness_findings(made, broken)
    if findings or made is None:
        first, *others = findings
        more = (
            f" ({len(others)} more: see them all with `memorymaze sites check {path}`)"
            if others
            else ""
        )
        raise SitePlanError(
            f"{path}: {first.feature}: {first.rule}: {first.message}{more}"
        )
    return made


def load_sites(folder: str | Path | None = None) -> dict[str, Site]:
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
    sites: dict[str, Site] = {}
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
    """Return the plans in a folder by file name.

    Raises:
        SitePlanError: The folder is missing or has no plan in it.
    """
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
    """Return the plan's file of one of the benchmark's sites, or the file of this name.

    Raises:
        SettingsError: There is neither; says which sites there are.
    """
    if site in BUILTIN_SITE_NAMES:
        return Path(__file__).parent / "data" / f"{site}.geojson"
    if not site or not Path(site).exists():
        raise SettingsError(
            f"site: expected a plan's file or one of {', '.join(BUILTIN_SITE_NAMES)}, "
            f"got {str(site)!r}: no such file{did_you_mean(site, BUILTIN_SITE_NAMES)}"
        )
    return Path(site)
