"""The released NaVid checkpoint behind the protocol that `--agent navid` speaks.

    python navid_server.py CHECKPOINT --port 8000

One file for the machine that has the weights: copy it into the folder of the release
(github.com/jzhzhang/NaVid-VLN-CE), beside its `navid_agent.py`, and start it in the
release's environment (Python 3.8 or newer). It answers `POST /v1/chat/completions`, so
that the checkpoint is asked, recorded and replayed like any other model:

    memorymaze evaluate --agent navid --model navid-7b --base-url http://gpu:8000/v1 \
        --set history=2000 --set faithful=true --set budget=released --limit 12

For want of the weights, `Checkpoint` was never run here; the rest is tested with a
stand-in.
"""

from __future__ import annotations

import argparse
import base64
import io
import json
import re
import tempfile
import threading
import traceback
import zlib
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

LONGEST_REQUEST = 200_000_000
"""Bytes; a video of two thousand small pictures has about forty million."""
INSTRUCTION = re.compile(r'^"""\n(.*?)\n"""$', re.DOTALL | re.MULTILINE)


class Checkpoint:
    """The released model, asked as the release's own evaluation asks it."""

    def __init__(self, path: str) -> None:
        """Load the weights; about 20 GB of GPU memory."""
        from navid_agent import NaVid_Agent  # type: ignore[import-not-found]

        self._agent = NaVid_Agent(path, tempfile.mkdtemp(), require_map=False)

    def __call__(self, instruction: str, pictures: list[bytes], seed: int) -> str:
        """Return the model's words, unchanged."""
        import numpy as np
        import torch
        from PIL import Image

        # RGB, as in training; all of one size, since the release stacks them.
        video = [Image.open(io.BytesIO(each)).convert("RGB") for each in pictures]
        agent, size = self._agent, video[0].size
        agent.reset()
        agent.rgb_list = [np.asarray(each.resize(size)) for each in video]
        torch.manual_seed(seed)  # the release draws its words at temperature 0.2
        return agent.predict_inference(agent.promt_template.format(instruction))


def question_of(request: Any) -> tuple[str, list[bytes], int]:
    """Return the instruction, the video as picture files, and a seed, of a request.

    Raises:
        ValueError: It is none of `--agent navid` with pictures.
    """
    try:
        text, *shown = request["messages"][-1]["content"]
        asked: str = text["text"]
        urls = [each["image_url"]["url"] for each in shown]
        pictures = [base64.b64decode(url.partition("base64,")[2]) for url in urls]
    except (AttributeError, KeyError, IndexError, TypeError, ValueError):
        asked, pictures = "", []
    instruction = INSTRUCTION.search(asked)
    if not pictures or instruction is None:
        raise ValueError(
            "expected a last message of a text with the instruction between lines of "
            'three quotation marks, and pictures as "data:image/jpeg;base64,..."'
        )
    # Of the whole text: a question that is put once more may get another answer.
    return instruction[1], pictures, zlib.crc32(asked.encode())


def completion_of(reply: str) -> dict[str, Any]:
    """Return a chat completion with the model's words."""
    message = {"role": "assistant", "content": reply}
    choice = {"index": 0, "finish_reason": "stop", "message": message}
    told = {"id": "navid", "object": "chat.completion", "created": 0}
    return {**told, "model": "navid", "choices": [choice]}


def make_server(
    model: Callable[[str, list[bytes], int], str],
    host: str = "127.0.0.1",
    port: int = 0,
) -> Any:
    """Return an HTTP server for what says the next motion; call its `serve_forever`."""
    on_the_device = threading.Lock()

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"
        timeout = 600

        def do_POST(self) -> None:
            length = int(self.headers.get("content-length") or -1)
            if not 0 <= length <= LONGEST_REQUEST:
                self.close_connection = True
                return self._send(413, f"expected at most {LONGEST_REQUEST} bytes")
            body = self.rfile.read(length)
            if self.path != "/v1/chat/completions":
                return self._send(404, "expected POST /v1/chat/completions")
            try:
                question = question_of(json.loads(body))
            except ValueError as error:
                return self._send(400, str(error))
            try:
                with on_the_device:
                    return self._send(200, completion_of(model(*question)))
            except Exception as error:
                traceback.print_exc()
                return self._send(500, f"{type(error).__name__}: {error}")

        def _send(self, status: int, what: str | dict[str, Any]) -> None:
            said = {"error": {"message": what}} if isinstance(what, str) else what
            body = json.dumps(said).encode()
            self.send_response(status)
            self.send_header("content-type", "application/json")
            self.send_header("content-length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *arguments: Any) -> None:
            """Say nothing: there is a request for every motion of every episode."""

    server = ThreadingHTTPServer((host, port), Handler)
    server.daemon_threads = True
    return server


def main() -> None:
    """Serve until interrupted."""
    parser = argparse.ArgumentParser(description="Serve the released NaVid checkpoint.")
    parser.add_argument("checkpoint", help="folder of the weights")
    parser.add_argument("--host", default="127.0.0.1", help="default: 127.0.0.1")
    parser.add_argument("--port", type=int, default=8000, help="default: 8000")
    options = parser.parse_args()
    server = make_server(Checkpoint(options.checkpoint), options.host, options.port)
    print(f"serving at http://{options.host}:{options.port}/v1", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        server.server_close()


if __name__ == "__main__":
    main()
