"""One answer as a line of JSON, and the key by which it is found."""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields, replace
from typing import Annotated, Any

from pydantic import Field, StringConstraints, TypeAdapter, ValidationError

from memorymaze.basics.errors import LanguageModelError
from memorymaze.basics.input_files import mistakes, unknown_fields
from memorymaze.language.models.model import (
    MOST_TOKENS,
    Completion,
    CompletionRequest,
    Picture,
    Usage,
)

_Text = Annotated[str, StringConstraints(min_length=1, pattern=r"\S")]
TokenCount = Annotated[int, Field(ge=0, le=MOST_TOKENS)]
Amount = Annotated[float, Field(ge=0, le=1e9)]


@dataclass(frozen=True, slots=True)
class KeptAnswer:
    """One line: an answer, why there is none, or a question that is open."""

    key: _Text | None = None
    """Of what was asked (`request_key`); None where somebody wrote the answer by hand."""
    pictures: _Text | None = None
    """Digest of the pictures that were shown, where the key knows them by their names."""
    instruction_id: _Text | None = None
    stage: _Text | None = None
    """One without a variant answers all its variants."""
    number: Annotated[int, Field(ge=1)] = 1
    prompt: _Text | None = None
    """Version of the prompt; None where nobody says."""
    model: _Text | None = None
    """The model asked; None for an answer by hand, which is no inference."""
    reply: str | None = None
    error: str | None = None
    """Why there is no reply."""
    answered_by: _Text | None = None
    """What the server calls itself, where that is another name."""
    prompt_tokens: TokenCount = 0
    completion_tokens: TokenCount = 0
    cost_usd: Amount | None = None
    latency_s: Amount = 0.0

    @property
    def is_open(self) -> bool:
        """Whether the question was only asked so far."""
        return self.reply is None and self.error is None

    @property
    def id(self) -> str:
        """Name of the request in batch files."""
        known = (self.stage, self.instruction_id, (self.key or "")[:12])
        return "/".join(each for each in known if each)

    def answers(self, stage: str) -> bool:
        """Tell whether it answers a stage, such as `program` that of `program+parser`."""
        return stage == self.stage or stage.startswith(f"{self.stage}+")

    @classmethod
    def asked(cls, model: str, request: CompletionRequest) -> "KeptAnswer":
        """Return a request as a question that is open."""
        key, pictures = request_key(model, request), pictures_shown(request)
        told = request.question
        if told is None:
            return cls(key, pictures, model=model)
        named = told.instruction or None, told.stage, told.number, told.prompt
        return cls(key, pictures, *named, model=model)

    def said(self, completion: Completion) -> "KeptAnswer":
        """Return the question with a model's reply."""
        usage, name = completion.usage, completion.model
        return replace(
            self,
            reply=completion.text,
            answered_by=None if name in {"", self.model} else name,
            prompt_tokens=usage.prompt_tokens,
            completion_tokens=usage.completion_tokens,
            cost_usd=usage.cost_usd,
            latency_s=completion.latency,
        )

    def completion(self, model: str) -> Completion:
        """Return what was said; `LanguageModelError` says why nothing was.

        An answer by hand gets the name of the model in whose place it is given.
        """
        if self.reply is None:
            raise LanguageModelError(self.error or "the model did not answer")
        usage = Usage(self.prompt_tokens, self.completion_tokens, self.cost_usd)
        name = self.answered_by or self.model or model
        inferred = self.model is not None
        return Completion(self.reply, name, usage, self.latency_s, inferred)

    def line(self) -> str:
        """Return it as a line of a file; what says nothing is left out."""
        told = asdict(self).items()
        given = {name: value for name, value in told if value != DEFAULTS[name]}
        # In ASCII, so that a line that is broken off is never broken in a character.
        return json.dumps(given)

    @classmethod
    def of_record(cls, content: dict[str, Any]) -> tuple["KeptAnswer", list[str]]:
        """Read what a line says; return it, and the fields that the format does not know."""
        unknown = unknown_fields(content, DEFAULTS)
        try:
            found = _LINE.validate_python(content)
        except ValidationError as error:
            where, what = next(mistakes(error))
            raise ValueError(f"field {where!r}: {what}") from None
        got = [name for name in ("reply", "error") if getattr(found, name) is not None]
        if len(got) == 2 or not (got or found.key):
            raise ValueError(
                "expected `reply`, or `error` that says why there is none, got "
                f"{'both' if got else 'neither'}"
            )
        for name in ("instruction_id", "stage") if found.key is None else ():
            if getattr(found, name) is None:
                raise ValueError(f"field {name!r} is missing: what is answered")
        return found, unknown


_LINE = TypeAdapter(KeptAnswer)
DEFAULTS = {each.name: each.default for each in fields(KeptAnswer)}
"""Fields of a line, with what is meant where one is left out."""


def request_key(model: str, request: CompletionRequest) -> str:
    """Return the key of an answer: a digest of the model's name and the request.

    Pictures count by their names, which say which they are whatever their pixels; one
    without a name by its bytes. What the reply may be held to does not count.
    """
    return _digest([
        model,
        {
            "messages": [
                {"role": message.role, "content": message.content}
                | (
                    {"pictures": list(_named(message.pictures))}
                    if message.pictures
                    else {}
                )
                for message in request.messages
            ],
            "temperature": request.temperature,
            "max_tokens": request.max_tokens,
            "seed": request.seed,
        },
    ])


def _named(pictures: tuple[Picture, ...]) -> Iterator[dict[str, object]]:
    for each in pictures:
        yield _fingerprint(each) if each.name is None else {"name": each.name}


def pictures_shown(request: CompletionRequest) -> str | None:
    """Return a digest of all pictures; None where none has a name."""
    shown = [each for message in request.messages for each in message.pictures]
    if all(each.name is None for each in shown):
        return None
    return _digest(list(map(_fingerprint, shown)))


def _fingerprint(picture: Picture) -> dict[str, object]:
    return {
        "media_type": picture.media_type,
        "bytes": len(picture.data),
        "sha256": hashlib.sha256(picture.data).hexdigest(),
    }


def _digest(content: object) -> str:
    asked = json.dumps(content, sort_keys=True)
    return hashlib.sha256(asked.encode()).hexdigest()
