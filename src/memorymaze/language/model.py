"""The role of a language model, and what goes in and out of it."""

from dataclasses import dataclass
from typing import Literal, Protocol

__all__ = ["Completion", "CompletionRequest", "LanguageModel", "Message", "Usage"]


@dataclass(frozen=True, slots=True)
class Message:
    """One turn of a conversation."""

    role: Literal["system", "user", "assistant"]
    content: str


@dataclass(frozen=True, slots=True)
class CompletionRequest:
    """All that determines a reply: the key of recorded replies."""

    messages: tuple[Message, ...]
    temperature: float = 0.0
    max_tokens: int = 2048
    seed: int | None = None


@dataclass(frozen=True, slots=True)
class Usage:
    """What a reply cost."""

    prompt_tokens: int = 0
    completion_tokens: int = 0
    cost_usd: float | None = None
    """None where no price is known."""


@dataclass(frozen=True, slots=True)
class Completion:
    """A model's reply."""

    text: str
    model: str
    usage: Usage
    latency: float
    """Seconds from request to reply."""


class LanguageModel(Protocol):
    """Anything that answers a conversation."""

    @property
    def name(self) -> str:
        """Name shown in tables."""
        ...

    def complete(self, request: CompletionRequest) -> Completion:
        """Answer a conversation.

        Raises:
            LanguageModelError: No usable answer came, after all retries.
        """
        ...
