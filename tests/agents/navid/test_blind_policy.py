"""A model of text alone is told the motions so far."""

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.navid import NavidAgent
from memorymaze.agents.navid.blind_policy import SAID_MOTIONS, BlindPolicy
from memorymaze.errors import EpisodeOver
from memorymaze.language.scripted_model import ScriptedLanguageModel

AHEAD = '{"reason": "Free", "action": "forward", "amount": 75}'
LEFT = '{"reason": "There", "action": "left", "amount": 60}'
STOP = '{"reason": "There", "action": "stop"}'


def questions(robot: object, *replies: str) -> list[str]:
    """Follow until the model says stop; return what it was asked."""
    model = ScriptedLanguageModel(replies, name="reader")
    agent = NavidAgent(BlindPolicy(model))
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
