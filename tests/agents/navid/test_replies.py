"""Replies become motions: clear ones only, or as the released code reads them."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.agents.navid.motions import Command, Motions
from memorymaze.agents.navid.replies import read_navid_reply, read_reply_as_released

BY_30, BY_15 = Motions(), Motions(turn_deg=15)

FORWARD_1, FORWARD_2, FORWARD_3 = (Command("forward", n) for n in (1, 2, 3))
STOP = Command("stop")


def said(
    reply: str,
    motions: Motions = BY_30,
    reader: Callable[[str, Motions], Command] = read_navid_reply,
) -> Command | None:
    """What a reply says; None where it is refused."""
    try:
        return reader(reply, motions)
    except ValueError:
        return None


@pytest.mark.parametrize(
    ("reply", "strictly", "as_released"),
    [
        pytest.param(
            "The next action is move forward 75 cm.", FORWARD_3, FORWARD_3, id="trained"
        ),
        pytest.param(
            "The next action is turn left 30 degree.",
            Command("left"),
            Command("left"),
            id="trained turn",
        ),
        pytest.param("stop.", STOP, STOP, id="stop"),
        pytest.param("stop", STOP, None, id="stop without its full stop is missed"),
        pytest.param("Stop.", STOP, None, id="capital letter"),
        pytest.param(
            "move forward 75", FORWARD_3, None, id="last digit taken for a full stop"
        ),
        pytest.param("move forward 25.", FORWARD_1, FORWARD_1, id="no unit"),
        pytest.param("move forward 200 cm.", FORWARD_3, FORWARD_3, id="cut to 75 cm"),
        pytest.param("move forward 60 cm.", FORWARD_2, FORWARD_2, id="rounded down"),
        pytest.param("turn left 13 degrees.", None, None, id="less than a primitive"),
        pytest.param("move forward 0 cm.", None, None, id="zero"),
        pytest.param("move forward -50 cm.", None, None, id="backwards"),
        pytest.param("turn right.", None, None, id="no amount"),
        pytest.param("", None, None, id="nothing"),
        pytest.param("I see a long hallway.", None, None, id="chat"),
        pytest.param(
            "I should stop only later; move forward 50 cm.",
            None,
            STOP,
            id="stop wins wherever it is",
        ),
        pytest.param(
            "turn left 30 degrees, then forward.",
            Command("left"),
            FORWARD_1,
            id="forward wins over left",
        ),
        pytest.param(
            "After 2 doors, move forward 75 cm.",
            FORWARD_3,
            None,
            id="first number anywhere",
        ),
        pytest.param("Do not stop.", None, STOP, id="negated"),
        pytest.param("There is a bus stop here.", None, STOP, id="another stop"),
        pytest.param("The next action is to stop.", STOP, STOP, id="trained stop"),
        pytest.param("I see the desk.\n**Stop**", STOP, None, id="stop on its line"),
        pytest.param(
            "I will not move forward 50 cm.", None, FORWARD_2, id="negated motion"
        ),
        pytest.param("forward 50 steps.", None, FORWARD_2, id="other unit"),
        pytest.param("move forward 0.5 m.", FORWARD_2, None, id="metres"),
        pytest.param(
            "forward 25, 50 or 75 cm; left 30 degrees; stop.",
            None,
            STOP,
            id="the question itself",
        ),
        pytest.param("forward " + "9" * 6000, None, FORWARD_3, id="endless number"),
    ],
)
def test_sentences(
    reply: str, strictly: Command | None, as_released: Command | None
) -> None:
    assert said(reply) == strictly
    assert said(reply, reader=read_reply_as_released) == as_released


@pytest.mark.parametrize(
    ("reply", "expected"),
    [
        ('{"reason": "open", "action": "forward", "amount": 50}', FORWARD_2),
        ('{"action": "stop"}', STOP),
        ('{"action": "turn_left", "amount": 90}', Command("left", 3)),
        ('{"Action": "Turn Right", "amount": "60 degrees"}', Command("right", 2)),
        ('{"action": "turn left 30 degrees"}', Command("left")),
        ('```json\n{"action": "forward", "amount": 25.0}\n```', FORWARD_1),
        ('Sure! {"action": "forward", "amount": 75} Good luck, stop.', FORWARD_3),
        ('{"a": 1} {"action": "forward", "amount": 75}', FORWARD_3),
        ('{"action": "stop"} {"action": "stop"}', STOP),
        ('{"reason": "forward 50 cm is free", "action": "wait"}', None),
        ('{"action": "forward"}', None),
        ('{"action": "forward", "amount": true}', None),
        ('{"action": "forward", "amount": NaN}', None),
        ('{"action": "forward", "amount": 1e999}', None),
        ('{"action": "forward", "amount": -25}', None),
        ('{"action": "left", "amount": 5}', None),
        ('{"action": ["forward"], "amount": 25}', None),
        ('{"action": "forward" or "left" or "stop", "amount": number}', None),
        ('{"action": "stop"} {"action": "forward", "amount": 25}', None),
        ('{"reason": "ok", "action": "forw', None),
    ],
)
def test_json_decides_before_any_sentence(reply: str, expected: Command | None) -> None:
    assert said(reply) == expected


def test_turns_are_counted_in_primitives_of_the_track() -> None:
    reply = "The next action is turn left 45 degrees."
    assert read_navid_reply(reply, BY_30) == Command("left", 1)
    assert read_navid_reply(reply, BY_15) == Command("left", 3)
    assert read_reply_as_released(reply, BY_15) == Command("left", 3)


def test_thoughts_are_no_commands() -> None:
    thoughts = "<think>Turn left 30 degrees? Or stop? " + "No. " * 6000 + "</think>\n"
    for command in ("move forward 50 cm", '{"action": "forward", "amount": 50}'):
        assert said(thoughts + command) == FORWARD_2


@given(st.text(), st.sampled_from([BY_15, BY_30]))
def test_no_text_whatever_makes_a_reader_fail(text: str, motions: Motions) -> None:
    for reader in (read_navid_reply, read_reply_as_released):
        read = said(text, motions, reader)
        assert read is None or 1 <= read.count <= motions.most


WORDS = [
    *("forward", "left", "right", "stop", "turn", "move", "not", "and"),
    *("30", "75", "-25", "0", "1e9", "cm", "degrees", "m", "°"),
    *("{", "}", '"action"', ":", '"amount"', ",", ".", "\n", '"forward"', '"stop"'),
]


@given(st.lists(st.sampled_from(WORDS), max_size=12).map(" ".join))
def test_a_robot_moves_only_by_one_command_with_an_amount(text: str) -> None:
    read = said(text)
    if read is None or read.motion == "stop":
        return
    assert read.motion in text
    assert any(number in text for number in ("30", "75", "1e9"))
    # Whoever says several different things has said nothing.
    others = {"forward", "left", "right"} - {read.motion}
    for other in others:
        contradiction = f"{text}\n{other} 30 degrees\nforward 30 cm"
        if '"action"' not in text:
            assert said(contradiction) is None


@given(
    st.text(
        st.characters(codec="utf-8", exclude_characters="fFlLrRsS\u017f"), max_size=200
    )
)
def test_text_without_the_words_never_moves_the_robot(text: str) -> None:
    assert said(text) is None


@pytest.mark.parametrize(
    "reply",
    [
        "forward" + " " * 19_000,
        "forward 1" * 2_000,
        "{" * 20_000,
        '{"a":' * 4_000,
        "not " * 5_000 + "stop",
        "x" * 1_000_000,
    ],
    ids=["blanks", "repeated", "braces", "nested", "negations", "long"],
)
def test_hostile_replies_are_refused_and_not_pondered(reply: str) -> None:
    # Patterns that try every way to split a text would take minutes here.
    assert said(reply) is None
