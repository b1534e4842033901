from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.web.editor.proposals import completed, missing_turning_points
from memorymaze.world.sites import Site
from memorymaze.world.sites.checking import plan_problems
from memorymaze.world.sites.plan import site_plan
from memorymaze.world.sites.reading import understand_plan


def features_of(site: Site, kind: str) -> list[dict[str, Any]]:
    features = site_plan(site)["features"]
    return [each for each in features if each["properties"]["kind"] == kind]


def exits(feature: dict[str, Any]) -> list[tuple[str, int]]:
    found = feature["properties"]["exits"]
    return sorted((each["to"], round(each["heading_deg"])) for each in found)


@pytest.mark.parametrize("name", ["university", "museum_5f", "museum_7f"])
def test_what_is_proposed_for_doors_and_routes_is_what_the_plans_say(
    builtin_sites: dict[str, Site], name: str
) -> None:
    site = builtin_sites[name]
    for door in features_of(site, "door"):
        assert completed(door, site) == door
    for route in features_of(site, "route"):
        said, proposed = route["properties"], completed(route, site)["properties"]
        assert proposed["turns"] == said["turns"]
        heading = proposed["start_heading_deg"]
        assert heading == pytest.approx(said["start_heading_deg"], abs=0.5)


def test_exits_are_those_of_the_university(builtin_sites: dict[str, Site]) -> None:
    site = builtin_sites["university"]
    for point in features_of(site, "turning_point"):
        assert exits(completed(point, site)) == exits(point)


@pytest.mark.parametrize(
    "name", ["university", "museum_5f", "museum_7f", "loop", "l_shape"]
)
def test_turning_points_made_where_corridors_meet_pass_the_checks(
    builtin_sites: dict[str, Site], tiny_sites: dict[str, Site], name: str
) -> None:
    site = {**builtin_sites, **tiny_sites}[name]
    bare = replace(site, turning_points=(), routes=())
    made = list(missing_turning_points(bare, set()))
    assert len(made) >= (1 if name == "l_shape" else 4)
    plan = site_plan(site)
    floor = {"turning_point", "route"}
    kept = [e for e in plan["features"] if e["properties"]["kind"] not in floor]
    problems = plan_problems(
        understand_plan({**plan, "features": kept + made}), Path(site.source)
    )
    assert [each.line() for each in problems if each.severity == "error"] == []


def test_none_is_made_where_one_is_drawn(l_site: Site) -> None:
    assert list(missing_turning_points(l_site, set())) == []
