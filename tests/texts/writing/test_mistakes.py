"""Errors are errors: who follows them does not arrive."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from memorymaze.texts.corpus.error_kinds import ERROR_KINDS, kinds_of
from memorymaze.texts.writing.following import follow_steps
from memorymaze.texts.writing.mistakes import made_wrong, possible_mistakes
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.sampling import chosen_plan
from memorymaze.texts.writing.voices import make_voice

KINDS = [kind.name for kind in ERROR_KINDS]
QUIET = settings(
    max_examples=12,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


@QUIET
@given(
    seed=st.integers(0, 2**32), number=st.integers(0, 100), kind=st.sampled_from(KINDS)
)
def test_a_plan_with_an_error_does_not_arrive_and_without_it_does(
    all_facts: list[RouteFacts], seed: int, number: int, kind: str
) -> None:
    facts = all_facts[number % len(all_facts)]
    rng = np.random.default_rng(seed)
    study = "onsite" if kind in kinds_of("onsite") else "online"
    plan = chosen_plan(facts, make_voice(study, 1, rng), rng)
    assert follow_steps(facts.graph, facts.route, plan).arrived
    for mistake in list(possible_mistakes(facts, plan, kind, rng))[:3]:
        assert mistake.kind == kind
        assert not follow_steps(facts.graph, facts.route, mistake.plan).arrived


@QUIET
@given(seed=st.integers(0, 2**32), number=st.integers(0, 100))
def test_two_errors_lie_in_two_steps_and_do_not_undo_each_other(
    all_facts: list[RouteFacts], seed: int, number: int
) -> None:
    facts = all_facts[number % len(all_facts)]
    rng = np.random.default_rng(seed)
    made = made_wrong(facts, facts.plan, ("missing_turn", "extra_turn"), rng)
    assert len({mistake.key for mistake in made}) == len(made)
    if made:
        assert not follow_steps(facts.graph, facts.route, made[-1].plan).arrived


@pytest.mark.parametrize("study", ["online", "onsite"])
def test_every_route_has_room_for_some_error_of_each_study(
    all_facts: list[RouteFacts], study: str
) -> None:
    rng = np.random.default_rng(0)
    for facts in all_facts:
        kinds = [
            kind
            for kind in kinds_of(study)
            if any(possible_mistakes(facts, facts.plan, kind, rng))
        ]
        assert kinds, (facts.graph.site.name, facts.route.id)


@pytest.mark.parametrize("kind", KINDS)
def test_a_route_of_the_paper_has_room_for_every_kind(
    university_r1: RouteFacts, kind: str
) -> None:
    rng = np.random.default_rng(0)
    assert any(possible_mistakes(university_r1, university_r1.plan, kind, rng))


def test_what_is_wrong_is_said(university_r1: RouteFacts) -> None:
    rng = np.random.default_rng(1)
    (mistake,) = made_wrong(
        university_r1, university_r1.plan, ("wrong_direction",), rng
    )
    (turn,) = [t for t in university_r1.plan.turns if t.key == mistake.key]
    assert mistake.where == turn.at
    assert mistake.detail.endswith(f"the way goes {turn.side}")
