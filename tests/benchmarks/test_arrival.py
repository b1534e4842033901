import argparse
from collections.abc import Callable
from pathlib import Path

import pytest
from benchmarks.arrival import (
    ArrivalCase,
    arrival_cases,
    arrival_row,
    destinations_of,
    with_ways,
)
from benchmarks.plan_walks import (
    PlanWalk,
    given_plans,
    plan_instruction,
    walk_plans,
)

from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.world.sites import Site


@pytest.fixture(scope="module")
def box_case(loop_site: Site) -> ArrivalCase:
    cases = arrival_cases(loop_site, sample=None, seed=0)
    return next(each for each in cases if each.destination.thing.words == "yellow box")


def test_a_destination_is_told_by_two_turns_its_name_and_its_side(
    box_case: ArrivalCase,
) -> None:
    plan = box_case.plan
    assert [leg.turn.way for leg in plan.legs] == ["right", "right"]
    assert plan.arrival.destinations == ("yellow box",)
    assert plan.arrival.side is not None
    assert plan.arrival.length is None


def test_what_there_is_twice_is_no_destination(builtin_sites: dict[str, Site]) -> None:
    words = [each.thing.words for each in destinations_of(builtin_sites["university"])]
    assert "room 2103" in words
    assert "red fire extinguisher" not in words
    assert len(set(words)) == len(words)


@pytest.mark.proof
@pytest.mark.parametrize("name", ["oracle", "guide"])
def test_a_perfect_plan_leads_to_its_destination(
    name: str, loop_site: Site, box_case: ArrivalCase, tmp_path: Path
) -> None:
    site = with_ways(loop_site, [box_case], tmp_path / "plans")
    told = plan_instruction("box", site, box_case.route, box_case.plan)
    agent = given_plans(AgentSettings(name))
    options = argparse.Namespace(seed=0, workers=1, out=tmp_path)
    walks = walk_plans(agent, [told], {site.name: site}, options)
    assert walks["box"].result.success
    assert arrival_row("thing", list(walks.values()))["sr_1.5"] == 1


@pytest.mark.parametrize(
    ("success", "stopped_by", "gave_up", "false"),
    [
        pytest.param(True, "agent", False, 0, id="there"),
        pytest.param(False, "agent", False, 1, id="elsewhere"),
        pytest.param(False, "agent", True, 0, id="gave up"),
        pytest.param(False, "budget", False, 0, id="cut off"),
    ],
)
def test_who_says_that_it_is_there_and_is_not_arrives_falsely(
    result: Callable[..., EpisodeResult],
    success: bool,
    stopped_by: str,
    gave_up: bool,
    false: float,
) -> None:
    walk = PlanWalk(result(success=success, stopped_by=stopped_by, gave_up=gave_up), ())
    assert arrival_row("thing", [walk])["false"] == false


def test_who_was_at_the_goal_and_ended_elsewhere_passed_it(
    result: Callable[..., EpisodeResult],
) -> None:
    near, never = (
        PlanWalk(result("a", spd=8.0, oracle_success=was), ()) for was in (True, False)
    )
    assert arrival_row("thing", [near, never])["passed"] == 0.5


def test_a_door_that_looks_like_others_is_told_by_the_name_on_it(
    builtin_sites: dict[str, Site],
) -> None:
    there = {
        each.thing.id: each for each in destinations_of(builtin_sites["university"])
    }
    assert there["door_library"].thing.words == "LIBRARY"
    assert there["door_library"].kind == "sign"
