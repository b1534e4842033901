"""The role of an agent: text and a robot in, motion out."""

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from memorymaze.robot.api import Robot

__all__ = ["Agent", "Journal"]


@dataclass
class Journal:
    """What an agent thought and spent during one episode; kept even when it fails.

    Everything noted goes to the episode's trace.

    Raises:
        ValueError: Something that is no count, or no amount, is assigned as one.
    """

    model_calls: int = 0
    tokens: int = 0
    """Of all requests and replies together."""
    cost_usd: float = 0.0
    notes: list[dict[str, Any]] = field(default_factory=list[dict[str, Any]])
    listener: Callable[[dict[str, Any]], None] | None = None

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse what could not be added up, in the line that assigns it."""
        if name in {"model_calls", "tokens", "cost_usd"}:
            value = _amount(name, value)
        super().__setattr__(name, value)

    def note(self, kind: str, **details: Any) -> None:
        """Write down a thought: `kind` such as `steps`, `program`, `model_reply`."""
        entry = {"kind": kind, **details}
        self.notes.append(entry)
        if self.listener is not None:
            self.listener(entry)


def _amount(name: str, value: Any) -> int | float:
    try:
        amount = float(value) if name == "cost_usd" else operator.index(value)
        if math.isfinite(amount) and amount >= 0:
            return amount
    except (TypeError, ValueError):
        pass
    what = "an amount" if name == "cost_usd" else "a whole number"
    raise ValueError(f"journal.{name}: expected {what} of at least 0, got {value!r}")


class Agent(Protocol):
    """Follows one instruction at a time.

    The whole life of an agent:

        agent = AGENTS["rules"]()
        for episode in episodes:
            agent.follow(text, robot, journal, rng)   # returns: the agent stopped

    Returning, or calling `robot.stop()`, says "we are there". `EpisodeOver` raised by
    the robot passes through; `ProgramError` and `LanguageModelError` may be raised and
    end the episode as `crash`, `unsafe` or `model_error`.
    """

    @property
    def name(self) -> str:
        """Name shown in tables."""
        ...

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive the robot as the instruction says."""
        ...
