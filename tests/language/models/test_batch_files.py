"""Requests go out and replies come in as OpenAI's batch files have them."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import AnswerFileError
from memorymaze.language.models.batch_files import read_replies, request_line
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    Message,
    Usage,
)

REQUEST = CompletionRequest((Message("system", "Be brief."), Message("user", "Näh?")))


def reply(identifier: str = "a", text: str | None = "Yes.", **changes: Any) -> dict:
    """A line of a batch service."""
    body = {
        "model": "m-1",
        "choices": [{"message": {"content": text}, "finish_reason": "length"}],
        "usage": {"prompt_tokens": 7, "completion_tokens": 2, "total_tokens": 9},
    }
    response = {"status_code": 200, "request_id": "x", "body": body}
    return {"id": "1", "custom_id": identifier, "response": response, "error": None} | (
        changes
    )


def test_a_request_is_a_line_of_openais_batch_format() -> None:
    assert json.loads(request_line("id/1", "m", REQUEST)) == {
        "custom_id": "id/1",
        "method": "POST",
        "url": "/v1/chat/completions",
        "body": {
            "model": "m",
            "messages": [
                {"role": "system", "content": "Be brief."},
                {"role": "user", "content": "Näh?"},
            ],
            "temperature": 0.0,
            "max_tokens": 2048,
        },
    }


def test_a_seed_and_another_name_of_the_length_are_written() -> None:
    request = CompletionRequest(REQUEST.messages, seed=3)
    body = json.loads(
        request_line("a", "m", request, length_field="max_completion_tokens")
    )["body"]
    assert body["seed"] == 3
    assert body["max_completion_tokens"] == 2048
    assert "max_tokens" not in body


def test_a_request_is_one_line_to_every_reader() -> None:
    strange = CompletionRequest((Message("user", "left\u2028right\x85\x1dstop\r\n"),))
    line = request_line("a", "m", strange)
    assert len(line.splitlines()) == 1
    assert json.loads(line)["body"]["messages"][0]["content"] == (
        strange.messages[0].content
    )


def test_a_batch_services_reply_is_a_completion(file: Callable[..., Path]) -> None:
    found = read_replies([file(reply())])["a"]
    assert found.completion == Completion("Yes.", "m-1", Usage(7, 2), 0.0)
    assert found.place.endswith("answers.jsonl:1")


def test_a_plain_reply_is_a_completion(file: Callable[..., Path]) -> None:
    plain = {"custom_id": "a", "reply": "Yes.", "model": "m", "latency_s": 1.5}
    found = read_replies([file(plain, reply("b"))])
    assert found["a"].completion == Completion("Yes.", "m", Usage(), 1.5)
    assert set(found) == {"a", "b"}


@pytest.mark.parametrize(
    ("line", "why"),
    [
        pytest.param(
            reply(response={"status_code": 500, "body": {"error": {"message": "Oh."}}}),
            "answered 500: Oh.",
            id="status",
        ),
        pytest.param(
            reply(response=None, error={"code": "expired", "message": "Too late."}),
            "failed: Too late.",
            id="expired",
        ),
        pytest.param(
            reply(response={"status_code": 200, "body": {"choices": []}}),
            "cannot be read: field 'response.body.choices'",
            id="no choices",
        ),
        pytest.param(
            reply(response={"status_code": 200, "body": None}),
            "cannot be read: field 'response.body'",
            id="no body",
        ),
        pytest.param(reply(text=" "), "finish_reason length", id="empty"),
        pytest.param(reply(text=None), "without text", id="null"),
        pytest.param(reply(text="\ud800"), "halves of characters", id="halves"),
        pytest.param(reply(text="x" * 200_001), "200001 characters", id="endless"),
        pytest.param({"custom_id": "a", "reply": ""}, "without text", id="plain"),
    ],
)
def test_a_request_that_failed_says_why(
    file: Callable[..., Path], line: dict, why: str
) -> None:
    found = read_replies([file(line)])["a"]
    assert found.completion is None
    assert why in str(found.error)


def test_a_bad_answer_leaves_the_good_ones(file: Callable[..., Path]) -> None:
    bad = reply("b", response={"status_code": 200, "body": {"choices": []}})
    found = read_replies([file(reply("a"), bad)])
    assert [each.completion is None for each in found.values()] == [False, True]


def test_counts_that_a_server_leaves_out_are_none_online_or_in_a_batch(
    file: Callable[..., Path],
) -> None:
    line = reply()
    line["response"]["body"]["usage"] = {"prompt_tokens": 7, "completion_tokens": None}
    found = read_replies([file(line)])["a"]
    assert found.completion == Completion("Yes.", "m-1", Usage(7, 0), 0.0)


@pytest.mark.parametrize("order", [1, -1])
def test_an_answer_counts_before_failures(
    file: Callable[..., Path], order: int
) -> None:
    first = file(reply(response=None, error="no"), name="first.jsonl")
    again = file(reply(), name="again.jsonl")
    found = read_replies([first, again][::order])["a"]
    assert found.completion is not None


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        pytest.param(
            ["{"], r"answers.jsonl:1: expected JSON, got a mistake", id="no json"
        ),
        pytest.param(["[1]"], "expected one JSON record", id="list"),
        pytest.param(['{"id": 1}'], "with the `custom_id`", id="no id"),
        pytest.param(
            [request_line("a", "m", REQUEST)],
            "is this the file of replies",
            id="request",
        ),
        pytest.param([reply(), reply()], ":2: .*second one to 'a'", id="twice"),
        pytest.param(
            [{"custom_id": 3, "reply": "x"}], "'custom_id': expected", id="number"
        ),
        pytest.param(
            [{"custom_id": "a", "reply": "x", "prompt_tokens": -1}],
            "'prompt_tokens': expected",
            id="tokens",
        ),
        pytest.param([""], "the file is empty", id="empty"),
        pytest.param(["{"] * 30, "30 problems(.|\n)*and 10 more", id="many"),
    ],
)
def test_what_is_no_reply_is_told_with_its_line(
    file: Callable[..., Path], lines: list[Any], said: str
) -> None:
    with pytest.raises(AnswerFileError, match=said):
        read_replies([file(*lines)])


def test_a_file_that_is_not_there_or_no_text_is_told(tmp_path: Path) -> None:
    with pytest.raises(AnswerFileError, match=r"none\.jsonl: cannot be read"):
        read_replies([tmp_path / "none.jsonl"])
    (tmp_path / "bytes.jsonl").write_bytes(b"{\xff}")
    with pytest.raises(AnswerFileError, match="expected UTF-8, got byte 0xff"):
        read_replies([tmp_path / "bytes.jsonl"])
