"""Asking a language model until a reply can be used: once, and once more with the reason."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TypeVar

from memorymaze.agents.agent import Journal
from memorymaze.agents.notes import UnusableReplyNote
from memorymaze.basics.errors import LanguageModelError
from memorymaze.basics.input_files import shown
from memorymaze.language.models.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
)
from memorymaze.language.models.prompt_texts import load_prompt

TRIES = 2
"""Requests for an answer, where a reply is none."""

ReplyRecord = TypeVar("ReplyRecord")


def ask_until_read(
    model: LanguageModel,
    journal: Journal,
    request: CompletionRequest,
    question: ModelQuestion,
    numbers: Iterator[int],
    read: Callable[[str], ReplyRecord],
    refusal: str = "unusable_reply",
) -> ReplyRecord:
    """Return what is read from the reply.

    `numbers` gives each request its number, and raises where no more may be made. What
    `read` refuses with `ValueError` is asked for once more, by a prompt; a second such
    reply raises `LanguageModelError`.
    """
    problem = ""
    for _ in range(TRIES):
        asked = replace(request, question=replace(question, number=next(numbers)))
        reply = journal.ask(model, asked, question.stage)
        try:
            return read(reply)
        except ValueError as error:
            problem = str(error)
        journal.add(UnusableReplyNote(question.stage, problem))
        said = Message("assistant", reply.strip() or "(nothing)")
        again = Message("user", load_prompt(refusal, problem=problem))
        request = replace(request, messages=(*request.messages, said, again))
    raise LanguageModelError(
        f"{model.name}: no {question.stage} in {TRIES} replies: {problem}"
    )


def without_thoughts(reply: str) -> str:
    """Return what a reply says after the last thoughts between `<think>` marks."""
    return reply.rpartition("</think>")[2]


def object_in(reply: str) -> str:
    """Return the JSON object in a reply, whatever stands around it."""
    reply = without_thoughts(reply)
    begin, end = reply.find("{"), reply.rfind("}")
    if not 0 <= begin < end:
        raise ValueError(f"expected one JSON object, got {shown(reply)}")
    return reply[begin : end + 1]
