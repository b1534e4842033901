"""Limits on what a run may spend, kept by all its processes together."""

import json
import os
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import NamedTuple

from memorymaze.errors import SpendingLimitReached
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    Usage,
    takes_grammar,
)


class Spent(NamedTuple):
    """What was spent so far."""

    tokens: int
    """Of requests and replies together."""
    cost_usd: float


class Ledger:
    """A file that every process of a run adds its replies to, a line each.

    What a killed process had in hand is in it too, although its episode is not.
    """

    def __init__(self, path: Path | str | None) -> None:
        """Stand for a file, which may not be there yet; None for a single process."""
        self._path = None if path is None else Path(path)
        self._read = 0
        self._spent = Spent(0, 0.0)

    def add(self, usage: Usage) -> None:
        """Write down what a reply cost."""
        if self._path is None:
            self._spent = _sum(self._spent, usage)
            return
        line = json.dumps(asdict(usage)).encode() + b"\n"
        # One write to a file opened for appending is not mixed with that of others.
        handle = os.open(self._path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
        try:
            os.write(handle, line)
        finally:
            os.close(handle)

    def spent(self) -> Spent:
        """Return what all processes have spent until now."""
        if self._path is None:
            return self._spent
        try:
            with self._path.open("rb") as file:
                file.seek(self._read)
                new = file.read()
        except FileNotFoundError:
            return self._spent
        # A line that a killed process left unfinished, or that is being written.
        whole = new[: new.rfind(b"\n") + 1]
        self._read += len(whole)
        for line in whole.splitlines():
            try:
                usage = Usage(**json.loads(line))
            except (ValueError, TypeError):
                continue
            self._spent = _sum(self._spent, usage)
        return self._spent


@dataclass(frozen=True, slots=True)
class LimitedModel:
    """A model that is not asked any more once a limit is reached.

    The limit is looked at before each request, so that it is passed by at most what
    the requests cost that are under way at that moment.
    """

    model: LanguageModel
    ledger: Ledger
    max_cost: float | None = None
    """US dollars."""
    max_tokens: int | None = None
    """Of requests and replies together."""

    @property
    def name(self) -> str:
        """Name of the model asked."""
        return self.model.name

    @property
    def takes_grammar(self) -> bool:
        """Whether the model asked is held to a request's grammar."""
        return takes_grammar(self.model)

    def complete(self, request: CompletionRequest) -> Completion:
        """Ask the model, if there is something left to spend.

        Raises:
            SpendingLimitReached: There is not, or the server does not tell what it
                counts, so that no limit can be kept.
            LanguageModelError: No usable answer came.
        """
        spent = self.ledger.spent()
        if self.max_cost is not None and spent.cost_usd >= self.max_cost:
            raise SpendingLimitReached(
                f"{spent.cost_usd:.4f} USD are spent, of {self.max_cost:g} allowed with "
                "--max-cost"
            )
        if self.max_tokens is not None and spent.tokens >= self.max_tokens:
            raise SpendingLimitReached(
                f"{spent.tokens} tokens are used, of {self.max_tokens} allowed with "
                "--max-tokens-total"
            )
        completion = self.model.complete(request)
        self.ledger.add(completion.usage)
        if not completion.usage.completion_tokens:
            raise SpendingLimitReached(
                f"the server of {completion.model} does not tell how many tokens a reply "
                "has, so that no limit can be kept; leave --max-cost and "
                "--max-tokens-total out"
            )
        return completion


def _sum(spent: Spent, usage: Usage) -> Spent:
    tokens = usage.prompt_tokens + usage.completion_tokens
    return Spent(spent.tokens + tokens, spent.cost_usd + (usage.cost_usd or 0.0))
