"""A vision model is shown some of the way so far and asked for the next motion."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from memorymaze.agents.agent import Journal
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.navid.model_policy import (
    SAID_MOTIONS,
    chosen_frames,
)
from memorymaze.agents.navid.motions import Command, Motions
from memorymaze.agents.navid.replies import navid_reply_grammar, read_navid_reply
from memorymaze.basics.errors import EpisodeOver
from memorymaze.language.models.model import CompletionRequest, Picture
from memorymaze.language.models.scripted_model import ScriptedLanguageModel

AHEAD = '{"reason": "free", "action": "forward", "amount": 75}'
STOP = '{"reason": "there", "action": "stop"}'


def follow(
    model: ScriptedLanguageModel, robot: object, history: int = 8, **options
) -> Journal:
    """Follow until the model says stop."""
    journal = Journal()
    chosen = NavidOptions(history=history, **options)
    agent = NavidAgent(chosen, model)
    with pytest.raises(EpisodeOver, match="agent"):
        agent.follow("To the desk.", robot, journal, np.random.default_rng(0))
    return journal


def question(request: CompletionRequest) -> str:
    return request.messages[1].content


def sizes(request: CompletionRequest) -> list[tuple[int, int]]:
    return [_open(picture).size for picture in request.messages[1].pictures]


def _open(picture: Picture) -> Image.Image:
    return Image.open(io.BytesIO(picture.data))


def test_past_pictures_are_small_and_the_current_one_comes_last_and_large(robot):
    model = ScriptedLanguageModel([AHEAD, AHEAD, STOP])

    follow(model, robot, history=2)

    small, large = (320, 240), (640, 480)
    assert [sizes(request) for request in model.requests] == [
        [large],
        [small, small, large],
        [small, small, large],
    ]
    # Each picture's grey tells after how many motions it was taken.
    shown = [
        round(float(np.asarray(_open(picture)).mean()))
        for picture in model.requests[-1].messages[1].pictures
    ]
    assert shown == [0, 5, 6]


def test_each_picture_is_named_by_its_step_and_what_was_done(robot):
    model = ScriptedLanguageModel([AHEAD, "turn left 30 degrees", STOP])

    follow(model, robot)

    assert question(model.requests[0]).splitlines() == [
        "The way as it was described:",
        '"""',
        "To the desk.",
        '"""',
        "Picture 1, the current one: at the start",
        "What is the next motion?",
    ]
    assert question(model.requests[2]).splitlines()[7:9] == [
        "Picture 4: step 3, after 25 cm forward",
        "Picture 5, the current one: step 4, after turning left by 30 degrees",
    ]


@pytest.mark.parametrize(
    ("turn_deg", "said"), [(30, "30, 60 or 90"), (15, "15, 30 or 45")]
)
def test_the_prompt_says_which_motions_there_are(robot, turn_deg, said):
    model = ScriptedLanguageModel([STOP])

    follow(model, robot, turn_deg=turn_deg)

    [request] = model.requests
    assert "forward by 25, 50 or 75 cm" in request.messages[0].content
    assert f"by {said} degrees" in request.messages[0].content
    assert (request.temperature, request.max_tokens) == (0.0, 300)
    assert request.grammar == navid_reply_grammar(Motions(turn_deg=turn_deg))


@pytest.mark.parametrize("motions", [Motions(), Motions(turn_deg=15)])
def test_servers_that_keep_to_a_grammar_can_answer_every_motion(motions):
    grammar = navid_reply_grammar(motions)

    for motion in ("forward", "left", "right"):
        for count, amount in enumerate(motions.amounts(motion), 1):
            assert f'"{amount}"' in grammar
            reply = f'{{"reason": "Free", "action": "{motion}", "amount": {amount}}}'
            assert read_navid_reply(reply, motions) == Command(motion, count)


def test_an_instruction_cannot_fill_slots_of_the_prompt(robot):
    model = ScriptedLanguageModel([STOP])
    with pytest.raises(EpisodeOver):
        NavidAgent(NavidOptions(), model).follow(
            "{FORWARD}", robot, Journal(), np.random.default_rng(0)
        )
    assert '"""\n{FORWARD}\n"""' in question(model.requests[0])


@given(st.integers(0, 3000), st.integers(0, 20))
def test_chosen_pictures_are_spread_and_have_the_last(past: int, wanted: int) -> None:
    chosen = chosen_frames(past, wanted)
    assert len(chosen) == min(past, wanted)
    assert chosen == sorted(set(chosen))
    if chosen:
        assert chosen[-1] == past - 1
        gaps = np.diff(chosen)
        assert gaps.size == 0 or gaps.max() - gaps.min() <= 1


AHEAD = '{"reason": "Free", "action": "forward", "amount": 75}'
LEFT = '{"reason": "There", "action": "left", "amount": 60}'
STOP = '{"reason": "There", "action": "stop"}'


def questions(robot: object, *replies: str) -> list[str]:
    """Follow until the model says stop; return what it was asked."""
    model = ScriptedLanguageModel(replies, name="reader")
    agent = NavidAgent(NavidOptions(pictures="none"), model)
    assert agent.name == "NaVid protocol with reader, blind+fair"
    with pytest.raises(EpisodeOver, match="agent"):
        agent.follow("To the desk.", robot, Journal(), np.random.default_rng(0))
    assert not any(
        message.pictures for request in model.requests for message in request.messages
    )
    return [request.messages[1].content for request in model.requests]


def test_motions_of_a_kind_are_told_together(robot):
    asked = questions(robot, AHEAD, AHEAD, LEFT, "Hm.", "Hm.", AHEAD, STOP)

    told = [line for each in asked for line in each.splitlines() if "so far" in line]
    assert told == [
        "Motions so far, in 0 steps: none",
        "Motions so far, in 3 steps: forward 75 cm",
        "Motions so far, in 6 steps: forward 150 cm",
        *["Motions so far, in 8 steps: forward 150 cm, left 60 degrees"] * 2,
        "Motions so far, in 9 steps: forward 150 cm, left 60 degrees",
        "Motions so far, in 12 steps: forward 150 cm, left 60 degrees, forward 75 cm",
    ]
    assert "could not be used" in asked[4]


def test_of_long_walks_the_last_motions_are_told(robot):
    turns = 30

    asked = questions(robot, *[AHEAD, LEFT] * turns, STOP)

    last = asked[-1].splitlines()[4]
    assert ": …, forward 75 cm, left 60 degrees" in last
    assert last.count("forward") + last.count("left") == SAID_MOTIONS
