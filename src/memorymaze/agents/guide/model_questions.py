"""Asking a language model about a walk: a bounded number of times, once more if need be."""

from collections.abc import Callable
from typing import TypeVar

from memorymaze.agents.agent import Journal
from memorymaze.agents.guide.walk_log import WalkLog
from memorymaze.errors import LanguageModelError
from memorymaze.language.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    Question,
)
from memorymaze.language.prompt_texts import load_prompt, prompt_version

TRIES = 2
"""Requests for an answer, where a reply is none."""
MOST_REQUESTS = 40
MAX_TOKENS = 1000
"""Of a reply."""

Answer = TypeVar("Answer")


def load_rules(stage: str) -> str:
    """Return the prompt of a stage that says what is always the same."""
    return load_prompt(f"guide_{stage}_rules", knowledge=load_prompt("guide_knowledge"))


def guide_prompts(*stages: str) -> dict[str, str]:
    """Return the versions of the prompts of stages: `decision`, `choice`."""
    empty = dict.fromkeys(("instruction", "places", "steps", "now"), "")
    task = load_prompt("guide_task", **empty)
    return {stage: prompt_version(load_rules(stage), task) for stage in stages}


class ModelQuestions:
    """The questions of one episode, which are counted."""

    def __init__(
        self,
        instruction: str,
        model: LanguageModel,
        journal: Journal,
        most_requests: int = MOST_REQUESTS,
    ) -> None:
        """Ask a model about a text at most so many times; second tries count."""
        self._instruction = instruction.strip()
        self._model = model
        self._journal = journal
        self.left = most_requests
        """Requests that may still be made."""
        self._asked: dict[str, int] = {}

    def ask(
        self,
        stage: str,
        read: Callable[[str], Answer],
        log: WalkLog,
        now: str,
    ) -> Answer | None:
        """Return what is read from the reply; None where no request is left.

        What `read` refuses with `ValueError` is asked for once more, with the reason; a
        second such reply raises `LanguageModelError`.
        """
        task = load_prompt(
            "guide_task",
            instruction=self._instruction,
            places=log.places,
            steps=log.steps,
            now=now,
        )
        messages = Message("system", load_rules(stage)), Message("user", task)
        problem = ""
        for _ in range(TRIES):
            if self.left < 1:
                return None
            reply = self._complete(stage, messages)
            try:
                return read(reply)
            except ValueError as error:
                problem = str(error)
            self._journal.note("unusable_reply", stage=stage, problem=problem)
            messages += (
                Message("assistant", reply.strip() or "(nothing)"),
                Message("user", f"That cannot be used: {problem}. Answer again."),
            )
        raise LanguageModelError(
            f"{self._model.name}: no {stage} in {TRIES} replies: {problem}"
        )

    def _complete(self, stage: str, messages: tuple[Message, ...]) -> str:
        self.left -= 1
        self._asked[stage] = number = self._asked.get(stage, 0) + 1
        version = guide_prompts(stage)[stage]
        completion = self._model.complete(
            CompletionRequest(
                messages,
                max_tokens=MAX_TOKENS,
                question=Question(stage, version, number),
            )
        )
        self._journal.count(completion, stage=stage)
        return completion.text
