"""A detector behind a server, and servers that are down, slow or talk nonsense."""

import base64
import contextlib
import io
import json
import sys
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer, ThreadingHTTPServer
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from memorymaze.basics.errors import DetectorError, SettingsError
from memorymaze.basics.own_code import find_own
from memorymaze.robot.perception.eyes import Eyes, parse_detector
from memorymaze.robot.perception.grounding_dino import ZeroShotFinder
from memorymaze.robot.perception.picture_detector import FoundBox
from memorymaze.testing import check_object_finder

EXAMPLES = Path(__file__).parents[2] / "examples"
REMOTE = f"{EXAMPLES / 'remote_finder.py'}:RemoteFinder"
RemoteFinder = find_own("detector", REMOTE)
server = sys.modules[
    find_own("server", f"{EXAMPLES / 'detector_server.py'}:main").__module__
]

RGB = np.random.default_rng(1).integers(0, 255, (480, 640, 3), dtype=np.uint8)
GOOD = {"boxes": [[1, 2, 30, 40]], "labels": ["door"], "scores": [0.9]}
HEAD = b"HTTP/1.1 200 OK\r\n"
DRIPS = {
    "drips its head": (HEAD, b"x-more: to come\r\n"),
    "drips its body": (HEAD + b"\r\n", b" "),
}
"""What a server sends first, and then every now and then without end."""


@contextlib.contextmanager
def serving(server: HTTPServer) -> Iterator[str]:
    """Let a server answer; yields its address."""
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))
    thread.start()
    try:
        host, port = server.server_address[:2]
        yield f"http://{host}:{port}/detect"
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


def scripted(*answers, asked: list | None = None) -> HTTPServer:
    """Return a server that gives these answers in turn: JSON, bytes or a status.

    A finder that is made is answered well.
    """
    left = [GOOD, *answers]

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"]))
            if asked is not None:
                asked.append(json.loads(body))
            answer = left.pop(0) if len(left) > 1 else left[0]
            if answer == "close":
                self.close_connection = True
                return
            if answer == "hang":
                released.wait(10)
                return
            if str(answer) in DRIPS:
                start, drop = DRIPS[answer]
                self.wfile.write(start)
                with contextlib.suppress(OSError):
                    while not released.wait(0.02):
                        self.wfile.write(drop)
                return
            status, content = answer if isinstance(answer, tuple) else (200, answer)
            data = (
                content if isinstance(content, bytes) else json.dumps(content).encode()
            )
            self.send_response(status)
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        def log_message(self, format: str, *args: object) -> None:
            """Keep quiet."""

    released = threading.Event()
    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.released = released
    return server


def client(url: str, **changes):
    given = {"first_delay": 0.0, "timeout": 5.0, **changes}
    return RemoteFinder(RemoteFinder.Options(url, **given))


def test_a_picture_is_sent_as_documented_and_boxes_come_back():
    asked: list = []
    with serving(scripted(GOOD, asked=asked)) as url:
        found = client(url, box_threshold=0.4, text_threshold=0.3).find(RGB, "red door")

    assert found == [FoundBox((1, 2, 30, 40), "door", 0.9)]
    _, request = asked
    assert set(request) == {"image", "query", "box_threshold", "text_threshold"}
    assert (request["query"], request["box_threshold"]) == ("red door", 0.4)
    with Image.open(io.BytesIO(base64.b64decode(request["image"]))) as image:
        assert np.array_equal(np.asarray(image), RGB)


def test_boxes_below_the_threshold_are_dropped_here_too():
    answer = {"boxes": [[0, 0, 9, 9]] * 2, "labels": ["a", "b"], "scores": [0.2, 0.5]}
    with serving(scripted(answer)) as url:
        assert [each.label for each in client(url).find(RGB, "door")] == ["b"]


@pytest.mark.parametrize("fault", ["close", (503, "busy"), (500, b"")])
def test_a_fault_that_passes_is_tried_again(fault):
    with serving(scripted(fault, fault, GOOD)) as url:
        assert len(client(url).find(RGB, "door")) == 1


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        pytest.param(b"<html>", "no list of detections", id="no JSON"),
        pytest.param([], "no list of detections", id="a list"),
        pytest.param({"boxes": []}, "labels: Field required", id="a part missing"),
        pytest.param(
            {**GOOD, "labels": []}, "as many boxes as labels", id="too few labels"
        ),
        pytest.param({**GOOD, "scores": [3]}, "scores.0", id="a score above 1"),
        pytest.param(
            {**GOOD, "boxes": [[9, 2, 3, 4]]}, "no list.*left, top", id="box turned"
        ),
        pytest.param({**GOOD, "boxes": [[1, 2, 3]]}, "boxes.0", id="box of three"),
        pytest.param(
            b'{"boxes": [[1, 2, NaN, 4]], "labels": ["a"], "scores": [1]}',
            "no list of detections",
            id="no number",
        ),
        pytest.param((404, b"no such page"), "answered 404: no such page", id="404"),
        pytest.param((503, b"busy"), "answered 503: busy, 3 times in a row", id="503"),
        pytest.param("close", "broke off", id="hangs up"),
        pytest.param(b" " * 4_000_001, "more than 4,000,000 bytes", id="endless"),
    ],
)
def test_an_answer_that_cannot_be_used_is_said_to_be_so(answer, said: str):
    with serving(scripted(answer)) as url, pytest.raises(DetectorError, match=said):
        client(url).find(RGB, "door")


@pytest.mark.parametrize("answer", ["hang", *DRIPS])
def test_a_server_that_does_not_answer_is_not_waited_for_for_ever(answer: str):
    server = scripted(answer)
    with serving(server) as url:
        try:
            with pytest.raises(DetectorError, match=r"did not answer within 0.1 s"):
                client(url, timeout=0.1, retries=0).find(RGB, "door")
        finally:
            server.released.set()


def test_a_server_that_is_not_there_is_found_out_before_the_run():
    with serving(scripted(GOOD)) as url:
        client(url)
    eyes = Eyes(parse_detector(f"{REMOTE},url={url},first_delay=0"))
    with pytest.raises(SettingsError, match=r"cannot be made.*is it running"):
        eyes.check()


@pytest.mark.parametrize("url", ["detector", "file:///etc/passwd"])
def test_what_is_no_address_is_refused(url: str):
    with pytest.raises(DetectorError, match="cannot be asked"):
        client(url)


def test_it_keeps_the_contract_of_finders():
    with serving(scripted(GOOD)) as url:
        check_object_finder(client(url), RGB)


@pytest.mark.proof
def test_the_reference_server_gives_what_the_model_finds(grounding_dino: Path):
    local = ZeroShotFinder(str(grounding_dino), box_threshold=0.1)
    listening = server.make_server(("127.0.0.1", 0), local.with_thresholds)
    with serving(listening) as url:
        remote = client(url, box_threshold=0.1).find(RGB, "red chair")

    assert remote == local.find(RGB, "red chair") != []


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"image": "!"}, "image: expected a PNG or JPEG in base64"),
        ({"image": base64.b64encode(b"GIF89a").decode()}, "image: expected a PNG"),
        ({"box_threshold": 2}, "box_threshold"),
        ({"query": None}, "query"),
    ],
)
def test_the_reference_server_says_what_is_wrong_with_a_request(change, said: str):
    import urllib.error
    import urllib.request

    listening = server.make_server(("127.0.0.1", 0), lambda *_: None)
    body = json.dumps({"image": "", "query": "door", **change}).encode()
    with serving(listening) as url:
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(url, body, timeout=5)
        with refused.value as error:
            assert error.code == 400
            assert said in error.read().decode()


def test_the_reference_server_does_not_start_without_a_model(tmp_path: Path, capsys):
    assert server.main([str(tmp_path / "none"), "--port", "0"]) == 2
    assert "no such folder" in capsys.readouterr().err
