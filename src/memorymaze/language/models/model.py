"""The role of a language model, and what goes in and out of it."""

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

from memorymaze.basics.errors import LanguageModelError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST_TOKENS = 10_000_000
"""Of a request or a reply; what counts more is taken for garbage."""
LONGEST_REPLY = 200_000
"""Characters beyond which a reply is taken for garbage."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture shown to a model, in the bytes of its file.

    Raises:
        ValueError: There are no bytes, or they are not of the format named.
    """

    data: bytes
    media_type: Literal["image/jpeg", "image/png"]
    name: str | None = None
    """Says which picture this is, whatever its pixels; None where only they can tell.
    A replay finds its replies by it on a machine that draws other pixels."""

    @classmethod
    def of_pixels(
        cls, rgb: "NDArray[np.uint8]", name: str | None = None, *, quality: int = 90
    ) -> "Picture":
        """Return pixels, (height, width, 3), as a JPEG file of a quality up to 95."""
        # The help of the command line loads this file, and must come at once.
        from PIL import Image

        file = io.BytesIO()
        Image.fromarray(rgb).save(file, "JPEG", quality=quality)
        return cls(file.getvalue(), "image/jpeg", name)

    def __post_init__(self) -> None:
        """Refuse what no server could read."""
        beginning = {"image/jpeg": b"\xff\xd8\xff", "image/png": b"\x89PNG\r\n\x1a\n"}
        expected = beginning.get(self.media_type)
        if expected is None or not self.data.startswith(expected):
            raise ValueError(
                "picture: expected the bytes of an image/jpeg or image/png file, got "
                f"{len(self.data)} bytes said to be {self.media_type!r}"
            )


@dataclass(frozen=True, slots=True)
class Message:
    """One turn of a conversation."""

    role: Literal["system", "user", "assistant"]
    content: str
    pictures: tuple[Picture, ...] = ()
    """Shown after the text, in this order."""


@dataclass(frozen=True, slots=True)
class ModelQuestion:
    """Which question of an agent a request is; answers are found by it."""

    stage: str
    """What is asked for, such as `program+parser` or `step`."""
    prompt: str
    """Version of the prompt; see `prompt_texts.prompt_version`."""
    number: int = 1
    """Counts the requests of this stage in an episode."""
    instruction: str = ""
    """Id of the instruction; set by the run, since agents know none."""


@dataclass(frozen=True, slots=True)
class CompletionRequest:
    """All that determines a reply, and which question it answers."""

    messages: tuple[Message, ...]
    temperature: float = 0.0
    max_tokens: int = 2048
    seed: int | None = None
    grammar: str | None = None
    """GBNF grammar of the whole reply, for models that can be held to one; others
    never see it."""
    question: ModelQuestion | None = None
    """Does not determine the reply; None where it is found by the request alone."""


@dataclass(frozen=True, slots=True)
class Usage:
    """What a reply cost."""

    prompt_tokens: int = 0
    completion_tokens: int = 0
    cost_usd: float | None = None
    """None where no price is known."""


class UnusableReplyError(LanguageModelError):
    """A model's answer is no reply, and cost what one does."""

    def __init__(self, message: str, usage: Usage) -> None:
        """Keep what the answer cost, as far as the server tells."""
        super().__init__(message)
        self.usage = usage


@dataclass(frozen=True, slots=True)
class Completion:
    """A model's reply."""

    text: str
    model: str
    usage: Usage
    latency: float
    """Seconds from request to reply."""
    inferred: bool = True
    """False for an answer that somebody wrote into a file: it is no inference."""


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


def takes_pictures(model: LanguageModel) -> bool:
    """Tell whether a model may be shown pictures.

    Models that see none say so by an attribute `takes_pictures`.
    """
    return bool(getattr(model, "takes_pictures", True))


def stages_answered(model: LanguageModel) -> frozenset[str]:
    """Return the stages to which a model that replays has answers, such as `program`.

    Models that are asked have no attribute `stages_answered`.
    """
    return getattr(model, "stages_answered", frozenset[str]())


class WrappedModel:
    """A model asked through something; it keeps the name of the model that answers."""

    def __init__(self, model: LanguageModel) -> None:
        """Stand before a model."""
        self._model = model

    @property
    def name(self) -> str:
        """Name of the model asked."""
        return self._model.name

    @property
    def takes_pictures(self) -> bool:
        """Whether the model asked may be shown pictures."""
        return takes_pictures(self._model)

    @property
    def stages_answered(self) -> frozenset[str]:
        """The stages that the model asked has answers to, where it replays."""
        return stages_answered(self._model)


def why_unusable(
    text: object, finish_reason: object = None, refusal: object = None
) -> str | None:
    """Say what is wrong with the text of an answer, or return None when it is a reply."""
    if not isinstance(text, str) or not text.strip():
        said = ""
        if isinstance(refusal, str):
            said = f"; it refuses: {' '.join(refusal.split())[:200]}"
        return f"without text in it (finish_reason {finish_reason}){said}"
    if len(text) > LONGEST_REPLY:
        return f"of {len(text)} characters, more than {LONGEST_REPLY}"
    if any("\ud800" <= each <= "\udfff" for each in text):
        return "with halves of characters in it"
    return None
