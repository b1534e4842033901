"""Policy servers: the reference one, and ones that misbehave in every way."""

import contextlib
import io
import json
import runpy
import socket
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from types import SimpleNamespace
from typing import Any, get_args

import httpx2
import numpy as np
import pytest
from PIL import Image
from pydantic.json_schema import models_json_schema

from memorymaze.agents.agent import Journal
from memorymaze.agents.navid import NavidAgent
from memorymaze.agents.navid.policy import Policy
from memorymaze.agents.navid.remote_policy import (
    LONGEST_ANSWER,
    VERSION,
    Acknowledgement,
    ActReply,
    ActRequest,
    CloseRequest,
    Failure,
    PolicyServer,
    RemotePolicy,
    ReplayedPolicy,
    ResetRequest,
    ServerInfo,
)
from memorymaze.errors import EpisodeOver, LanguageModelError, SettingsError
from memorymaze.language.answers import RecordingModel, ReplayingModel

EXAMPLE = Path(__file__).parents[3] / "examples" / "navid_server.py"
server = SimpleNamespace(**runpy.run_path(str(EXAMPLE)))

AHEAD = "The next action is move forward 75 cm."
INFO = {
    "protocol": "memorymaze-navid",
    "protocol_version": 1,
    "name": "odd",
    "more": "is allowed",
}

CUT = object()
"""An answer: the connection is closed without a word."""
HANG = object()
"""An answer: nothing, for longer than the client waits."""
DRIP = object()
"""An answer: a blank at a time, without end."""
DRIP_HEADERS = object()
"""An answer: a line of its head at a time, without end."""


class OddServer:
    """Serves `/info` well, and everything else with one answer."""

    def __init__(self, answer: Any, info: Any = INFO) -> None:
        self.messages: list[tuple[str, dict[str, Any] | None]] = []
        self.released = threading.Event()
        odd = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                self._answer(info)

            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["content-length"]))
                odd.messages.append((self.path, json.loads(body)))
                good = self.path != "/act"
                self._answer({"ok": True} if good else answer)

            def _answer(self, answer: Any) -> None:
                if answer is HANG:
                    odd.released.wait(5)
                if answer in (HANG, CUT):
                    self.connection.shutdown(socket.SHUT_RDWR)
                    return
                if answer is DRIP_HEADERS:
                    self.wfile.write(b"HTTP/1.1 200 OK\r\n")
                    with contextlib.suppress(OSError):
                        while not odd.released.wait(0.02):
                            self.wfile.write(b"x-more: to come\r\n")
                    return
                status, body = answer if isinstance(answer, tuple) else (200, answer)
                if not isinstance(body, bytes) and body is not DRIP:
                    body = json.dumps(body).encode()
                self.send_response(status)
                self.send_header("location", "/elsewhere")
                self.end_headers()
                with contextlib.suppress(OSError):
                    while body is DRIP and not odd.released.wait(0.02):
                        self.wfile.write(b" ")
                        self.wfile.flush()
                    if body is not DRIP:
                        self.wfile.write(body)

            def log_message(self, format: str, *arguments: Any) -> None:
                pass

        self.http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.http.server_address[1]}"


@pytest.fixture
def serve() -> Iterator[Callable[..., str]]:
    """Serve in the background; returns the address."""
    servers: list[Any] = []
    odd: list[OddServer] = []

    def start(what: Any, **options: Any) -> str:
        if hasattr(what, "act"):
            http = server.make_server(what)
        else:
            odd.append(OddServer(what, **options))
            http = odd[-1].http
        servers.append(http)
        thread = threading.Thread(target=http.serve_forever, args=(0.01,), daemon=True)
        thread.start()
        return f"http://127.0.0.1:{http.server_address[1]}"

    yield start
    for each in odd:
        each.released.set()
    for each in servers:
        each.shutdown()
        each.server_close()


def client(address: str, **options: Any) -> PolicyServer:
    return PolicyServer(
        address, **{"timeout": 5.0, "retries": 0, "first_delay": 0.0, **options}
    )


def follow(policy: Policy, robot: object) -> Journal:
    """Follow until the policy stops."""
    journal = Journal()
    with pytest.raises(EpisodeOver, match="agent"):
        NavidAgent(policy).follow(
            "Down the hall.",
            robot,  # type: ignore[arg-type]
            journal,
            np.random.default_rng(0),
        )
    return journal


class Watching(server.ScriptedPolicy):
    """The scripted policy; keeps what reaches it."""

    name = "watching"

    def __init__(self, *script: str) -> None:
        super().__init__(script)
        self.resets: list[dict[str, Any]] = []
        self.steps: list[int] = []
        self.pictures: list[bytes] = []
        self.asked = 0
        self.ended = 0

    def begin(self, instruction: str, reset: dict[str, Any]) -> Any:
        self.resets.append(reset)
        return super().begin(instruction, reset)

    def see(self, episode: Any, jpeg: bytes, step: int) -> None:
        self.steps.append(step)
        self.pictures.append(jpeg)

    def act(self, episode: Any, problem: str | None) -> Any:
        self.asked += 1
        return super().act(episode, problem)

    def end(self, episode: Any) -> None:
        self.ended += 1


def test_the_server_is_shown_the_whole_video_and_asked_when_the_queue_is_empty(
    serve, robot
):
    watching = Watching(AHEAD, "turn left 60 degrees", "stop")

    journal = follow(RemotePolicy(client(serve(watching))), robot)

    assert [call[0] for call in robot.calls] == ["forward"] * 3 + ["rotate"] * 2
    assert watching.steps == [0, 1, 2, 3, 4, 5]
    assert watching.asked == journal.model_calls == 3
    assert watching.ended == 1
    [reset] = watching.resets
    assert reset["instruction"] == "Down the hall."
    assert reset["camera"] == {
        "width": 640,
        "height": 480,
        "hfov_deg": 90.0,
        "height_m": 1.25,
    }
    assert reset["action_space"] == {"forward_m": 0.25, "turn_deg": 30, "max_repeat": 3}
    assert journal.notes[0]["model"] == "watching 1"
    assert journal.inference_s > 0


def test_pictures_arrive_in_rgb_order(serve, robot):
    red = np.zeros((480, 640, 3), np.uint8)
    red[:, :, 0] = 200
    robot.camera_picture = lambda *_: type("Red", (), {"rgb": red})
    watching = Watching("stop")

    follow(RemotePolicy(client(serve(watching))), robot)

    shown = Image.open(io.BytesIO(watching.pictures[0]))
    assert (shown.size, shown.mode) == ((640, 480), "RGB")
    assert np.abs(np.asarray(shown).astype(int) - red).max() < 8


def test_an_unreadable_answer_is_asked_for_again_without_a_second_picture(serve, robot):
    watching = Watching("Hm.", AHEAD, "stop")

    follow(RemotePolicy(client(serve(watching))), robot)

    assert watching.asked == 3
    assert watching.steps == [0, 1, 2, 3]


def test_a_policy_may_answer_motions_and_what_they_cost(serve, robot):
    class Acting(Watching):
        def act(self, episode: Any, problem: str | None) -> Any:
            return {
                "actions": [{"type": "right", "repeat": 2}, {"type": "stop"}],
                "usage": {"prompt_tokens": 700, "completion_tokens": 9},
            }

    journal = follow(RemotePolicy(client(serve(Acting("")))), robot)

    assert robot.calls == [("rotate", -30)] * 2
    assert (journal.model_calls, journal.tokens) == (1, 709)


def test_recorded_answers_replay_without_the_server(serve, robot, make_robot, tmp_path):
    store = tmp_path / "replies.sqlite"
    script = (AHEAD, "Hm.", "turn left 30 degrees", "stop")
    policy = RemotePolicy(
        client(serve(Watching(*script))), lambda line: RecordingModel(line, store)
    )
    recorded = follow(policy, robot)

    again = make_robot()
    replayed = follow(ReplayedPolicy(ReplayingModel(store)), again)

    assert again.calls == robot.calls
    assert replayed.notes == recorded.notes
    assert ReplayedPolicy(ReplayingModel(store)).name == "watching 1"


def test_a_server_sees_the_whole_video_where_first_answers_were_recorded_before(
    serve, make_robot, tmp_path
):
    store = tmp_path / "replies.sqlite"

    def recording(watching: Watching) -> RemotePolicy:
        return RemotePolicy(
            client(serve(watching)), lambda line: RecordingModel(line, store)
        )

    first = Watching(AHEAD, "stop")
    follow(recording(first), make_robot())
    second = Watching("never asked")
    follow(recording(second), make_robot())

    assert (first.asked, second.asked) == (2, 0)
    assert second.steps == first.steps == [0, 1, 2, 3]


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        pytest.param(CUT, "broke off", id="cut connection"),
        pytest.param(HANG, "did not answer within 0.3 s", id="silence"),
        pytest.param(DRIP, "did not answer within 0.3 s", id="endless drip"),
        pytest.param(DRIP_HEADERS, "did not answer within 0.3 s", id="endless head"),
        pytest.param(
            {"text": AHEAD, "usage": {"prompt_tokens": 10**30}},
            "'usage.prompt_tokens' is wrong",
            id="absurd tokens",
        ),
        pytest.param(b"<html>hello", "that is wrong .*<html>hello", id="no JSON"),
        pytest.param(b"\xff\xfe\x00", "that is wrong", id="no text"),
        pytest.param(b"", "that is wrong", id="empty"),
        pytest.param([1, 2], "that is wrong", id="list"),
        pytest.param({}, "neither text nor actions", id="nothing in it"),
        pytest.param({"text": "  "}, "neither text nor actions", id="blank text"),
        pytest.param({"text": 5}, "'text' is wrong", id="number for text"),
        pytest.param(
            {"actions": [{"type": "jump"}]}, "'actions.0.type' is wrong", id="jump"
        ),
        pytest.param(
            {"actions": [{"type": "left", "repeat": 0}]},
            "'actions.0.repeat' is wrong",
            id="no repeat",
        ),
        pytest.param(
            {"actions": [{"type": "left", "repeat": 4}]}, "at most 3", id="repeat 4"
        ),
        pytest.param(
            {"actions": [{"type": "left"}] * 9}, "'actions' is wrong", id="many actions"
        ),
        pytest.param(
            {"text": AHEAD, "usage": {"prompt_tokens": -1}},
            "'usage.prompt_tokens' is wrong",
            id="negative tokens",
        ),
        pytest.param(
            b'{"text": "' + b"x" * LONGEST_ANSWER, "more than 1,000,000", id="too long"
        ),
        pytest.param(b'{"text": "\\ud800"}', "that is wrong", id="half a character"),
        pytest.param(b"[" * 100_000, "that is wrong", id="nested"),
        pytest.param((500, {"error": "CUDA\nout"}), "500: CUDA out", id="500"),
        pytest.param((503, b"busy"), "503: 'busy'", id="503"),
        pytest.param((409, {"error": "no session"}), "409: no session", id="409"),
        pytest.param((302, {}), "answered 302", id="redirect"),
        pytest.param((204, b""), "answered 204", id="204"),
    ],
)
def test_a_bad_answer_is_one_clear_error(serve, robot, answer, said):
    policy = RemotePolicy(client(serve(answer), timeout=0.3))

    with pytest.raises(LanguageModelError, match=rf"^policy server .*{said}") as caught:
        NavidAgent(policy).follow("Go.", robot, Journal(), np.random.default_rng(0))

    assert "\n" not in str(caught.value)
    assert robot.calls == []


@pytest.mark.parametrize(
    ("info", "said"),
    [
        ({**INFO, "protocol_version": 2}, "speaks version 2 .* expected version 1"),
        ({**INFO, "protocol": "chess"}, "'protocol' is wrong"),
        ({**INFO, "name": ""}, "'name' is wrong"),
        ({**INFO, "name": "two\nlines"}, "'name' is wrong"),
        ({"protocol": "memorymaze-navid"}, "'protocol_version' is wrong"),
    ],
)
def test_another_protocol_is_refused_before_any_episode(serve, info, said):
    with pytest.raises(LanguageModelError, match=said):
        RemotePolicy(client(serve({}, info=info)))


def test_nobody_there_is_said():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"http://127.0.0.1:{free.getsockname()[1]}"
    with pytest.raises(LanguageModelError, match=r"cannot be reached: .*is it running"):
        RemotePolicy(client(address))


@pytest.mark.parametrize(
    "address", ["localhost:8765", "ftp://x", "http://", "http://x:y", "http://x?y", ""]
)
def test_an_address_that_is_none_is_a_wrong_setting(address):
    with pytest.raises(SettingsError, match=r"--set server: expected an address"):
        PolicyServer(address)


def test_what_may_pass_is_tried_again_and_no_picture_counts_twice(serve, robot):
    class Shaky(Watching):
        failures = 2

        def act(self, episode: Any, problem: str | None) -> Any:
            if self.failures:
                self.failures -= 1
                raise RuntimeError("out of memory")
            return super().act(episode, problem)

    shaky = Shaky(AHEAD, "stop")
    with contextlib.redirect_stderr(io.StringIO()) as told:
        follow(RemotePolicy(client(serve(shaky), retries=2)), robot)

    assert shaky.steps == [0, 1, 2, 3]
    assert told.getvalue().count("RuntimeError: out of memory") == 2


def test_the_documented_schema_is_that_of_the_messages():
    messages = (
        ServerInfo,
        ResetRequest,
        ActRequest,
        ActReply,
        CloseRequest,
        Acknowledgement,
        Failure,
    )
    _, schema = models_json_schema(
        [(message, "validation") for message in messages],
        title=f"memorymaze-navid, version {VERSION}",
    )
    page = Path(__file__).parents[3] / "docs" / "navid_protocol.schema.json"
    draft = "https://json-schema.org/draft/2020-12/schema"
    assert json.loads(page.read_text(encoding="utf-8")) == {"$schema": draft, **schema}


def test_the_reference_server_answers_by_the_schema(serve):
    address = serve(Watching(AHEAD))

    ServerInfo.model_validate_json(httpx2.get(f"{address}/info").content)
    assert server.PROTOCOL_VERSION == VERSION
    assert server.PROTOCOL in get_args(ServerInfo.model_fields["protocol"].annotation)
