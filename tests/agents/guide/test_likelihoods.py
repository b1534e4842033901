"""What is said speaks for the ways it fits, and against those it does not."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.agents.guide.likelihoods import (
    SPEAKERS,
    WAY_METRES,
    Heard,
    Likelihoods,
    Weights,
    junction_ratio,
    length_ratio,
    length_to_come,
    not_seen,
    ordinal_ratio,
    ordinal_to_come,
    passings_ratio,
    seen_as_said,
    seen_ratio,
    then,
    way_ratio,
)
from memorymaze.agents.walking.choices import Choices, choices_at
from memorymaze.language.plans import Junction, Length, Passing, Turn, Unit, Way

MODEL = Likelihoods()
AHEAD, LEFT, RIGHT, BACK = 0.0, math.pi / 2, -math.pi / 2, math.pi


def _choices(*exits: float) -> Choices:
    return choices_at([*exits, BACK], set(), AHEAD)


CROSSING = _choices(AHEAD, LEFT, RIGHT)
T_JUNCTION = _choices(LEFT, RIGHT)
CORNER = _choices(LEFT)


def _of_anyone(ratio: float | Weights) -> float:
    """Average a ratio over all speakers there may be."""
    return float((MODEL.speakers[0] * ratio).sum())


def _metres(said: float, unit: Unit = "metres") -> Length:
    return Length(said, unit)


# -- lengths


@pytest.mark.parametrize("said", [4.0, 12.0, 30.0])
@pytest.mark.parametrize("times", [3.0, 1 / 3])
def test_a_length_speaks_for_a_way_as_long_and_against_others(
    said: float, times: float
) -> None:
    fits = _of_anyone(length_ratio(MODEL, _metres(said), said, 1, 1))
    off = _of_anyone(length_ratio(MODEL, _metres(said), times * said, 1, 1))
    assert off < 1 < fits


def test_steps_say_less_than_metres() -> None:
    in_metres, in_steps = (
        _of_anyone(length_ratio(MODEL, _metres(20.0, unit), 20.0, 1, 1))
        for unit in ("metres", "steps")
    )
    assert 1 < in_steps < in_metres


@pytest.mark.parametrize("said", [8.0, 12.0, 20.0])
def test_a_length_says_nothing_on_average_over_all_ways_there_are(said: float) -> None:
    off = np.linspace(-4, 4, 161)
    ways = WAY_METRES * np.exp(MODEL.way_log_sd * off)
    ratios = [_of_anyone(length_ratio(MODEL, _metres(said), w, 1, 1)) for w in ways]
    mean = np.average(ratios, weights=np.exp(-0.5 * off**2))
    assert mean == pytest.approx(1.0, abs=0.15)


def test_who_said_too_much_once_is_believed_to_say_too_much() -> None:
    weights = MODEL.speakers[0] * length_ratio(MODEL, _metres(30.0), 18.0, 1, 1)
    factors = np.array([factor for _, factor, _ in SPEAKERS])
    assert (weights * factors).sum() > 0
    heard = weights / weights.sum()
    again = length_ratio(MODEL, _metres(20.0), 12.0, 1, 1)
    assert (heard * again).sum() > _of_anyone(again)


def test_places_said_are_counted_not_measured() -> None:
    two = Length(16.0, "places", 2)
    right = _of_anyone(length_ratio(MODEL, two, 40.0, 2, 2))
    assert right > 1 > _of_anyone(length_ratio(MODEL, two, 16.0, 5, 5))
    assert _of_anyone(length_ratio(MODEL, two, 40.0, 7, 2)) == right


@pytest.mark.parametrize("unit", get_args(Unit))
def test_a_way_goes_on_the_less_likely_the_farther_it_is_beyond_what_was_said(
    unit: Unit,
) -> None:
    said = Length(10.0, unit, 1 if unit == "places" else None)
    on = [
        _of_anyone(length_to_come(MODEL, said, walked, places))
        for walked, places in ((0.0, 0), (10.0, 1), (20.0, 3), (60.0, 8))
    ]
    assert on == sorted(on, reverse=True)
    assert on[-1] < 0.7 * on[0]


# -- counts


@pytest.mark.parametrize("told", [1, 2, 3])
def test_a_count_fits_the_opening_of_that_number(told: int) -> None:
    turn = Turn("left", ordinal=told)
    by_number = [
        _of_anyone(ordinal_ratio(MODEL, turn, met, met, CROSSING))
        for met in range(1, 6)
    ]
    assert by_number[told - 1] == max(by_number) > 1
    assert all(each < 1 for n, each in enumerate(by_number, 1) if abs(n - told) > 1)


def test_a_turn_told_with_two_counts_fits_either() -> None:
    turn = Turn("left", ordinal=2, or_ordinal=3)
    second, third, fifth = (
        _of_anyone(ordinal_ratio(MODEL, turn, met, met, CROSSING)) for met in (2, 3, 5)
    )
    assert min(second, third) > 1 > fifth


def test_openings_of_one_side_are_counted_by_some_and_of_both_by_others() -> None:
    """The second left is the third opening of all: only who counts one side says so."""
    ratio = ordinal_ratio(MODEL, Turn("left", ordinal=2), 2, 4, CROSSING)
    one_side = np.array([one for one, _, _ in SPEAKERS])
    weights = MODEL.speakers[0] * ratio
    assert weights[one_side].sum() / weights.sum() > MODEL.one_side


def test_the_last_opening_is_one_where_no_way_goes_on() -> None:
    last = Turn("left", ordinal=-1)
    ended, on = (ordinal_ratio(MODEL, last, 3, 3, c) for c in (CORNER, CROSSING))
    assert _of_anyone(on) < 1 < _of_anyone(ended)


def test_a_count_still_to_come_speaks_against_no_way_until_it_is_passed() -> None:
    turn = Turn("left", ordinal=2)
    on = [_of_anyone(ordinal_to_come(MODEL, turn, met, met)) for met in range(5)]
    assert on[0] == pytest.approx(1.0)
    assert on[4] < 1 < on[1]


def test_openings_told_as_passed_speak_for_who_passed_so_many() -> None:
    told = [Passing(2, "left")]
    right = passings_ratio(MODEL, told, 2, 0, 2)
    too_few = passings_ratio(MODEL, told, 0, 2, 2)
    in_doubt = [replace(each, doubt=0.6) for each in told]
    assert too_few < passings_ratio(MODEL, in_doubt, 0, 2, 2) < 1
    assert too_few < 1 < right
    assert passings_ratio(MODEL, told, 1, 0, 1) < right


def test_what_is_missing_may_still_come_where_the_way_goes_on() -> None:
    told = [Passing(2, "left")]
    ended, on = (
        passings_ratio(MODEL, told, 0, 0, 0, going_on=g) for g in (False, True)
    )
    assert ended < 1 <= on
    assert passings_ratio(MODEL, told, 4, 0, 4, going_on=True) < 1


# -- turns and kinds of place


@pytest.mark.parametrize(("side", "angle"), [("left", LEFT), ("right", RIGHT)])
def test_a_side_told_is_never_the_other_one(side: Way, angle: float) -> None:
    assert way_ratio(Turn(side), angle) > 1
    assert way_ratio(Turn(side), -angle) == 0
    assert way_ratio(Turn(side), AHEAD) == 0


def test_slight_turns_fit_slanted_ways() -> None:
    slanted, square = math.radians(40), math.radians(90)
    slight, plain = Turn("slight_left"), Turn("left")
    assert way_ratio(slight, slanted) > way_ratio(slight, square)
    assert way_ratio(plain, square) > way_ratio(plain, slanted)


@pytest.mark.parametrize(
    ("turn", "fits", "other"),
    [
        (Turn("left", junction="t"), T_JUNCTION, CROSSING),
        (Turn("left", junction="crossing"), CROSSING, CORNER),
        (Turn("left", junction="corner"), CORNER, CROSSING),
        (Turn("left", at_end=True), T_JUNCTION, CROSSING),
        (Turn("left", forced=True), CORNER, CROSSING),
    ],
    ids=["t", "crossing", "corner", "end", "forced"],
)
def test_a_kind_of_junction_fits_places_of_that_kind(
    turn: Turn, fits: Choices, other: Choices
) -> None:
    assert junction_ratio(MODEL, turn, fits) > 1 > junction_ratio(MODEL, turn, other)


# -- errors


def test_what_may_be_an_error_moves_its_weight_to_who_erred() -> None:
    before = MODEL.speakers
    after = then(before, 0.5, 0.1, MODEL.again)
    assert after[0].sum() == pytest.approx(0.5)
    assert after[1].sum() == pytest.approx(0.1)
    assert before[1].sum() == 0


def test_one_error_makes_a_second_likelier() -> None:
    once = then(MODEL.speakers, 0.0, 0.1, MODEL.again)
    twice = then(once, 0.0, 0.1, MODEL.again)
    assert twice.sum() > 0.1 * once.sum()


def test_weighing_changes_nothing_where_nothing_is_said() -> None:
    weights = then(MODEL.speakers, 1.0, 0.0, MODEL.again)
    assert np.array_equal(weights, MODEL.speakers)


# -- things


def test_a_rare_thing_says_more_than_one_that_is_everywhere() -> None:
    rare = seen_ratio(MODEL.rare_rate, 10.0, 0.5)
    common = seen_ratio(MODEL.common_rate, 10.0, 0.5)
    assert rare > common > 1 > max(not_seen(MODEL, 0.8))


def test_a_thing_says_less_the_longer_the_way_on_which_it_counts() -> None:
    ratios = [seen_ratio(0.01, reach, 0.5) for reach in (1.0, 10.0, 100.0)]
    assert ratios == sorted(ratios, reverse=True)


def test_a_thing_seen_for_sure_says_more_than_one_that_may_be_it() -> None:
    assert seen_ratio(0.01, 10.0, 0.5) > seen_ratio(0.01, 10.0, 0.2)


def test_whose_things_are_not_there_is_believed_less_about_the_next() -> None:
    missed = MODEL.speakers[0] * not_seen(MODEL, 0.8).of_all ** 3
    heard = missed / missed.sum()
    found = seen_as_said(MODEL, MODEL.rare_rate, 10.0, 0.8).of_all
    assert (heard * found).sum() < _of_anyone(found)


# -- what is to come is worth the mean of what it may turn out to be


def _share(length: Length, near: float, far: float) -> float:
    """Return how much likelier one way is than another, by what is said of it."""
    one, two = (_of_anyone(length_ratio(MODEL, length, w, 1, 1)) for w in (near, far))
    return one / two


def test_an_upper_bound_fits_a_shorter_way_better() -> None:
    said, bound = Length(60.0, "time"), Length(60.0, "time", at_most=True)
    assert _share(bound, 35.0, 60.0) > 1 > _share(said, 35.0, 60.0)
    assert _share(bound, 60.0, 120.0) > _share(said, 60.0, 120.0) * 0.9


def test_a_length_of_two_stretches_is_of_neither_alone() -> None:
    alone, both = Length(40.0, "metres"), Length(40.0, "metres", stretches=2)
    assert _share(both, 20.0, 40.0) > 1 > _share(alone, 20.0, 40.0)


def test_a_length_in_doubt_says_less() -> None:
    sure, unsure = Length(30.0, "metres"), Length(30.0, "metres", doubt=0.7)
    assert 1 < _share(unsure, 30.0, 60.0) < _share(sure, 30.0, 60.0)


@given(
    st.builds(
        Length,
        st.floats(3, 60),
        st.sampled_from(["metres", "steps", "time"]),
        at_most=st.booleans(),
        stretches=st.integers(1, 3),
        doubt=st.floats(0, 1),
    ),
    st.floats(2, 40),
)
def test_a_length_to_come_is_worth_the_mean_of_the_lengths_it_may_have(
    length: Length, walked: float
) -> None:
    ends = walked * np.exp(np.linspace(0, 6, 2001))
    off = np.log(ends / WAY_METRES) / MODEL.way_log_sd
    ratios = np.array([length_ratio(MODEL, length, end, 1, 1) for end in ends])
    mean = np.average(ratios, axis=0, weights=np.exp(-0.5 * off**2))
    assert length_to_come(MODEL, length, walked, 1) == pytest.approx(mean, rel=0.05)


@given(st.integers(1, 6), st.integers(0, 8))
def test_a_count_to_come_is_worth_the_mean_of_the_openings_it_may_mean(
    told: int, passed: int
) -> None:
    turn = Turn("left", ordinal=told)
    ends = range(passed + 1, 40)
    ratios = [_of_anyone(ordinal_ratio(MODEL, turn, n, n, CROSSING)) for n in ends]
    mean = np.average(ratios, weights=[0.5**n for n in ends])
    to_come = _of_anyone(ordinal_to_come(MODEL, turn, passed, passed))
    assert to_come == pytest.approx(mean, rel=1e-3)


@given(st.floats(0.001, 0.1), st.floats(1, 40), st.floats(0.1, 1))
def test_a_thing_says_nothing_in_the_mean_of_seeing_it_by_chance_and_not(
    rate: float, reach: float, detected: float
) -> None:
    by_chance = 1 - math.exp(-rate * reach)
    seen = [
        seen_ratio(rate, reach, (1 - each) * detected, math.inf)
        for each in (MODEL.invented, MODEL.invented_carelessly)
    ]
    mean = Heard(*seen).or_else(not_seen(MODEL, detected), by_chance)
    assert mean == pytest.approx((1.0, 1.0))


# -- whatever is said


def _are_weights(ratios: Sequence[float | Weights]) -> bool:
    return all(np.isfinite(each).all() and np.min(each) >= 0 for each in ratios)


MET = st.integers(0, 400)
ORDINALS = st.none() | st.just(-1) | st.integers(1, 10**6)
ANGLES = st.floats(-math.pi, math.pi)
CHOICES = st.lists(ANGLES, max_size=6).map(lambda exits: choices_at(exits, set(), 0.0))
TURNS = st.builds(
    Turn,
    st.sampled_from(get_args(Way)),
    ORDINALS,
    ORDINALS,
    at_end=st.booleans(),
    junction=st.none() | st.sampled_from(get_args(Junction)),
    forced=st.booleans(),
)
LENGTHS = st.builds(
    Length,
    st.floats(0, 1e308),
    st.sampled_from(get_args(Unit)),
    st.none() | st.floats(0.5, 1e6),
)
PASSINGS = st.lists(
    st.builds(
        Passing,
        st.none() | st.integers(1, 10**6),
        st.none() | st.sampled_from(["left", "right"]),
    ),
    max_size=3,
)


@given(LENGTHS, st.floats(0, 1e4), MET, MET)
def test_lengths_can_be_weighed_whatever_they_are(
    length: Length, walked: float, places: int, junctions: int
) -> None:
    assert _are_weights([
        length_ratio(MODEL, length, walked, places, junctions),
        length_to_come(MODEL, length, walked, places),
    ])


@given(TURNS, MET, MET, CHOICES)
def test_turns_can_be_weighed_whatever_they_are(
    turn: Turn, on_side: int, of_all: int, choices: Choices
) -> None:
    assert _are_weights([
        ordinal_ratio(MODEL, turn, on_side, of_all, choices),
        ordinal_to_come(MODEL, turn, on_side, of_all),
        junction_ratio(MODEL, turn, choices),
        *(way_ratio(turn, angle) for _, angle in choices.ways),
    ])


@given(PASSINGS, MET, MET, MET, st.booleans())
def test_passings_can_be_weighed_whatever_they_are(
    passings: list[Passing], left: int, right: int, crossings: int, going_on: bool
) -> None:
    ratio = passings_ratio(MODEL, passings, left, right, crossings, going_on=going_on)
    assert 0 < ratio < math.inf
