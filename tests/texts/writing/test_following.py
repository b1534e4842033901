"""A plan is walked as a listener would walk it who knows nothing else."""

from dataclasses import replace

from memorymaze.texts.writing.following import follow_steps
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.steps import Cue


def test_the_right_plan_of_every_route_arrives(all_facts: list[RouteFacts]) -> None:
    for facts in all_facts:
        found = follow_steps(facts.graph, facts.route, facts.plan)
        assert found.arrived, (facts.graph.site.name, facts.route.id, found)
        assert found.turned == tuple(turn.at for turn in facts.route.turns)


def test_every_cue_of_a_turn_leads_to_its_turning_point(
    all_facts: list[RouteFacts],
) -> None:
    for facts in all_facts:
        for turn, cues in zip(facts.plan.turns, facts.cues, strict=True):
            for cue in cues:
                plan = facts.plan.with_turn(turn.key, cue=cue)
                assert follow_steps(facts.graph, facts.route, plan).arrived


def test_a_turn_to_where_no_way_lies_is_the_end_of_the_walk(
    university_r1: RouteFacts,
) -> None:
    plan = university_r1.plan.with_turn("turn0", side="left")
    found = follow_steps(university_r1.graph, university_r1.route, plan)
    assert not found.arrived
    assert found.lost == "no way lies left at tp_a_nw"


def test_a_thing_that_is_not_there_is_never_come_to(
    university_r1: RouteFacts,
) -> None:
    plan = university_r1.plan.with_turn("turn1", cue=Cue("thing", words="tame bear"))
    found = follow_steps(university_r1.graph, university_r1.route, plan)
    assert not found.arrived
    assert "tame bear" in found.lost


def test_the_second_opening_is_not_the_first(university_r1: RouteFacts) -> None:
    plan = university_r1.plan.with_turn("turn2", cue=Cue("ordinal", 2))
    found = follow_steps(university_r1.graph, university_r1.route, plan)
    assert found.turned[:3] != ("tp_a_nw", "tp_a_t", "tp_a_kit_w")


def test_a_corner_without_a_choice_needs_no_word(university_r1: RouteFacts) -> None:
    plan = university_r1.plan.with_turn("turn0", told=False)
    assert follow_steps(university_r1.graph, university_r1.route, plan).arrived


def test_a_walk_the_other_way_round_does_not_arrive(
    university_r1: RouteFacts,
) -> None:
    plan = replace(university_r1.plan, around=True)
    assert not follow_steps(university_r1.graph, university_r1.route, plan).arrived


def test_a_destination_away_from_the_last_stretch_is_not_found(
    university_r1: RouteFacts,
) -> None:
    arrival = replace(university_r1.plan.ending, place=(90.0, 20.0))
    plan = replace(university_r1.plan, ending=arrival)
    found = follow_steps(university_r1.graph, university_r1.route, plan)
    assert not found.arrived
    assert "destination" in found.lost
