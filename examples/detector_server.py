"""A server for `remote_finder.py` beside it, with any zero-shot detection checkpoint.

    python examples/detector_server.py CHECKPOINT --port 8000

It answers POST requests to any path, one at a time, as `remote_finder.py` says.
Needs the extra `detector`. It has no log-in: let it listen where only you can reach it.
"""

import argparse
import base64
import binascii
import io
import sys
from collections.abc import Callable, Sequence
from http.server import BaseHTTPRequestHandler, HTTPServer

import numpy as np
from PIL import Image, UnidentifiedImageError
from pydantic import ValidationError
from remote_finder import DetectionReply, DetectionRequest

from memorymaze.basics.errors import DetectorError, SettingsError
from memorymaze.robot.perception.grounding_dino import (
    DEFAULT_CHECKPOINT,
    ZeroShotFinder,
)
from memorymaze.robot.perception.picture_detector import ObjectFinder

FinderFor = Callable[[float, float], ObjectFinder]
"""Gives the model for a box threshold and a text threshold."""

LARGEST_REQUEST = 50_000_000
"""Bytes."""


def make_server(address: tuple[str, int], finder_for: FinderFor) -> HTTPServer:
    """Return a server that listens and answers when `serve_forever` is called.

    Args:
        address: Host and port; port 0 takes any that is free.
        finder_for: Gives the model.
    """

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            try:
                status, body = 200, self._answer().model_dump_json()
            except ValueError as error:
                status, body = 400, str(error)
            except DetectorError as error:
                status, body = 500, str(error)
            data = body.encode()
            kind = "application/json" if status == 200 else "text/plain"
            self.send_response(status)
            self.send_header("Content-Type", f"{kind}; charset=utf-8")
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        def _answer(self) -> DetectionReply:
            length = int(self.headers.get("Content-Length") or 0)
            if not 0 < length <= LARGEST_REQUEST:
                raise ValueError(
                    f"expected a body of 1 to {LARGEST_REQUEST} bytes, got {length}"
                )
            try:
                asked = DetectionRequest.model_validate_json(self.rfile.read(length))
            except ValidationError as error:
                first = error.errors()[0]
                where = ".".join(map(str, first["loc"])) or "the request"
                raise ValueError(f"{where}: {first['msg']}") from None
            picture = _picture(asked.image)
            finder = finder_for(asked.box_threshold, asked.text_threshold)
            found = finder.find(picture, asked.query)
            return DetectionReply(
                boxes=[each.box for each in found],
                labels=[each.label for each in found],
                scores=[each.score for each in found],
            )

        def log_message(self, format: str, *args: object) -> None:
            """Keep quiet: a run asks thousands of times."""

    return HTTPServer(address, Handler)


def _picture(text: str) -> "np.ndarray[tuple[int, int, int], np.dtype[np.uint8]]":
    try:
        file = io.BytesIO(base64.b64decode(text, validate=True))
        with Image.open(file, formats=("PNG", "JPEG")) as image:
            return np.asarray(image.convert("RGB"))
    except (binascii.Error, UnidentifiedImageError, OSError) as error:
        raise ValueError(f"image: expected a PNG or JPEG in base64 ({error})") from None


def main(arguments: Sequence[str] | None = None) -> int:
    """Serve a checkpoint until it is interrupted.

    Args:
        arguments: Of the command line; None for those of this process.

    Returns:
        0, or 2 where the checkpoint or the address cannot be used.
    """
    parser = argparse.ArgumentParser(
        prog="python examples/detector_server.py",
        description="Serve a zero-shot object detection checkpoint over HTTP.",
    )
    parser.add_argument(
        "checkpoint",
        nargs="?",
        default=DEFAULT_CHECKPOINT,
        help=f"folder, or name in the Hugging Face cache (default: {DEFAULT_CHECKPOINT})",
    )
    parser.add_argument("--host", default="127.0.0.1", help="default: 127.0.0.1")
    parser.add_argument("--port", type=int, default=8000, help="default: 8000")
    parser.add_argument("--device", default="auto", help="cpu, cuda, … (default: auto)")
    parser.add_argument(
        "--download", action="store_true", help="fetch it where it is not there"
    )
    options = parser.parse_args(arguments)
    finder = ZeroShotFinder(
        options.checkpoint, device=options.device, download=options.download
    )
    try:
        finder.check()
        server = make_server((options.host, options.port), finder.with_thresholds)
    except (SettingsError, OSError, OverflowError) as error:
        print(f"detector_server: {error}", file=sys.stderr)
        return 2
    host, port = server.server_address[:2]
    print(f"serving {options.checkpoint} at http://{host!s}:{port}/", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        return 0
    finally:
        server.server_close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
