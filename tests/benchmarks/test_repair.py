from collections.abc import Callable

import pytest
from benchmarks.plan_walks import Note, PlanWalk
from benchmarks.repair import (
    KINDS,
    Mutant,
    Twin,
    area_under_curve,
    doubts_of,
    legs_of_turns,
    mutants_of,
    repair_rows,
)

from memorymaze.language.plans import Arrival, Leg, RoutePlan, Turn
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph
from memorymaze.world.sites import Site

SIDES = ("right", "left", "right", "left")
"""Of University R1; the first corner leaves no choice."""


@pytest.fixture(scope="module")
def facts(builtin_sites: dict[str, Site]) -> RouteFacts:
    site = builtin_sites["university"]
    return RouteFacts(TurningPointGraph(site), site.find_route("R1"))


@pytest.fixture(scope="module")
def twin(facts: RouteFacts) -> Twin:
    legs = tuple(Leg(Turn(side)) for side in SIDES)
    plan = RoutePlan(legs=legs, arrival=Arrival(("library",)))
    told = legs_of_turns(plan, facts)
    assert told is not None
    return Twin("twin", facts.graph.site, facts.route, plan, told)


@pytest.fixture(scope="module")
def mutants(twin: Twin, facts: RouteFacts) -> dict[str, Mutant]:
    return {each.kind: each for each in mutants_of(twin, facts.graph, seed=0)}


def differing(twin: Twin, mutant: Mutant) -> list[tuple[Leg, Leg]]:
    pairs = zip(twin.plan.legs, mutant.plan.legs, strict=True)
    return [(right, wrong) for right, wrong in pairs if right != wrong]


def test_a_plan_can_have_every_kind_of_error(mutants: dict[str, Mutant]) -> None:
    assert set(mutants) == set(KINDS)


def test_a_wrong_side_changes_one_turn_and_nothing_else(
    twin: Twin, mutants: dict[str, Mutant]
) -> None:
    mutant = mutants["wrong_direction"]
    [(right, wrong)] = differing(twin, mutant)
    assert {right.turn.way, wrong.turn.way} == {"left", "right"}
    assert mutant.plan.arrival == twin.plan.arrival


def test_another_turning_point_keeps_the_side(
    twin: Twin, mutants: dict[str, Mutant]
) -> None:
    [(right, wrong)] = differing(twin, mutants["wrong_turning_point"])
    assert wrong.turn.way == right.turn.way
    assert wrong.turn.ordinal is not None


def test_a_missing_turn_is_one_leg_less_and_an_extra_one_a_leg_more(
    twin: Twin, mutants: dict[str, Mutant]
) -> None:
    missing, extra = mutants["missing_turn"].plan, mutants["extra_turn"].plan
    legs = [leg.turn.way for leg in twin.plan.legs]
    assert len(missing.legs) == len(legs) - 1
    assert len(extra.legs) == len(legs) + 1
    assert set(missing.legs) <= set(twin.plan.legs) <= set(extra.legs)


def test_a_wrong_destination_keeps_the_name_and_cuts_the_way_at_most(
    twin: Twin, mutants: dict[str, Mutant]
) -> None:
    plan = mutants["wrong_destination"].plan
    assert plan.arrival.destinations == twin.plan.arrival.destinations
    assert plan.legs == twin.plan.legs[: len(plan.legs)]
    assert plan.arrival.mentions


def test_a_thing_that_is_not_there_marks_a_turn(
    twin: Twin, mutants: dict[str, Mutant]
) -> None:
    mutant = mutants["inaccurate_environment"]
    [(_, wrong)] = differing(twin, mutant)
    [thing] = wrong.mentions
    here = {each.words for each in TurningPointGraph(twin.site).things}
    assert thing.phrase not in here


def test_a_corner_without_a_choice_may_be_left_out_of_a_plan(facts: RouteFacts) -> None:
    legs = tuple(Leg(Turn(side)) for side in SIDES[1:])
    assert legs_of_turns(RoutePlan(legs=legs), facts) == {
        "turn1": 0,
        "turn2": 1,
        "turn3": 2,
    }


def test_a_plan_that_turns_elsewhere_is_left_out(facts: RouteFacts) -> None:
    legs = tuple(Leg(Turn(side)) for side in ("right", "right", "right", "left"))
    assert legs_of_turns(RoutePlan(legs=legs), facts) is None


@pytest.mark.parametrize(
    ("wrong", "right", "area"),
    [
        pytest.param([3, 4], [1, 2], 1.0, id="told apart"),
        pytest.param([1, 2], [3, 4], 0.0, id="the wrong way round"),
        pytest.param([1, 1], [1, 1], 0.5, id="never told apart"),
        pytest.param([2], [1, 2, 3, 1], 0.625, id="between"),
    ],
)
def test_the_area_under_the_curve_counts_pairs_in_the_right_order(
    wrong: list[float], right: list[float], area: float
) -> None:
    assert area_under_curve(wrong, right) == area


def walk(made: EpisodeResult, *notes: tuple[str, str, float, float]) -> PlanWalk:
    """Return a walk along x, with notes: kind, field, value, place."""
    written = (Note(kind, {field: value}, (x, 0.0)) for kind, field, value, x in notes)
    return PlanWalk(made, tuple(written))


def test_a_doubt_is_placed_where_it_is_first_at_least_even(
    result: Callable[..., EpisodeResult],
) -> None:
    doubting = walk(
        result(),
        ("doubt", "score", 0.2, 1.0),
        ("doubt", "score", 0.6, 3.0),
        ("doubt", "score", 0.9, 4.0),
    )
    doubt = doubts_of({"walk": doubting})["walk"]
    assert doubt == (0.9, (3.0, 0.0))


def test_what_is_repaired_is_counted_where_the_twin_arrives(
    result: Callable[..., EpisodeResult], twin: Twin, mutants: dict[str, Mutant]
) -> None:
    mutant = mutants["extra_turn"]
    walks = {
        twin.name: walk(result(success=True)),
        mutant.name: walk(result(success=True, path_length=100.0, way_m=40.0)),
    }
    rows = {row["kind"]: row for row in repair_rows(walks, [mutant])}
    row = rows[KINDS["extra_turn"]]
    assert row["repaired"] == 1
    assert [row[f"within_{times}"] for times in ("1", "1.5", "2", "3")] == [0, 0, 0, 1]
    assert "auc" not in row
