"""A reference server of the NaVid protocol, with a scripted policy.

    python examples/navid_server.py --port 8765

It is one file that needs nothing but Python 3.8 or newer: copy it to the machine that has
the weights, write a policy (see `docs/navid.md`), and start it there with

    python navid_server.py --policy my_navid.py:MyPolicy --host 0.0.0.0
"""

from __future__ import annotations

import argparse
import base64
import binascii
import importlib.util
import json
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

PROTOCOL = "memorymaze-navid"
PROTOCOL_VERSION = 1
LONGEST_REQUEST = 8_000_000
"""Bytes of a message; a picture has about a hundred thousand."""
MOST_SESSIONS = 64
"""Episodes kept open; the one that was silent the longest makes room."""

SCRIPT = ("The next action is move forward 75 cm.",)


class ScriptedPolicy:
    """Says the sentences of a script in turn, the last one again and again."""

    name = "scripted policy"
    version = "1"
    deterministic = True

    def __init__(self, script: tuple[str, ...] = SCRIPT) -> None:
        """Keep the script."""
        self.script = script

    def begin(self, instruction: str, reset: dict[str, Any]) -> Any:
        """Begin an episode; return what the other methods get as `episode`.

        Args:
            instruction: Text of the way.
            reset: The whole message, with camera, action space and seed.
        """
        return {"asked": 0}

    def see(self, episode: Any, jpeg: bytes, step: int) -> None:
        """Add a picture to the video; called once per step, in order.

        Args:
            episode: From `begin`.
            jpeg: The file's bytes; 640x480, RGB when decoded with Pillow.
            step: Motions done before it.
        """

    def act(self, episode: Any, problem: str | None) -> str | dict[str, Any]:
        """Say the next motion for the picture seen last.

        Args:
            episode: From `begin`.
            problem: Why the answer just before could not be used, or None.

        Returns:
            The model's words; or a whole reply with `text`, `actions`, `usage`.
        """
        number = min(episode["asked"], len(self.script) - 1)
        episode["asked"] += 1
        return self.script[number]

    def end(self, episode: Any) -> None:
        """Forget an episode."""


class Refusal(Exception):
    """A message that cannot be served; carries the HTTP status."""

    def __init__(self, status: int, reason: str) -> None:
        """Keep both."""
        super().__init__(reason)
        self.status = status


class _Session:
    def __init__(self, episode: Any) -> None:
        self.episode = episode
        self.shown = -1
        self.used = time.monotonic()


class Sessions:
    """The open episodes of a policy; one message is served at a time."""

    def __init__(self, policy: Any) -> None:
        """Serve a policy: anything with the methods of `ScriptedPolicy`."""
        self.policy = policy
        self._open: dict[str, _Session] = {}
        self._lock = threading.Lock()

    def answer(self, path: str, message: dict[str, Any] | None) -> dict[str, Any]:
        """Answer a message.

        Raises:
            Refusal: It is not one of the protocol's.
        """
        routes = {"/reset": self._reset, "/act": self._act, "/close": self._close}
        if message is None and path == "/info":
            return self._info()
        if message is None or path not in routes:
            raise Refusal(404, "expected GET /info or POST /reset, /act, /close")
        # A model is on one device: what comes at the same time waits here.
        with self._lock:
            return routes[path](message)

    def _info(self) -> dict[str, Any]:
        return {
            "protocol": PROTOCOL,
            "protocol_version": PROTOCOL_VERSION,
            "name": self.policy.name,
            "version": getattr(self.policy, "version", ""),
            "deterministic": getattr(self.policy, "deterministic", False),
        }

    def _reset(self, message: dict[str, Any]) -> dict[str, Any]:
        version = _field(message, "protocol_version", int)
        if version != PROTOCOL_VERSION:
            raise Refusal(
                400, f"expected protocol version {PROTOCOL_VERSION}, got {version}"
            )
        name = _field(message, "session", str)
        instruction = _field(message, "instruction", str)
        self._drop(name)
        if len(self._open) >= MOST_SESSIONS:
            self._drop(min(self._open, key=lambda each: self._open[each].used))
        self._open[name] = _Session(self.policy.begin(instruction, message))
        return {"ok": True}

    def _act(self, message: dict[str, Any]) -> dict[str, Any]:
        name = _field(message, "session", str)
        session = self._open.get(name)
        if session is None:
            raise Refusal(409, f"there is no session {name!r}; send /reset first")
        session.used = time.monotonic()
        step = _field(message, "step", int)
        if step < session.shown:
            raise Refusal(
                409, f"expected a step of at least {session.shown}, got {step}"
            )
        if step > session.shown:
            self.policy.see(session.episode, _picture(message), step)
            session.shown = step
        if message.get("observe_only"):
            return {"ok": True}
        began = time.monotonic()
        said = self.policy.act(session.episode, message.get("problem"))
        reply: dict[str, Any] = {"text": said} if isinstance(said, str) else dict(said)
        reply.setdefault("latency_ms", 1000 * (time.monotonic() - began))
        return reply

    def _close(self, message: dict[str, Any]) -> dict[str, Any]:
        self._drop(_field(message, "session", str))
        return {"ok": True}

    def _drop(self, name: str) -> None:
        session = self._open.pop(name, None)
        if session is not None:
            self.policy.end(session.episode)


def _field(message: dict[str, Any], name: str, kind: type) -> Any:
    value = message.get(name)
    if type(value) is not kind:
        raise Refusal(400, f"expected {name!r} to be a {kind.__name__}, got {value!r}")
    return value


def _picture(message: dict[str, Any]) -> bytes:
    try:
        data = base64.b64decode(_field(message, "image_jpeg_b64", str), validate=True)
    except binascii.Error:
        data = b""
    if not data.startswith(b"\xff\xd8\xff"):
        raise Refusal(400, "expected 'image_jpeg_b64' to be a JPEG file in base64")
    return data


def make_server(policy: Any, host: str = "127.0.0.1", port: int = 0) -> Any:
    """Return an HTTP server for a policy; call its `serve_forever`.

    Args:
        policy: Anything with the methods of `ScriptedPolicy`.
        host: Address to listen at; 0.0.0.0 for all of the machine's.
        port: 0 for any that is free; `server_address[1]` tells.
    """
    sessions = Sessions(policy)

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"
        timeout = 600

        def do_GET(self) -> None:
            self._serve(None)

        def do_POST(self) -> None:
            try:
                length = int(self.headers.get("content-length", ""))
            except ValueError:
                length = -1
            if not 0 <= length <= LONGEST_REQUEST:
                self.close_connection = True
                self._send(413, {"error": f"expected 0 to {LONGEST_REQUEST} bytes"})
                return
            try:
                message = json.loads(self.rfile.read(length))
            except (ValueError, RecursionError):
                message = None
            if not isinstance(message, dict):
                self._send(400, {"error": "expected a JSON object"})
                return
            self._serve(message)

        def _serve(self, message: dict[str, Any] | None) -> None:
            try:
                self._send(200, sessions.answer(self.path, message))
            except Refusal as refusal:
                self._send(refusal.status, {"error": str(refusal)})
            except Exception as failure:
                traceback.print_exc()
                self._send(500, {"error": f"{type(failure).__name__}: {failure}"})

        def _send(self, status: int, answer: dict[str, Any]) -> None:
            body = json.dumps(answer).encode()
            self.send_response(status)
            self.send_header("content-type", "application/json")
            self.send_header("content-length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *arguments: Any) -> None:
            """Say nothing: there is a message for every step of every episode."""

    server = ThreadingHTTPServer((host, port), Handler)
    server.daemon_threads = True
    return server


def _maker(options: argparse.Namespace) -> Callable[[], Any]:
    """Return what makes the policy."""
    if options.policy is None:
        script = SCRIPT
        if options.script is not None:
            with open(options.script, encoding="utf-8") as file:
                script = tuple(line.strip() for line in file if line.strip())
            if not script:
                raise ValueError(f"--script: {options.script} has no lines")
        return lambda: ScriptedPolicy(script)
    path, _, name = options.policy.rpartition(":")
    if not (path.endswith(".py") and os.path.isfile(path)):
        raise ValueError(
            f"--policy: expected FILE.py:CLASS of a file that is there, got "
            f"{options.policy!r}"
        )
    # What lies beside it can be imported too.
    sys.path.insert(0, os.path.dirname(os.path.abspath(path)))
    spec = importlib.util.spec_from_file_location("policy_of_ones_own", path)
    if spec is None or spec.loader is None:
        raise ValueError(f"--policy: {path!r} cannot be imported")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    if not hasattr(module, name):
        raise ValueError(f"--policy: {path} has no class {name!r}")
    return getattr(module, name)


def main() -> None:
    """Serve until interrupted."""
    parser = argparse.ArgumentParser(
        description="Serve a policy of the NaVid protocol."
    )
    parser.add_argument("--host", default="127.0.0.1", help="default: 127.0.0.1")
    parser.add_argument("--port", type=int, default=8765, help="default: 8765")
    parser.add_argument(
        "--policy", metavar="FILE.py:CLASS", help="your own (default: a scripted one)"
    )
    parser.add_argument(
        "--script", metavar="FILE", help="what the scripted policy says, line by line"
    )
    options = parser.parse_args()
    try:
        make = _maker(options)
    except (OSError, ValueError) as error:
        parser.error(str(error))
    policy = make()
    try:
        server = make_server(policy, options.host, options.port)
    except (OSError, OverflowError) as error:
        parser.error(f"cannot listen at {options.host}:{options.port} ({error})")
    host, port = server.server_address[:2]
    print(f"{policy.name} at http://{host}:{port}", file=sys.stderr, flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        server.server_close()


if __name__ == "__main__":
    main()
