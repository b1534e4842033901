"""Requests and replies of offline inference: JSONL files, one record per line.

Requests are in the format of OpenAI's batch service, which vLLM's `run-batch` reads too.
Replies are read in the format that both write; scripts of one's own write `custom_id` and
the fields of an answer (`kept_answers`), such as `reply`.
"""

import base64
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, Field, StringConstraints, ValidationError

from memorymaze.basics.errors import AnswerFileError
from memorymaze.basics.input_files import mistakes, parse_record, read_lines, refusal
from memorymaze.language.models.kept_answers import KeptAnswer, TokenCount
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    Message,
    Usage,
    why_unusable,
)


@dataclass(frozen=True, slots=True)
class BatchReply:
    """What came of one request."""

    id: str
    """The request's `custom_id`."""
    completion: Completion | None
    """None where the model did not answer."""
    error: str | None
    """Why there is no completion."""
    place: str
    """`file:line`."""


class _ReplyUsage(BaseModel):
    prompt_tokens: TokenCount | None = None
    completion_tokens: TokenCount | None = None


class _ReplyMessage(BaseModel):
    content: str | None = None
    refusal: str | None = None


class _ReplyChoice(BaseModel):
    message: _ReplyMessage
    finish_reason: str | None = None


class _ReplyBody(BaseModel):
    """A chat completion."""

    choices: Annotated[list[_ReplyChoice], Field(min_length=1)]
    model: str = ""
    usage: _ReplyUsage | None = None


class _ReplyResponse(BaseModel):
    status_code: int = 200
    body: Any = None


class _ReplyLine(BaseModel):
    custom_id: Annotated[str, StringConstraints(min_length=1)]
    response: _ReplyResponse | None = None
    error: Any = None


def request_line(
    identifier: str,
    model: str,
    request: CompletionRequest,
    *,
    length_field: str = "max_tokens",
) -> str:
    """Return a request as a line of a batch file, without the line end.

    `length_field` is what the server calls the longest reply.
    """
    body: dict[str, Any] = {
        "model": model,
        "messages": [
            {"role": message.role, "content": content_of(message)}
            for message in request.messages
        ],
        "temperature": request.temperature,
        length_field: request.max_tokens,
    }
    if request.seed is not None:
        body["seed"] = request.seed
    record = {
        "custom_id": identifier,
        "method": "POST",
        "url": "/v1/chat/completions",
        "body": body,
    }
    # In ASCII: some readers take U+2028 and the like in a text for line ends.
    return json.dumps(record)


def content_of(message: Message) -> str | list[dict[str, Any]]:
    """Return a message's text, or text and pictures as the parts of a list."""
    if not message.pictures:
        return message.content
    parts: list[dict[str, Any]] = [{"type": "text", "text": message.content}]
    for picture in message.pictures:
        data = base64.b64encode(picture.data).decode("ascii")
        address = f"data:{picture.media_type};base64,{data}"
        parts.append({"type": "image_url", "image_url": {"url": address}})
    return parts


def read_replies(paths: Sequence[str | Path]) -> dict[str, BatchReply]:
    """Read files of replies; return the replies by their requests' `custom_id`.

    Where a request has failed replies and one that answers it, that one counts: failed
    requests may be run again, and the new file be read beside the old one.
    """
    replies: dict[str, BatchReply] = {}
    problems: list[str] = []
    for place, line in (
        each for path in paths for each in read_lines(path, AnswerFileError)
    ):
        try:
            reply = _reply(line, place)
        except ValueError as error:
            problems.append(f"{place}: {error}")
            continue
        earlier = replies.get(reply.id)
        if earlier is None or earlier.completion is None:
            replies[reply.id] = reply
        elif reply.completion is not None:
            problems.append(
                f"{place}: expected one answer to a request, got a second one to "
                f"{reply.id!r}, which {earlier.place} answers; delete one of the lines"
            )
    if problems:
        raise refusal(problems, AnswerFileError)
    return replies


def _reply(line: str, place: str) -> BatchReply:
    """Read one line."""
    record = parse_record(line)
    if "custom_id" not in record:
        raise ValueError(
            "expected a reply with the `custom_id` of its request, got the fields "
            f"{', '.join(map(str, record)) or 'none'}"
        )
    if "body" in record and "response" not in record:
        raise ValueError(
            "expected a reply, got a request: is this the file of replies?"
        )
    try:
        head = _ReplyLine.model_validate(record)
    except ValidationError as error:
        raise ValueError(_first_mistake(error)) from None
    if record.get("reply") is not None:
        told = {name: value for name, value in record.items() if name != "custom_id"}
        said = KeptAnswer.of_record({"key": head.custom_id} | told)[0].completion("")
        return _checked(head, said, why_unusable(said.text), place)
    response = head.response
    if response is None or response.status_code != 200 or head.error:
        return BatchReply(head.custom_id, None, _failure(head), place)
    try:
        body = _ReplyBody.model_validate(response.body)
    except ValidationError as error:
        wrong = f"that cannot be read: {_first_mistake(error, 'response.body.')}"
        return _checked(head, None, wrong, place)
    usage = body.usage or _ReplyUsage()
    counted = Usage(usage.prompt_tokens or 0, usage.completion_tokens or 0)
    first = body.choices[0]
    message = first.message
    wrong = why_unusable(message.content, first.finish_reason, message.refusal)
    said = Completion(message.content or "", body.model, counted, latency=0.0)
    return _checked(head, said, wrong, place)


def _checked(
    head: _ReplyLine, said: Completion | None, wrong: str | None, place: str
) -> BatchReply:
    """Return a reply; what is no reply online is a failure here too."""
    if wrong is None:
        return BatchReply(head.custom_id, said, None, place)
    error = f"the language model sent an answer {wrong}"
    return BatchReply(head.custom_id, None, error, place)


def _failure(line: _ReplyLine) -> str:
    status = line.response.status_code if line.response else None
    told = line.error or (line.response.body if line.response else None)
    for name in ("error", "message"):
        if isinstance(told, dict) and name in told:
            told = told[name]
    what = f"answered {status}" if status not in {None, 200} else "failed"
    return f"the language model {what}: {' '.join(str(told).split())[:300]}"


def _first_mistake(error: ValidationError, inside: str = "") -> str:
    where, what = next(mistakes(error))
    return f"field {(inside + where).rstrip('.')!r}: {what}"
