"""Speakers leave out, are off and misname; the exact one says nothing that is not so."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.language.nouns import kin_of
from memorymaze.language.plans import Arrival, Leg, Unit, parse_plan, plan_record
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.sampling import chosen_plan
from memorymaze.texts.writing.speakers import EXACT, Speaker, draw_speaker, tell_plan
from memorymaze.texts.writing.steps import Cue, StepPlan
from memorymaze.texts.writing.voices import make_voice

TALKER = replace(EXACT, lengths=1.0, things=1.0, floors=0.0, names=0.0)
"""Who tells all lengths and things, and nothing of what is underfoot."""

seeds = st.integers(0, 2**32)


def _way(all_facts: list[RouteFacts], seed: int) -> StepPlan:
    """Return a right plan of some route, with cues that somebody might choose."""
    rng = np.random.default_rng(seed)
    return chosen_plan(
        all_facts[seed % len(all_facts)], make_voice("online", 1, rng), rng
    )


def _told(
    way: StepPlan, speaker: Speaker, seed: int
) -> list[tuple[Leg | Arrival, Leg | Arrival]]:
    """Return what is true of each stretch, and what a speaker says of it."""
    true, said = way.said, tell_plan(way, speaker, np.random.default_rng(seed))
    parts = (*true.legs, true.arrival), (*said.legs, said.arrival)
    return list(zip(*parts, strict=True))


@given(seed=seeds)
def test_an_exact_speaker_says_nothing_that_is_not_so(
    all_facts: list[RouteFacts], seed: int
) -> None:
    for true, told in _told(_way(all_facts, seed), EXACT, seed):
        assert set(told.mentions) <= {
            replace(each, side=side, after_metres=None)
            for each in true.mentions
            for side in (each.side, None)
        }
        openings = Counter(each.side for each in true.passings)
        assert all(openings[each.side] == each.count for each in told.passings)
        assert told.too_far in {(), true.too_far}
        if told.length is not None:
            assert true.length is not None
            assert told.length.metres == pytest.approx(true.length.metres, rel=0.4)


@given(seed=seeds)
def test_an_exact_speaker_tells_each_turn_with_its_cue_and_the_goal(
    all_facts: list[RouteFacts], seed: int
) -> None:
    way = _way(all_facts, seed)
    true, said = way.said, tell_plan(way, EXACT, np.random.default_rng(seed))
    for leg, told in zip(true.legs, said.legs, strict=True):
        first = [replace(leg.turn, ordinal=None)] if leg.turn.ordinal == 1 else []
        assert told.turn in [leg.turn, *first]
        marks = [each for each in leg.mentions if each.place == "turn"]
        assert marks == [each for each in told.mentions if each.place == "turn"]
    assert said.arrival.destinations == true.arrival.destinations == (way.ending.goal,)
    assert said.arrival.side in {true.arrival.side, None}


@given(seed=seeds)
def test_the_same_chance_makes_the_same_plan_which_a_file_can_hold(
    all_facts: list[RouteFacts], seed: int
) -> None:
    rngs = (np.random.default_rng(seed) for _ in range(2))
    way = _way(all_facts, seed)
    said, again = (tell_plan(way, draw_speaker(rng), rng) for rng in rngs)
    assert said == again == parse_plan(plan_record(said), "plan")


@given(seeds, st.floats(0.5, 2), st.sampled_from(["metres", "steps", "time"]))
def test_all_lengths_of_a_speaker_are_off_by_one_factor(
    all_facts: list[RouteFacts], seed: int, factor: float, unit: Unit
) -> None:
    speaker = replace(TALKER, factor=factor, noise=0.0, unit=unit)
    for true, told in _told(_way(all_facts, seed), speaker, seed):
        metres = true.length.metres if true.length else 0.0
        assert (told.length is not None) == (metres >= 2)
        if told.length is not None:
            # People round to fives and tens, and to whole steps.
            off = pytest.approx(factor * metres, rel=0.21, abs=0.6)
            assert told.length.metres == off


@given(seed=seeds)
def test_whoever_says_other_words_says_related_ones(
    all_facts: list[RouteFacts], seed: int
) -> None:
    for parts in _told(_way(all_facts, seed), replace(TALKER, kin=1.0), seed):
        things = ([m.phrase for m in p.mentions if m.place != "along"] for p in parts)
        for was, now in zip(*things, strict=True):
            *before, noun = was.split(" ")
            is_noun = noun.islower() and " that says " not in was
            others = {" ".join([*before, each]) for each in kin_of(noun) if is_noun}
            assert now in (others or {was})


def test_what_a_sign_says_is_told_word_by_word(university_r1: RouteFacts) -> None:
    cue = Cue("thing", words="poster that says take the lift")
    way = university_r1.plan.with_turn("turn0", cue=cue)
    (_, told), *_ = _told(way, replace(EXACT, kin=1.0), 0)
    assert told.mentions[-1].phrase == cue.words


def test_who_tells_no_lengths_or_things_tells_none(university_r1: RouteFacts) -> None:
    no_lengths = _told(university_r1.plan, replace(TALKER, lengths=0.0), 0)
    no_things = _told(university_r1.plan, replace(TALKER, things=0.0), 0)
    assert not any(told.length for _, told in no_lengths)
    assert any(told.mentions for _, told in no_lengths)
    assert not any(told.mentions for _, told in no_things)
    assert any(told.length for _, told in no_things)


def test_who_tells_the_goal_by_what_is_there_counts_no_doors(
    university_r1: RouteFacts,
) -> None:
    ending = university_r1.plan.ending
    by = ending.stretch.beside[0].thing
    way = replace(university_r1.plan, ending=replace(ending, by=by, nth=2))
    rng = np.random.default_rng(0)
    arrival = tell_plan(way, replace(EXACT, goal_seen=1.0), rng).arrival
    assert (arrival.destinations, arrival.nth) == ((by.words,), None)
    assert tell_plan(way, EXACT, rng).arrival.nth == 2
