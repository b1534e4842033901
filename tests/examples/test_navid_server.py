"""The example server of the NaVid protocol, with its scripted policy."""

import ast
import base64
import importlib.util
import json
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "navid_server.py"


@pytest.fixture(scope="module")
def server() -> Any:
    """The example, as a module."""
    spec = importlib.util.spec_from_file_location("navid_server", EXAMPLE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def address(server: Any) -> Iterator[str]:
    """Where the scripted policy is served."""
    http = server.make_server(server.ScriptedPolicy(("stop",)))
    threading.Thread(target=http.serve_forever, args=(0.01,), daemon=True).start()
    yield f"http://127.0.0.1:{http.server_address[1]}"
    http.shutdown()
    http.server_close()


@pytest.mark.parametrize(
    ("path", "message", "status", "said"),
    [
        ("/act", {"session": "x", "step": 0}, 409, "no session 'x'; send /reset"),
        ("/act", {"step": 0}, 400, "'session' to be a str"),
        ("/reset", {"protocol_version": 7}, 400, "version 1, got 7"),
        ("/elsewhere", {}, 404, "POST /reset"),
    ],
)
def test_the_server_says_what_it_expects(address, path, message, status, said):
    answer = httpx2.post(address + path, json=message)

    assert answer.status_code == status
    assert said in answer.json()["error"]


def test_the_server_refuses_what_is_no_message(address):
    reset = {"protocol_version": 1, "session": "a", "instruction": "Go."}
    assert httpx2.post(f"{address}/reset", json=reset).json() == {"ok": True}
    shown = {
        "session": "a",
        "step": 0,
        "image_jpeg_b64": base64.b64encode(b"no").decode(),
    }

    for body, said in (
        (b"{", "expected a JSON object"),
        (b"[]", "expected a JSON object"),
        (json.dumps(shown).encode(), "JPEG"),
    ):
        answer = httpx2.post(f"{address}/act", content=body)
        assert answer.status_code == 400
        assert said in answer.json()["error"]


def test_forgotten_sessions_make_room(server, monkeypatch):
    ended: list[Any] = []

    class Watching(server.ScriptedPolicy):
        def end(self, episode: Any) -> None:
            ended.append(episode)

    monkeypatch.setattr(server, "MOST_SESSIONS", 2)
    sessions = server.Sessions(Watching(("stop",)))
    for name in "abc":
        sessions.answer(
            "/reset", {"protocol_version": 1, "session": name, "instruction": "Go."}
        )
    assert len(ended) == 1


def test_the_server_is_one_file_for_python_3_8():
    tree = ast.parse(EXAMPLE.read_text(encoding="utf-8"), feature_version=(3, 8))

    imported = {
        name.split(".")[0]
        for node in ast.walk(tree)
        for name in (
            [alias.name for alias in node.names]
            if isinstance(node, ast.Import)
            else [node.module or ""]
            if isinstance(node, ast.ImportFrom)
            else []
        )
    }
    assert imported <= sys.stdlib_module_names


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--policy", "nothing.py:Policy"], "of a file that is there"),
        (["--policy", "{file}:Policy"], "has no class 'Policy'"),
        (["--script", "nothing.txt"], "No such file"),
        (["--script", "{file}"], "has no lines"),
        (["--port", "many"], "invalid int value"),
    ],
)
def test_the_server_explains_wrong_usage(
    server, tmp_path, capsys, monkeypatch, arguments, said
):
    file = tmp_path / "empty.py"
    file.touch()
    monkeypatch.setattr(sys, "path", [*sys.path])
    filled = [each.format(file=file) for each in arguments]
    monkeypatch.setattr(sys, "argv", ["server.py", *filled])

    with pytest.raises(SystemExit) as left:
        server.main()

    assert left.value.code == 2
    assert said in capsys.readouterr().err
