"""A scripted model says what it was given to say."""

import pytest

from memorymaze.basics.errors import LanguageModelError
from memorymaze.language.models.model import CompletionRequest, Message, Usage
from memorymaze.language.models.scripted_model import ScriptedLanguageModel

REQUEST = CompletionRequest((Message("user", "Which way, please?"),))


def test_listed_replies_come_in_turn_and_then_run_out():
    model = ScriptedLanguageModel(["left", "then right"])

    assert [model.complete(REQUEST).text for _ in range(2)] == ["left", "then right"]
    with pytest.raises(LanguageModelError, match="has 2 replies and was asked 3 times"):
        model.complete(REQUEST)
    assert model.requests == [REQUEST] * 3


def test_a_function_makes_replies_of_requests():
    model = ScriptedLanguageModel(
        lambda request: request.messages[-1].content.upper(), name="loud"
    )
    completion = model.complete(REQUEST)

    assert completion.text == "WHICH WAY, PLEASE?"
    assert completion.model == model.name == "loud"
    assert completion.usage == Usage(3, 3)
