"""What replies cost, and the limits on spending that all processes of a run keep together."""

import fcntl
import json
import math
import os
import time
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import ClassVar, NamedTuple

from memorymaze.basics.errors import SettingsError, SpendingLimitReached
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    UnusableReplyError,
    Usage,
    WrappedModel,
)

LOOKING_PERIOD = 0.02
"""Seconds between looks for a free place."""


@dataclass(frozen=True, slots=True)
class TokenPrice:
    """What a server charges, in US dollars per million tokens."""

    form: ClassVar[str] = (
        "PROMPT,COMPLETION in US dollars per million tokens, such as 0.15,0.60"
    )

    prompt: float
    completion: float

    @classmethod
    def parse(cls, text: str) -> "TokenPrice":
        """Read `PROMPT,COMPLETION`."""
        prompt, completion = map(float, text.split(","))
        return cls(prompt, completion)

    def __str__(self) -> str:
        """Write it as it is given."""
        return f"{self.prompt:g},{self.completion:g}"

    def __post_init__(self) -> None:
        """Refuse what is no price."""
        for amount in (self.prompt, self.completion):
            if not (math.isfinite(amount) and amount >= 0):
                raise SettingsError(
                    "price: expected US dollars per million tokens, at least 0, got "
                    f"{amount!r}"
                )

    def cost(self, prompt_tokens: int, completion_tokens: int) -> float:
        """Return what a reply cost, US dollars."""
        return (
            prompt_tokens * self.prompt + completion_tokens * self.completion
        ) / 1_000_000


class PricedModel(WrappedModel):
    """A model whose replies say what they cost."""

    def __init__(self, model: LanguageModel, price: TokenPrice) -> None:
        """Put prices on a model's replies."""
        super().__init__(model)
        self._price = price

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the model's reply with its cost."""
        try:
            completion = self._model.complete(request)
        except UnusableReplyError as unusable:
            unusable.usage = self._priced(unusable.usage)
            raise
        return replace(completion, usage=self._priced(completion.usage))

    def _priced(self, usage: Usage) -> Usage:
        cost = self._price.cost(usage.prompt_tokens, usage.completion_tokens)
        return replace(usage, cost_usd=cost)


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


class LimitedModel(WrappedModel):
    """A model that is not asked any more once a limit is reached.

    The limit is looked at before each request, so that it is passed by at most what
    the requests cost that are under way at that moment.
    """

    def __init__(
        self,
        model: LanguageModel,
        ledger: Ledger,
        max_cost: float | None = None,
        max_tokens: int | None = None,
    ) -> None:
        """Limit US dollars, or tokens of requests and replies together, or only add up."""
        super().__init__(model)
        self.ledger = ledger
        self.max_cost = max_cost
        self.max_tokens = max_tokens
        self._all_told = True

    def complete(self, request: CompletionRequest) -> Completion:
        """Ask the model, if there is something left to spend."""
        limited = self.max_cost is not None or self.max_tokens is not None
        if limited and not self._all_told:
            raise SpendingLimitReached(
                f"the server of {self.name} does not tell how many tokens a request and "
                "its reply have, so that no limit can be kept; leave --max-cost and "
                "max_tokens_total out"
            )
        spent = self.ledger.spent()
        if self.max_cost is not None and spent.cost_usd >= self.max_cost:
            raise SpendingLimitReached(
                f"{spent.cost_usd:.4f} USD are spent, of {self.max_cost:g} allowed with "
                "--max-cost; raise it to go on"
            )
        if self.max_tokens is not None and spent.tokens >= self.max_tokens:
            raise SpendingLimitReached(
                f"{spent.tokens} tokens are used, of {self.max_tokens} allowed with "
                "max_tokens_total; raise it to go on"
            )
        try:
            completion = self._model.complete(request)
        except UnusableReplyError as unusable:
            self.ledger.add(unusable.usage)
            raise
        usage = completion.usage
        self.ledger.add(usage)
        # This reply is paid for, and given; only the next one is not asked for.
        self._all_told &= usage.prompt_tokens > 0 and usage.completion_tokens > 0
        return completion


def _sum(spent: Spent, usage: Usage) -> Spent:
    tokens = usage.prompt_tokens + usage.completion_tokens
    return Spent(spent.tokens + tokens, spent.cost_usd + (usage.cost_usd or 0.0))


class QueuedModel(WrappedModel):
    """A model that is asked only while fewer requests than a limit are under way.

    The places are locks on single bytes of one file, which the system gives back when
    a process ends, however it ends. Waiting for a place is no part of the latency.
    """

    def __init__(self, model: LanguageModel, path: Path | str, places: int) -> None:
        """Prepare to queue."""
        super().__init__(model)
        self._path = Path(path)
        self._places = places

    def complete(self, request: CompletionRequest) -> Completion:
        """Wait for a place and ask."""
        with self._place():
            return self._model.complete(request)

    @contextmanager
    def _place(self) -> Generator[None]:
        with self._path.open("ab") as file:
            while not any(
                _taken(file.fileno(), place) for place in range(self._places)
            ):
                time.sleep(LOOKING_PERIOD)
            # Closing the file gives the place back.
            yield


def _taken(handle: int, place: int) -> bool:
    """Take a place if it is free."""
    try:
        fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, place)
    except (BlockingIOError, PermissionError):
        return False
    return True
