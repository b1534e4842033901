"""Asking a language model about a walk: a bounded number of times, once more if need be."""

from collections.abc import Callable, Iterator

from memorymaze.agents.agent import Journal
from memorymaze.agents.asking import ReplyRecord, ask_until_read
from memorymaze.agents.closed_loop.walk_log import WalkLog
from memorymaze.language.models.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
)
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version

STAGE = "decision"
MOST_REQUESTS = 40
MAX_TOKENS = 1000
"""Of a reply."""


def load_rules() -> str:
    """Return the prompt that says what is always the same."""
    return load_prompt("closed_loop_rules")


def decision_prompts() -> dict[str, str]:
    """Return the version of the prompt, by its stage."""
    empty = dict.fromkeys(("instruction", "places", "steps", "now"), "")
    task = load_prompt("closed_loop_task", **empty)
    return {STAGE: prompt_version(load_rules(), task)}


class DecisionQuestions:
    """The questions of one episode, which are counted."""

    def __init__(
        self,
        instruction: str,
        model: LanguageModel,
        journal: Journal,
        log: WalkLog,
        most_requests: int = MOST_REQUESTS,
    ) -> None:
        """Ask a model about a text and a walk at most so often; second tries count."""
        self._instruction = instruction.strip()
        self._model = model
        self.journal = journal
        self.log = log
        self.left = most_requests
        """Requests that may still be made."""
        self._numbers = self._count(most_requests)

    def _count(self, most_requests: int) -> Iterator[int]:
        for number in range(1, most_requests + 1):
            self.left -= 1
            yield number
        raise _NoneLeft

    def ask(self, read: Callable[[str], ReplyRecord], now: str) -> ReplyRecord | None:
        """Return what is read from the reply; None where no request is left."""
        task = load_prompt(
            "closed_loop_task",
            instruction=self._instruction,
            places=self.log.places,
            steps=self.log.steps,
            now=now,
        )
        request = CompletionRequest(
            (Message("system", load_rules()), Message("user", task)),
            max_tokens=MAX_TOKENS,
        )
        question = ModelQuestion(STAGE, decision_prompts()[STAGE])
        try:
            return ask_until_read(
                self._model, self.journal, request, question, self._numbers, read
            )
        except _NoneLeft:
            return None


class _NoneLeft(Exception):
    """No more requests may be made."""
