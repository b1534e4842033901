"""Asking a language model until a reply can be used: once, and once more with the reason."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TypeVar

from memorymaze.agents.agent import Journal
from memorymaze.errors import LanguageModelError
from memorymaze.language.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    Question,
)

TRIES = 2
"""Requests for an answer, where a reply is none."""

Answer = TypeVar("Answer")


def ask_until_read(
    model: LanguageModel,
    journal: Journal,
    request: CompletionRequest,
    question: Question,
    numbers: Iterator[int],
    read: Callable[[str], Answer],
) -> Answer | None:
    """Return what is read from the reply; None where no number is left for a request.

    What `read` refuses with `ValueError` is asked for once more; a second such reply
    raises `LanguageModelError`.
    """
    problem = ""
    for _ in range(TRIES):
        number = next(numbers, None)
        if number is None:
            return None
        asked = replace(request, question=replace(question, number=number))
        reply = journal.ask(model, asked, question.stage)
        try:
            return read(reply)
        except ValueError as error:
            problem = str(error)
        journal.note("unusable_reply", stage=question.stage, problem=problem)
        said = Message("assistant", reply.strip() or "(nothing)")
        again = Message("user", f"That cannot be used: {problem}. Answer again.")
        request = replace(request, messages=(*request.messages, said, again))
    raise LanguageModelError(
        f"{model.name}: no {question.stage} in {TRIES} replies: {problem}"
    )
