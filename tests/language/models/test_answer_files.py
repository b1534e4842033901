"""Files of answers are read whole, or every fault in them is named with its line."""

import json
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import AnswerFileError, LanguageModelError
from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.language.models.answers import AboutInstruction, ReplayingModel
from memorymaze.language.models.model import (
    CompletionRequest,
    Message,
    ModelQuestion,
    Usage,
)

BY_HAND = {"instruction_id": "a", "stage": "program", "reply": "stop()"}
STEP = {"instruction_id": "a", "stage": "step", "number": 2, "reply": "Go on."}
SAID = {**BY_HAND, "model": "m", "prompt_tokens": 10, "latency_s": 1.5}


def ask(path: Path, stage: str, number: int = 1, prompt: str = "v1") -> Any:
    """Ask about the instruction `a`."""
    request = CompletionRequest(
        (Message("user", "…"),), question=ModelQuestion(stage, prompt, number)
    )
    return AboutInstruction(ReplayingModel(path), "a").complete(request)


def test_a_reply_answers_its_step_and_no_other(file: Callable[..., Path]) -> None:
    path = file(STEP, {**STEP, "number": 3, "reply": "There."})
    assert ask(path, "step", 2).text == "Go on."
    assert ask(path, "step", 3).text == "There."
    for stage, number in (("step", 4), ("program", 2)):
        with pytest.raises(LanguageModelError, match="no reply of answers is recorded"):
            ask(path, stage, number)


def test_a_stage_without_a_variant_answers_all_of_them(
    file: Callable[..., Path],
) -> None:
    said = ask(file(SAID), "program+parser+single_stage")
    assert (said.text, said.model, said.latency) == ("stop()", "m", 1.5)
    assert said.usage == Usage(10)
    assert said.inferred


def test_an_answer_that_names_no_model_is_by_hand_and_no_inference(
    file: Callable[..., Path],
) -> None:
    said = ask(file(BY_HAND), "program")
    assert (said.text, said.model, said.inferred) == ("stop()", "answers", False)


def test_an_error_says_why_there_is_no_answer(file: Callable[..., Path]) -> None:
    path = file({**BY_HAND, "reply": None, "error": "It refused."})
    with pytest.raises(LanguageModelError, match=r"^It refused\.$"):
        ask(path, "program+parser")


def test_the_answer_to_the_present_prompt_counts_before_others(
    file: Callable[..., Path],
) -> None:
    path = file(*({**STEP, "prompt": each, "reply": each} for each in ("v1", "v2")))
    assert ask(path, "step", 2, "v1").text == "v1"
    assert ask(path, "step", 2, "v3").text == "v2"
    assert AnswerFile(path).stages() == {("a", "step"): {"v1", "v2"}}


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        pytest.param(["{"], "expected JSON", id="no json"),
        pytest.param(
            [{**BY_HAND, "model": ""}], "'model': expected a text", id="empty"
        ),
        pytest.param(
            [{"stage": "step", "reply": ""}],
            "'instruction_id' is missing",
            id="id",
        ),
        pytest.param([{**BY_HAND, "error": "no"}], "got both", id="both"),
        pytest.param([{"instruction_id": "a"}], "got neither", id="neither"),
        pytest.param(
            [{**BY_HAND, "prompts": "x"}], "did you mean 'prompt'", id="misspelt"
        ),
        pytest.param(
            [{**BY_HAND, "reply": 3}], "'reply': expected a valid string", id="type"
        ),
        pytest.param(
            [BY_HAND, BY_HAND], r":2: .*a second one to program of 'a'", id="twice"
        ),
        pytest.param([STEP, STEP], r":2: .*to step of 'a', which .*:1", id="steps"),
        pytest.param(
            [{**BY_HAND, "latency_s": -1}],
            "'latency_s': expected greater",
            id="amount",
        ),
        pytest.param(
            [{"instruction_id": "a", "reply": "x"}], "'stage' is missing", id="stage"
        ),
    ],
)
def test_what_is_wrong_is_told_with_its_line(
    file: Callable[..., Path], lines: list[Any], said: str
) -> None:
    with pytest.raises(AnswerFileError, match=said):
        ReplayingModel(file(*lines))


def test_what_is_sound_is_read_beside_what_is_not(file: Callable[..., Path]) -> None:
    found = AnswerFile(file("{", BY_HAND, BY_HAND))
    assert [each.instruction_id for each in found.answers] == ["a"]
    assert len(found.problems) == 2


TEXTS = st.text(
    st.characters(exclude_categories=["Cs"]), min_size=1, max_size=30
).filter(str.strip)


@given(st.dictionaries(TEXTS, TEXTS, min_size=1))
def test_any_text_in_any_field_survives_a_file(replies: dict[str, str]) -> None:
    lines = [
        json.dumps({"instruction_id": name, "stage": "step", "reply": text})
        for name, text in replies.items()
    ]
    with TemporaryDirectory() as folder:
        path = Path(folder) / "answers.jsonl"
        path.write_text("\n".join(lines), encoding="utf-8")
        read = AnswerFile(path).answers
    assert {each.instruction_id: each.reply for each in read} == replies
