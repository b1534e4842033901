"""A language model writes the texts; what it marks is checked."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.language.models.model import CompletionRequest
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.texts.writing import GenerationRequest, make_instructions, parse_rates

WORDS = "So you go on along there for quite a bit, and you pass a chair, and then you "


def _request(folder: Path, errors: str, *, paired: bool = True) -> GenerationRequest:
    return GenerationRequest(
        sites_folder=folder,
        site="t_junction",
        route="R1",
        study="onsite",
        iteration=1,
        per_cell=1,
        rates=parse_rates(errors),
        paired=paired,
    )


def _reply(right: str, wrong: str) -> str:
    return f"<right>\n{right}\n</right>\n<wrong>\n{wrong}\n</wrong>"


def _text(turn: str) -> str:
    return f"{WORDS} turn {turn} at the end. The library is ahead of you, that's it."


LEFT, RIGHT = "<turn>left</turn>", "<turn>right</turn>"
GOOD = _reply(
    _text(f'<error n="1">{LEFT}</error>'), _text(f'<error n="1">{RIGHT}</error>')
)


def test_a_reply_that_keeps_to_the_plan_becomes_a_labelled_pair(
    tiny_sites_folder: Path,
) -> None:
    model = ScriptedLanguageModel([GOOD])
    request = _request(tiny_sites_folder, "wrong_direction_at_turn=1")
    made = make_instructions(request, model)
    wrong, right = made.instructions
    (said,), (meant,) = wrong.spans, right.spans
    assert wrong.text[said.start : said.end] == "right"
    assert right.text[meant.start : meant.end] == "left"
    assert "<" not in wrong.text + right.text
    assert (wrong.source, wrong.pair) == ("llm", right.pair)
    assert [each.kind for each in wrong.failures] == ["wrong_direction_at_turn"]
    assert not right.failures


def test_the_model_is_told_the_steps_the_errors_and_how_people_sound(
    tiny_sites_folder: Path,
) -> None:
    model = ScriptedLanguageModel([GOOD])
    make_instructions(_request(tiny_sites_folder, "wrong_direction_at_turn=1"), model)
    (asked,) = model.requests
    system, task = (message.content for message in asked.messages)
    assert "This is how people sound:\n\n" in system
    assert "wrong_direction_at_turn (left for right" in task
    assert re.search(r"turn left .*turn right", task, re.DOTALL)
    assert "the library is straight ahead" in task


BAD: dict[str, Callable[[], str]] = {
    "no text": lambda: "I would rather not.",
    "error not marked": lambda: _reply(_text(LEFT), _text(RIGHT)),
    "turn not marked": lambda: GOOD.replace(LEFT, "left"),
    "wrong side": lambda: GOOD.replace(RIGHT, LEFT),
    "other words changed": lambda: GOOD.replace("a chair, and", "a sofa, and", 1),
    "turn without marks": lambda: GOOD.replace("pass a chair", "turn left"),
    "no destination": lambda: GOOD.replace("library", "thing"),
    "too long": lambda: GOOD.replace(WORDS, WORDS * 8),
    "marks out of order": lambda: GOOD.replace(
        f"{RIGHT}</error>", "right</error></turn>"
    ),
}


@pytest.mark.parametrize("fault", BAD)
def test_a_reply_that_does_not_keep_to_the_plan_is_asked_for_again(
    tiny_sites_folder: Path, fault: str
) -> None:
    model = ScriptedLanguageModel([BAD[fault](), GOOD])
    request = _request(tiny_sites_folder, "wrong_direction_at_turn=1")
    made = make_instructions(request, model)
    assert len(made.instructions) == 2
    assert model.requests[1].messages[-1].content.startswith("Not yet: expected")


def test_a_model_that_never_keeps_to_the_plan_loses_only_its_own_text(
    tiny_sites_folder: Path,
) -> None:
    def reply(asked: CompletionRequest) -> str:
        return "no"

    request = _request(tiny_sites_folder, "wrong_direction_at_turn=1")
    made = make_instructions(request, ScriptedLanguageModel(reply))
    assert made.instructions == ()
    assert "after 3 attempts" in made.problems[0]


def test_a_model_that_does_not_answer_is_reported(tiny_sites_folder: Path) -> None:
    request = _request(tiny_sites_folder, "none", paired=False)
    made = make_instructions(request, ScriptedLanguageModel([]))
    assert "asked 1 times" in made.problems[0]


def test_a_text_without_errors_needs_one_text(tiny_sites_folder: Path) -> None:
    model = ScriptedLanguageModel([f"<right>{_text(LEFT)}</right>"])
    request = _request(tiny_sites_folder, "none", paired=False)
    (made,) = make_instructions(request, model).instructions
    assert (made.failures, made.pair, made.source) == ((), None, "llm")
