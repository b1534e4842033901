"""Errors are errors: who follows them does not arrive."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from memorymaze.instructions.error_kinds import ERROR_KINDS, kinds_of
from memorymaze.writing.choosing import chosen_plan
from memorymaze.writing.mistakes import made_wrong, possible_mistakes
from memorymaze.writing.reading import RouteReading
from memorymaze.writing.voices import make_voice
from memorymaze.writing.walking import walk

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
    readings: list[RouteReading], seed: int, number: int, kind: str
) -> None:
    reading = readings[number % len(readings)]
    rng = np.random.default_rng(seed)
    study = "onsite" if kind in kinds_of("onsite") else "online"
    plan = chosen_plan(reading, make_voice(study, 1, rng), rng)
    assert walk(reading.floor, reading.route, plan).arrived
    for mistake in list(possible_mistakes(reading, plan, kind, rng))[:3]:
        assert mistake.kind == kind
        assert not walk(reading.floor, reading.route, mistake.plan).arrived


@QUIET
@given(seed=st.integers(0, 2**32), number=st.integers(0, 100))
def test_two_errors_lie_in_two_steps_and_do_not_undo_each_other(
    readings: list[RouteReading], seed: int, number: int
) -> None:
    reading = readings[number % len(readings)]
    rng = np.random.default_rng(seed)
    made = made_wrong(reading, reading.plan, ("missing_turn", "extra_turn"), rng)
    assert len({mistake.key for mistake in made}) == len(made)
    if made:
        assert not walk(reading.floor, reading.route, made[-1].plan).arrived


@pytest.mark.parametrize("study", ["online", "onsite"])
def test_every_route_has_room_for_some_error_of_each_study(
    readings: list[RouteReading], study: str
) -> None:
    rng = np.random.default_rng(0)
    for reading in readings:
        kinds = [
            kind
            for kind in kinds_of(study)
            if any(possible_mistakes(reading, reading.plan, kind, rng))
        ]
        assert kinds, (reading.floor.site.name, reading.route.id)


@pytest.mark.parametrize("kind", KINDS)
def test_a_route_of_the_paper_has_room_for_every_kind(
    university_r1: RouteReading, kind: str
) -> None:
    rng = np.random.default_rng(0)
    assert any(possible_mistakes(university_r1, university_r1.plan, kind, rng))


def test_what_is_wrong_is_said(university_r1: RouteReading) -> None:
    rng = np.random.default_rng(1)
    (mistake,) = made_wrong(
        university_r1, university_r1.plan, ("wrong_direction",), rng
    )
    (turn,) = [t for t in university_r1.plan.turns if t.key == mistake.key]
    assert mistake.where == turn.at
    assert mistake.detail.endswith(f"the way goes {turn.side}")
