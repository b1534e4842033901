"""Which answers a deciding model may give."""

import json
from typing import Any

import pytest

from memorymaze.agents.closed_loop.questions import load_rules
from memorymaze.agents.closed_loop.replies import read_answer

RIGHT: dict[str, Any] = {
    "note": "Next the clock.",
    "turns_done": 0,
    "doubt": 0.1,
    "confidence": 0.9,
    "action": "walk",
    "way": "A",
}


def changed(**changes: Any) -> str:
    fields = {**RIGHT, **changes}
    return json.dumps({name: each for name, each in fields.items() if each is not ...})


def test_an_answer_is_read_whatever_stands_around_it() -> None:
    reply = f"<think>{{perhaps}} left?</think>\n```json\n{changed(place=3)}\n```"
    answer = read_answer(reply)
    assert (answer.action, answer.place, answer.way) == ("walk", 3, "A")
    assert answer.look_for is None


def test_the_examples_of_the_prompt_are_answers() -> None:
    rules = load_rules()
    _, _, examples = rules.partition("For example:\n")
    answers = [read_answer(line) for line in examples.splitlines()]
    assert [(each.way, each.metres) for each in answers] == [("A", None), ("B", 9)]


@pytest.mark.parametrize(
    ("reply", "problem"),
    [
        ("I would go left.", "expected one JSON object, got 'I would go left.'"),
        ('{"note": "x"', "expected one JSON object"),
        ('{"note": }', "expected JSON, got a mistake in column 10"),
        (changed(action="fly"), "action: expected 'walk', 'go_back', 'look', "),
        (changed(note=...), "note: expected this member, got none"),
        (changed(doubt=1.5), "doubt: expected less than or equal to 1, got 1.5"),
        (changed(turns_done="2"), "turns_done: expected a valid integer, got '2'"),
        (changed(speed=3), "speed: .*Extra inputs are not permitted"),
        (changed(way=...), "way: expected it with the action 'walk'"),
        (changed(action="go_back", way=...), "place: expected it with the action"),
        (changed(action="stop"), "way: expected it only with walk, got it with"),
        (changed(at="door"), "at: expected it only with stop"),
        (changed(metres=0), "metres: expected greater than 0, got 0"),
        (changed(look_for=["x"] * 13), "look_for: expected a list with at most 12"),
        (changed()[:-1] + ', "way": "B"}', "'way': expected it once, got it twice"),
    ],
)
def test_what_is_no_answer_is_refused_with_the_reason(reply: str, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        read_answer(reply)
