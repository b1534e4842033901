import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.asking import is_this, way_to, where_is
from memorymaze.texts.passers_by import FloorKnowledge
from memorymaze.texts.passers_by.bank import load_bank
from memorymaze.texts.passers_by.memory import (
    Memory,
    misremembered,
    told_plan,
    way_facts,
)
from memorymaze.world.sites import Site

Knowing = Callable[[Site], FloorKnowledge]

STEM = Pose(0, -6, math.pi / 2)
"""Before the T junction, facing it."""


@pytest.fixture
def memory(knowing: Knowing, t_site: Site) -> Memory:
    return Memory((7,), knowing(t_site), load_bank(), 0.0, 3.0)


@pytest.fixture
def knowing_one(memory: Memory) -> Memory:
    """Somebody who does not say that they do not know."""
    return next(
        each
        for seed in range(20)
        for each in [replace(memory, seed=(seed,))]
        if each.answer(way_to("the library"), STEM).truth == "right"
    )


def test_as_many_people_err_as_the_rate_says(memory: Memory) -> None:
    people = [replace(memory, seed=(n,), error_rate=0.4) for n in range(400)]
    assert sum(not each.is_reliable for each in people) == pytest.approx(160, abs=30)


def test_some_do_not_know(memory: Memory) -> None:
    people = [replace(memory, seed=(n,)) for n in range(100)]
    told = [each.answer(way_to("the library"), STEM).truth for each in people]
    assert 3 < told.count("unknown") < 20
    assert told.count("wrong") == 0


def test_a_right_way_tells_the_turn_and_a_wrong_one_does_not(memory: Memory) -> None:
    way = memory.floor.way_to("the library", STEM)
    assert way is not None
    rng = np.random.default_rng(0)
    plan = told_plan(way.facts, rng)
    facts = way_facts(way, plan, plan)
    assert facts.start == "ahead"
    assert [turn.side for turn in facts.turns] == ["left"]
    assert facts.end == "end"
    assert facts.destination == "the library"
    assert way.facts.follow(plan).arrived


def ways_told_wrongly_that_arrive(floor: FloorKnowledge) -> list[tuple[str, int, str]]:
    """Walk on the plan what people say who err, from the start of each route."""
    arriving: list[tuple[str, int, str]] = []
    for route in floor.site.routes:
        way = floor.way_to(route.goal, route.start)
        assert way is not None
        for seed in range(4):
            rng = np.random.default_rng(seed)
            remembered = misremembered(way, told_plan(way.facts, rng), rng)
            assert remembered is not None
            plan, error = remembered
            if not way.facts.is_wrong(plan):
                arriving.append((route.id, seed, error))
    return arriving


@pytest.mark.parametrize("name", ["museum_5f", "museum_7f", "university", "hospital"])
def test_a_wrong_answer_leads_nobody_there(
    builtin_sites: dict[str, Site],
    made_building: Callable[[str], Site],
    knowing: Knowing,
    name: str,
) -> None:
    site = builtin_sites.get(name) or made_building(name)
    assert ways_told_wrongly_that_arrive(knowing(site)) == []


@pytest.mark.parametrize("seed", range(6))
def test_wrong_people_are_wrong_about_everything(
    knowing_one: Memory, seed: int
) -> None:
    wrong = replace(knowing_one, kind="wrong", seed=(seed,))
    for question in (
        way_to("the library"),
        where_is("the chair"),
        is_this("the library"),
    ):
        told = wrong.answer(question, STEM)
        assert told.truth == "wrong"
        assert told.error


def test_empty_people_know_nothing(memory: Memory) -> None:
    empty = replace(memory, kind="empty")
    asked = (way_to("the library"), where_is("the chair"), is_this("the library"))
    assert {empty.answer(each, STEM).truth for each in asked} == {"unknown"}


def test_a_place_the_floor_does_not_have_is_not_known(knowing_one: Memory) -> None:
    assert knowing_one.answer(where_is("the aquarium"), STEM).truth == "unknown"
    assert knowing_one.answer(way_to("the casino"), STEM).truth == "unknown"


def test_nobody_takes_a_place_for_one_that_is_far_away(memory: Memory) -> None:
    far = Pose(0, -9, math.pi / 2)
    for seed in range(20):
        person = replace(memory, seed=(seed,), error_rate=1.0)
        assert person.answer(is_this("the library"), far).truth != "wrong"
