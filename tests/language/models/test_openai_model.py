"""A client holds its own against servers that are down, slow, busy or talk nonsense."""

import contextlib
import gzip
import json
import socket
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest

from memorymaze.basics.errors import LanguageModelError, SettingsError
from memorymaze.language.models.model import (
    CompletionRequest,
    Message,
    Picture,
    UnusableReplyError,
    Usage,
)
from memorymaze.language.models.openai_model import OpenAIModel
from memorymaze.language.models.spending import PricedModel, TokenPrice

REQUEST = CompletionRequest(
    (Message("system", "Be brief."), Message("user", "Où aller ?")), max_tokens=77
)


def reply(text: object = "stop()", **more: object) -> dict[str, object]:
    """A server's good answer."""
    return {
        "id": "1",
        "object": "chat.completion",
        "created": 1,
        "model": "small-2024",
        "choices": [
            {
                "index": 0,
                "finish_reason": "stop",
                "message": {"role": "assistant", "content": text},
            }
        ],
        "usage": {
            "prompt_tokens": 1000,
            "completion_tokens": 200,
            "total_tokens": 1200,
        },
        **more,
    }


def refusal(text: str) -> dict[str, object]:
    """A server's answer in which the model will not."""
    message = {"role": "assistant", "content": None, "refusal": text}
    choice = {"index": 0, "finish_reason": "stop", "message": message}
    return reply(choices=[choice])


def failure(status: int, message: str = "no", **details: object) -> tuple[int, object]:
    return status, {"error": {"message": message, **details}}


CLOSE = object()
"""An answer: the connection is closed without a word."""
HANG = object()
"""An answer: nothing, for longer than the client waits."""
CUT = object()
"""An answer: its first half, then the connection is cut."""
DRIP = object()
"""An answer: a byte now and then, without an end."""
DRIP_HEADERS = object()
"""An answer: one line of its head after the other, without an end."""
BOMB = object()
"""An answer: small on its way, and large when it is unpacked."""
FLOOD = object()
"""An answer: as fast as it goes, without an end."""


class Server:
    """Gives its answers in turn; the last one again and again."""

    def __init__(self, *answers: Any, headers: dict[str, str] | None = None) -> None:
        self.answers = list(answers)
        self.headers = headers or {}
        self.requests: list[dict[str, Any]] = []
        self.authorization: list[str | None] = []
        self.released = threading.Event()
        server = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                length = int(self.headers["content-length"])
                server.requests.append(json.loads(self.rfile.read(length)))
                server.authorization.append(self.headers["authorization"])
                rest = server.answers
                answer = rest.pop(0) if len(rest) > 1 else rest[0]
                if answer is HANG:
                    server.released.wait(5)
                if answer in (HANG, CLOSE):
                    self.close_connection = True
                    self.connection.shutdown(socket.SHUT_RDWR)
                    return
                if answer is DRIP_HEADERS:
                    self.close_connection = True
                    self.wfile.write(b"HTTP/1.1 200 OK\r\n")
                    with contextlib.suppress(OSError):
                        while not server.released.wait(0.001):
                            self.wfile.write(b"x-more: to come\r\n")
                    return
                if answer is BOMB:
                    data = gzip.compress(b" " * 2**22)
                    self.send_response(200)
                    self.send_header("content-encoding", "gzip")
                    self.send_header("content-length", str(len(data)))
                    self.end_headers()
                    self.wfile.write(data)
                    return
                if answer in (CUT, DRIP, FLOOD):
                    self.send_response(200)
                    self.send_header("content-type", "application/json")
                    self.send_header("content-length", str(2**40))
                    self.end_headers()
                    self.close_connection = True
                    part = b" " * (2**20 if answer is FLOOD else 1)
                    with contextlib.suppress(OSError):
                        self.wfile.write(b'{"choices": [')
                        while answer is not CUT and not server.released.wait(
                            0.001 if answer is DRIP else 0
                        ):
                            self.wfile.write(part)
                    return
                status, body = answer if isinstance(answer, tuple) else (200, answer)
                kind = "text/html" if body == "<html>" else "application/json"
                data = (
                    body.encode()
                    if isinstance(body, str)
                    else json.dumps(body).encode()
                )
                self.send_response(status)
                self.send_header("content-type", kind)
                self.send_header("content-length", str(len(data)))
                for name, value in server.headers.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(data)

            def log_message(self, format: str, *args: object) -> None:
                """Keep the tests' output clean."""

        self._http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._http.daemon_threads = True
        self.url = f"http://127.0.0.1:{self._http.server_port}/v1"
        self._thread = threading.Thread(
            target=self._http.serve_forever, kwargs={"poll_interval": 0.005}
        )

    def __enter__(self) -> "Server":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.released.set()
        self._http.shutdown()
        self._thread.join()
        self._http.server_close()

    def model(self, **options: Any) -> OpenAIModel:
        options = {"first_delay": 0.001, "timeout": 5.0, **options}
        return OpenAIModel("small", base_url=self.url, api_key="key", **options)


@pytest.fixture(autouse=True)
def no_settings_from_outside(monkeypatch: pytest.MonkeyPatch) -> None:
    for prefix in ("MEMORYMAZE", "OPENAI"):
        for name in ("BASE_URL", "API_KEY"):
            monkeypatch.delenv(f"{prefix}_{name}", raising=False)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")


@contextlib.contextmanager
def unreachable() -> Iterator[str]:
    """An address nobody listens at."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        yield f"http://127.0.0.1:{taken.getsockname()[1]}/v1"


def test_a_request_goes_out_and_its_reply_comes_back_with_its_cost():
    with Server(reply("Turn left. é")) as server:
        model = PricedModel(server.model(), TokenPrice(2.5, 10))
        completion = model.complete(REQUEST)

    assert completion.text == "Turn left. é"
    assert completion.model == "small-2024"
    assert completion.usage == Usage(1000, 200, 0.0045)
    assert completion.latency > 0
    assert server.authorization == ["Bearer key"]
    assert server.requests == [
        {
            "model": "small",
            "messages": [
                {"role": "system", "content": "Be brief."},
                {"role": "user", "content": "Où aller ?"},
            ],
            "temperature": 0.0,
            "max_tokens": 77,
        }
    ]


def test_pictures_go_out_beside_their_text():
    picture = Picture(b"\xff\xd8\xff\xe0", "image/jpeg")
    request = CompletionRequest((Message("user", "Which way?", (picture,)),))
    with Server(reply("left")) as server:
        server.model().complete(request)

    assert server.requests[0]["messages"][0]["content"] == [
        {"type": "text", "text": "Which way?"},
        {"type": "image_url", "image_url": {"url": "data:image/jpeg;base64,/9j/4A=="}},
    ]


def test_grammars_go_only_to_servers_that_keep_to_them():
    request = CompletionRequest(REQUEST.messages, grammar='root ::= "left"')
    with Server(reply("left")) as server:
        for kind in (None, "llama.cpp", "vllm"):
            server.model(grammar_server=kind).complete(request)

    free, llama, vllm = server.requests
    assert "grammar" not in free
    assert llama["grammar"] == request.grammar
    assert vllm["structured_outputs"] == {"grammar": request.grammar}


@pytest.mark.parametrize("kind", ["image/png", "image/gif"])
def test_what_is_no_picture_of_its_kind_is_refused(kind: Any):
    with pytest.raises(ValueError, match="expected the bytes of an image/jpeg or"):
        Picture(b"\xff\xd8\xff\xe0", kind)


def test_without_a_price_the_cost_is_unknown_and_without_usage_nothing_is_counted():
    with Server(reply(usage=None)) as server:
        completion = server.model().complete(REQUEST)

    assert completion.usage == Usage(0, 0, None)


@pytest.mark.parametrize(
    "trouble",
    [
        failure(429),
        failure(500),
        failure(503),
        failure(408),
        CLOSE,
        CUT,
        (502, "<html>"),
    ],
    ids=["busy", "failing", "overloaded", "too slow", "hangs up", "cut", "bad gateway"],
)
def test_passing_trouble_is_tried_again(trouble: object):
    with Server(trouble, trouble, reply("at last")) as server:
        assert server.model().complete(REQUEST).text == "at last"

    assert len(server.requests) == 3


@pytest.mark.parametrize(
    "trouble",
    [HANG, DRIP, DRIP_HEADERS],
    ids=["silent", "without an end", "without an end of its head"],
)
def test_a_slow_answer_is_tried_again(trouble: object):
    with Server(trouble, reply("at last")) as server:
        assert server.model(timeout=0.3).complete(REQUEST).text == "at last"


def test_a_flood_is_stemmed_and_not_asked_for_again():
    with (
        Server(FLOOD) as server,
        pytest.raises(LanguageModelError, match="more than 8388608 bytes"),
    ):
        server.model().complete(REQUEST)
    assert len(server.requests) == 1


def test_waits_double_unless_the_server_asks_for_longer(monkeypatch):
    waits: list[float] = []
    monkeypatch.setattr("time.sleep", waits.append)

    with Server(failure(500)) as server, pytest.raises(LanguageModelError):
        server.model(first_delay=2.0).complete(REQUEST)
    with (
        Server(failure(429), headers={"retry-after": "7"}) as server,
        pytest.raises(LanguageModelError),
    ):
        server.model(first_delay=2.0, retries=3).complete(REQUEST)
    with (
        Server(failure(429), headers={"retry-after": "86400"}) as server,
        pytest.raises(LanguageModelError),
    ):
        server.model(retries=1).complete(REQUEST)

    assert waits == [2, 4, 8, 16, 7, 7, 8, 60]


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (failure(429, "slow down"), "answered 429: .*slow down.* (3 attempts)"),
        (failure(500, "oh\nno"), "answered 500: .* (3 attempts)"),
        (CLOSE, "cannot be reached: .* (3 attempts)"),
        (CUT, "cannot be reached: .* (3 attempts)"),
        (HANG, "did not answer in time (3 attempts)"),
        (DRIP, "did not answer in time (3 attempts)"),
        (DRIP_HEADERS, "did not answer in time (3 attempts)"),
        (BOMB, "sent an answer that is compressed (gzip)"),
        ((200, '{"choices": ' + "[" * 100_000), "sent an answer not JSON"),
        (reply(usage={"prompt_tokens": 10**30}), "that counts 10000000000"),
        (reply(usage={"completion_tokens": 1e30}), "that counts 1e.30 completion_to"),
        (reply(usage={"prompt_tokens": -1}), "that counts -1 prompt_tokens"),
        (reply(usage={"prompt_tokens": "many"}), "that counts 'many' prompt_tokens"),
        (failure(401, "bad key"), "answered 401: .*bad key"),
        (failure(404, "no such model"), "answered 404: .*no such model"),
        (
            failure(429, "paid up?", code="insufficient_quota"),
            "answered 429: .*paid up",
        ),
        ((200, "{'choices': ["), "sent an answer not JSON"),
        ((200, "<html>"), "sent an answer without a choice in it"),
        ((200, "[]"), "sent an answer without a choice in it"),
        (reply(choices=[]), "sent an answer without a choice in it"),
        (reply(choices=None), "sent an answer without a choice in it"),
        (reply(choices=[{}]), "without text in it (finish_reason None)"),
        (reply(choices=["yes"]), "without text in it"),
        (reply(None), "without text in it (finish_reason stop)"),
        (refusal("I cannot help with that."), "without text in it.*cannot help with"),
        (reply(" \n"), "without text in it (finish_reason stop)"),
        (reply(5), "without text in it"),
        (reply("left \ud800"), "with halves of characters in it"),
        (reply("x" * 200_001), "of 200001 characters, more than 200000"),
    ],
)
def test_every_failure_is_one_line_with_its_cause(answer: object, message: str):
    pattern = message.replace("(", r"\(").replace(")", r"\)")
    slow = any(answer is each for each in (HANG, DRIP, DRIP_HEADERS))
    with (
        Server(answer) as server,
        pytest.raises(LanguageModelError, match=pattern) as caught,
    ):
        server.model(retries=2, timeout=0.05 if slow else 5.0).complete(REQUEST)

    assert str(caught.value).startswith(f"language model small at {server.url} ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "answer",
    [
        reply(None),
        reply(choices=[]),
        reply("x" * 200_001),
        refusal("I cannot help with that."),
    ],
    ids=["no text", "no choice", "endless", "refused"],
)
def test_an_answer_that_is_no_reply_says_what_it_cost(answer: object):
    with Server(answer) as server, pytest.raises(UnusableReplyError) as caught:
        server.model().complete(REQUEST)

    assert caught.value.usage == Usage(1000, 200)


def test_what_would_fail_again_is_not_tried_again():
    for answer in (failure(401), failure(400), reply(choices=[])):
        with Server(answer) as server, pytest.raises(LanguageModelError):
            server.model().complete(REQUEST)
        assert len(server.requests) == 1


def test_a_server_that_is_down_is_a_model_error():
    with unreachable() as url:
        model = OpenAIModel("small", base_url=url, retries=1, first_delay=0)
        with pytest.raises(LanguageModelError, match=r"cannot be reached: .*refused"):
            model.complete(REQUEST)


def test_a_server_that_renamed_the_length_limit_is_asked_its_way():
    complaint = failure(400, "Use 'max_completion_tokens' instead of 'max_tokens'.")
    with Server(complaint, reply("one"), reply("two")) as server:
        model = server.model()
        said = [model.complete(REQUEST).text for _ in range(2)]

    assert said == ["one", "two"]
    assert ["max_tokens" in request for request in server.requests] == [
        True,
        False,
        False,
    ]
    assert server.requests[-1]["max_completion_tokens"] == 77


def test_address_and_key_come_from_the_environment(monkeypatch):
    with Server(reply("x")) as server:
        monkeypatch.setenv("OPENAI_BASE_URL", "http://127.0.0.1:9/v1")
        monkeypatch.setenv("MEMORYMAZE_BASE_URL", server.url)
        monkeypatch.setenv("OPENAI_API_KEY", "other")
        assert OpenAIModel("small").complete(REQUEST).text == "x"
        monkeypatch.setenv("MEMORYMAZE_API_KEY", "mine")
        assert OpenAIModel("small").complete(REQUEST).text == "x"

    assert server.authorization == ["Bearer other", "Bearer mine"]


def test_openais_own_server_needs_a_key():
    with pytest.raises(SettingsError, match="set MEMORYMAZE_API_KEY or OPENAI_API_KEY"):
        OpenAIModel("gpt-4")


@pytest.mark.parametrize(
    ("model", "options"),
    [
        ("", {}),
        ("m", {"timeout": 0}),
        ("m", {"retries": -1}),
        ("m", {"base_url": "::"}),
    ],
    ids=["no name", "no time", "negative retries", "no address"],
)
def test_settings_without_meaning_are_refused(model: str, options: dict[str, Any]):
    with pytest.raises(SettingsError):
        OpenAIModel(model, **{"base_url": "http://127.0.0.1:9/v1", **options})
