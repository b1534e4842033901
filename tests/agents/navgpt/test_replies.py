import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.agents.navgpt.replies import (
    Finish,
    Move,
    Unreadable,
    read_navgpt_reply,
    thought_in_reply,
)

ID = "0f" * 16


@pytest.mark.parametrize(
    "reply",
    [
        pytest.param(
            f'Thought: On.\nAction: go_to_viewpoint\nAction Input: "{ID}"',
            id="as asked",
        ),
        pytest.param(
            f"**Thought:** On.\n**Action:** `go_to_viewpoint`\n**Action Input:**\n`{ID}`",
            id="marked up",
        ),
        pytest.param(
            f"My next action: turn. Action: go_to_viewpoint Action Input: {ID}",
            id="on one line",
        ),
        pytest.param(
            f"action: Go_To_Viewpoint\naction input: {ID.upper()}.", id="other letters"
        ),
        pytest.param(
            f"Action: go_to_viewpoint\nAction Input: {ID}\n"
            "Observation: You arrive.\nThought: There.\nFinal Answer: arrived",
            id="with an invented observation",
        ),
        pytest.param(
            "<think>Action: go_to_viewpoint\nAction Input: 12\nFinal Answer: x</think>"
            f"Action: go_to_viewpoint\nAction Input: {ID}",
            id="after hidden thoughts",
        ),
    ],
)
def test_a_move_is_read(reply: str) -> None:
    assert read_navgpt_reply(reply) == Move(ID)


def test_an_input_that_is_no_id_is_passed_on_to_be_refused() -> None:
    reply = "Action: go_to_viewpoint\nAction Input: the door on the left"
    assert read_navgpt_reply(reply) == Move("the door on the left")


def test_a_final_answer_is_read() -> None:
    reply = "Thought: I give the final answer.\nFinal Answer: arrived"
    assert read_navgpt_reply(reply) == Finish("arrived")
    assert thought_in_reply(reply) == "I give the final answer."


@pytest.mark.parametrize(
    ("reply", "fault"),
    [
        ("", "no_action"),
        ("Hello! How can I help you?", "no_action"),
        ("Thought: the final answer is near", "no_action"),
        ("Action: fly\nAction Input: " + ID, "unknown_action"),
        ("Action:\nAction Input: " + ID, "unknown_action"),
        ("Action: go_to_viewpoint", "no_input"),
        ('Action: go_to_viewpoint\nAction Input: ""', "no_input"),
        (f"Action: go_to_viewpoint\nAction Input: {ID}\nFinal Answer: x", "both"),
    ],
)
def test_what_cannot_be_read_is_told(reply: str, fault: str) -> None:
    read = read_navgpt_reply(reply)
    assert isinstance(read, Unreadable)
    assert read.fault == fault
    assert read.told.endswith(".")


@given(st.text(max_size=300))
def test_any_reply_is_read_as_something(reply: str) -> None:
    assert isinstance(read_navgpt_reply(reply), Move | Finish | Unreadable)
    assert isinstance(thought_in_reply(reply), str)
