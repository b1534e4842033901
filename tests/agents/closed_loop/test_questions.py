"""How a model is asked on a walk, and what becomes of replies that cannot be used."""

import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.closed_loop.questions import DecisionQuestions, decision_prompts
from memorymaze.agents.closed_loop.walk_log import WalkLog
from memorymaze.agents.notes import UnusableReplyNote
from memorymaze.agents.walking.floor_map import FloorMap
from memorymaze.basics.errors import LanguageModelError
from memorymaze.language.models.scripted_model import ScriptedLanguageModel


def ask(
    replies: list[str], most: int = 40
) -> tuple[ScriptedLanguageModel, Journal, list[int | None]]:
    """Ask twice for a number."""
    model, journal = ScriptedLanguageModel(replies, name="small"), Journal()
    log = WalkLog(FloorMap())
    log.arrive(0, 0.0)
    questions = DecisionQuestions(" To the clock. ", model, journal, log, most)
    return (
        model,
        journal,
        [questions.ask(int, "Here.") for _ in range(2)],
    )


def test_each_question_has_the_text_the_log_and_its_number() -> None:
    model, journal, answers = ask(["1", "2"])
    assert answers == [1, 2]
    told = model.requests[0].messages[1].content
    assert '"""\nTo the clock.\n"""' in told
    assert "Place 0 (the start)" in told
    questions = [each.question for each in model.requests]
    assert [each.number for each in questions if each] == [1, 2]
    assert {each.prompt for each in questions if each} == set(
        decision_prompts().values()
    )
    assert journal.model_calls == 2


def test_a_reply_that_cannot_be_used_is_asked_for_once_more() -> None:
    model, journal, answers = ask(["one", "1", "2"])
    assert answers == [1, 2]
    said, repaired = model.requests[1].messages[2:]
    assert said.content == "one"
    assert "cannot be used: invalid literal" in repaired.content
    assert [
        each.stage for each in journal.notes if isinstance(each, UnusableReplyNote)
    ] == ["decision"]


def test_two_replies_that_cannot_be_used_are_an_error_with_the_models_name() -> None:
    with pytest.raises(LanguageModelError, match="small: no decision in 2 replies: "):
        ask(["one", "two"])


def test_no_more_is_asked_than_allowed_and_second_tries_count() -> None:
    model, _, answers = ask(["one", "1", "2"], most=2)
    assert answers == [1, None]
    assert len(model.requests) == 2
