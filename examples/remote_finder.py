"""A finder of objects of one's own: a model that another machine serves over HTTP.

    python examples/detector_server.py CHECKPOINT --port 8000
    memorymaze evaluate --agent guide --limit 6 \
        --with detector=examples/remote_finder.py:RemoteFinder,url=http://localhost:8000/

It posts one JSON message a look, `DetectionRequest`, and gets `DetectionReply`. Whatever
else your server speaks is changed in `find`; docs/seeing.md says what a finder must do.
"""

import base64
import io
import time
from dataclasses import dataclass
from typing import Annotated

import httpx2
import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from memorymaze.basics.errors import DetectorError
from memorymaze.basics.options import check_number, check_whole
from memorymaze.basics.server_calls import one_line, within
from memorymaze.robot.perception import FoundBox

LONGEST_REPLY = 4_000_000
"""Bytes."""
WORTH_ANOTHER_TRY = frozenset({408, 425, 429, 500, 502, 503, 504})
"""States of servers that may soon be another."""

Number = Annotated[float, Field(allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]


class DetectionRequest(BaseModel):
    """What is sent: a picture, what to look for, and thresholds."""

    model_config = ConfigDict(extra="forbid")

    image: str
    """The picture's file in base64; PNG is sent, servers should take JPEG too."""
    query: str
    """What to look for, in a few words."""
    box_threshold: Share = 0.35
    """Least score of a box."""
    text_threshold: Share = 0.25
    """Least score of a word to be part of the label."""


class DetectionReply(BaseModel):
    """What comes back with status 200: three lists of the same length."""

    boxes: list[tuple[Number, Number, Number, Number]]
    """Pixels (left, top, right, bottom) of the picture sent."""
    labels: list[str]
    """What the model calls each."""
    scores: list[Share]
    """How sure it is of each, 0 to 1."""

    @model_validator(mode="after")
    def _check(self) -> "DetectionReply":
        if not len(self.boxes) == len(self.labels) == len(self.scores):
            raise ValueError(
                "expected as many boxes as labels and scores, got "
                f"{len(self.boxes)}, {len(self.labels)} and {len(self.scores)}"
            )
        return self


@dataclass(frozen=True, slots=True)
class RemoteOptions:
    """What can be set."""

    url: str = "http://localhost:8000/"
    """address that requests are posted to"""
    box_threshold: float = 0.35
    """least score of a box; sent along, and boxes below it are dropped here too"""
    text_threshold: float = 0.25
    """least score of a word to be part of a label; sent along"""
    timeout: float = 60.0
    """seconds for a whole reply to come"""
    retries: int = 2
    """attempts after the first, where a server is busy, down or slow"""
    first_delay: float = 1.0
    """seconds before the second attempt; twice as many before each further one"""

    def __post_init__(self) -> None:
        """Check every number."""
        for name in ("box_threshold", "text_threshold"):
            check_number(name, getattr(self, name), 0, 1)
        check_number("timeout", self.timeout, above=0)
        check_whole("retries", self.retries, least=0)
        check_number("first_delay", self.first_delay, 0)


class RemoteFinder:
    """Asks a server what is in a picture; implements `ObjectFinder`."""

    Options = RemoteOptions

    def __init__(self, options: RemoteOptions) -> None:
        """Send a small grey picture, to find out early what is wrong."""
        self.options = options
        self.find(np.full((48, 64, 3), 128, dtype=np.uint8), "door")

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        """Return what the server finds."""
        file = io.BytesIO()
        Image.fromarray(rgb).save(file, "PNG", compress_level=1)
        request = DetectionRequest(
            image=base64.b64encode(file.getvalue()).decode("ascii"),
            # Words may hold halves of characters, which are no UTF-8.
            query=query.encode("utf-8", "replace").decode("utf-8"),
            box_threshold=self.options.box_threshold,
            text_threshold=self.options.text_threshold,
        )
        answer = self._answer(request.model_dump_json())
        try:
            reply = DetectionReply.model_validate_json(answer)
            return [
                FoundBox(box, label.strip() or query.strip() or "thing", score)
                for box, label, score in zip(
                    reply.boxes, reply.labels, reply.scores, strict=True
                )
                if score >= self.options.box_threshold
            ]
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(map(str, first["loc"])) or "the whole"
            why = f"{where}: {first['msg']}"
        except ValueError as error:
            why = str(error)
        raise self._failed(f"sent something that is no list of detections ({why})")

    def _answer(self, request: str) -> bytes:
        """Return the body of an answer; try again while the fault is one that passes."""
        seconds, attempt = self.options.timeout, 0
        while True:
            try:
                status, answer = _exchange(self.options.url, request, seconds)
                if status == 200:
                    return answer
                why = f"answered {status}{_said(answer)}"
                final = status not in WORTH_ANOTHER_TRY
            except (TimeoutError, httpx2.TimeoutException):
                why, final = f"did not answer within {seconds:g} s", False
            except (httpx2.InvalidURL, httpx2.UnsupportedProtocol) as error:
                why, final = f"cannot be asked: {one_line(error)}", True
            except ValueError as error:
                why, final = str(error), True
            except httpx2.ConnectError as error:
                why = f"cannot be reached: {one_line(error)}; is it running?"
                final = False
            except httpx2.HTTPError as error:
                why, final = f"broke off: {one_line(error)}", False
            attempt += 1
            if final or attempt > self.options.retries:
                tries = "" if attempt == 1 else f", {attempt} times in a row"
                raise self._failed(why + tries)
            time.sleep(self.options.first_delay * 2 ** (attempt - 1))

    def _failed(self, why: str) -> DetectorError:
        return DetectorError(f"detector at {self.options.url} {why}")


def _exchange(url: str, request: str, seconds: float) -> tuple[int, bytes]:
    """Post JSON; return status and body of the answer, after so many seconds at most."""
    headers = {"content-type": "application/json", "accept-encoding": "identity"}

    def ask(client: httpx2.Client) -> tuple[int, bytes]:
        received = bytearray()
        with client.stream("POST", url, content=request, headers=headers) as answer:
            for piece in answer.iter_raw():
                received += piece
                if len(received) > LONGEST_REPLY:
                    raise ValueError(f"sent more than {LONGEST_REPLY:,} bytes")
            return answer.status_code, bytes(received)

    with httpx2.Client(timeout=seconds, follow_redirects=False) as client:
        return within(seconds, lambda: ask(client))


def _said(answer: bytes) -> str:
    """Return the beginning of what a server said with its error."""
    text = answer[:500].decode("utf-8", "replace").strip()
    return f": {text.splitlines()[0][:200]}" if text else ""
