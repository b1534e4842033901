"""A detector behind an HTTP server; the JSON is described in `docs/perception.md`.

`examples/detector_server.py` is a server that speaks it.
"""

import base64
import io
import time
from dataclasses import KW_ONLY, dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from memorymaze.errors import DetectorError, SettingsError
from memorymaze.perception.picture_detector import FoundBox
from memorymaze.server_calls import checked_address, exchange

LONGEST_REPLY = 4_000_000
"""Bytes."""
WORTH_ANOTHER_TRY = frozenset({408, 425, 429, 500, 502, 503, 504})
"""States of servers that may soon be another."""

Number = Annotated[float, Field(allow_inf_nan=False)]
_Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]


class DetectionRequest(BaseModel):
    """What is sent: a picture, what to look for, and thresholds."""

    model_config = ConfigDict(extra="forbid")

    image: str
    """The picture's file, PNG or JPEG, in base64."""
    query: str
    """What to look for, in a few words."""
    box_threshold: _Share = 0.35
    """Least score of a box."""
    text_threshold: _Share = 0.25
    """Least score of a word to be part of the label."""


class DetectionReply(BaseModel):
    """What comes back: three lists of the same length."""

    boxes: list[tuple[Number, Number, Number, Number]]
    """Pixels (left, top, right, bottom) of the picture sent."""
    labels: list[str]
    """What the model calls each."""
    scores: list[_Share]
    """How sure it is of each, 0 to 1."""

    @model_validator(mode="after")
    def _check(self) -> "DetectionReply":
        if not len(self.boxes) == len(self.labels) == len(self.scores):
            raise ValueError(
                "expected as many boxes as labels and scores, got "
                f"{len(self.boxes)}, {len(self.labels)} and {len(self.scores)}"
            )
        for left, top, right, bottom in self.boxes:
            if left > right or top > bottom:
                raise ValueError(
                    "expected boxes as left, top, right, bottom, got "
                    f"{[left, top, right, bottom]}"
                )
        return self


@dataclass(frozen=True, slots=True)
class RemoteFinder:
    """Asks a server what is in a picture; implements `ObjectFinder`.

    A failing or busy server (408, 425, 429, 5xx), a lost connection and a time-out are
    tried again, each time after twice the wait.
    """

    url: str
    """Address that requests are posted to, http or https."""
    _: KW_ONLY
    box_threshold: float = 0.35
    """Sent along; boxes below it are dropped here too."""
    text_threshold: float = 0.25
    """Sent along."""
    timeout: float = 60.0
    """Seconds for a whole reply to come."""
    retries: int = 2
    """Attempts after the first."""
    first_delay: float = 1.0
    """Seconds before the second attempt."""

    def __post_init__(self) -> None:
        """Refuse what is no address; nothing is sent yet."""
        checked_address(
            "detector remote", self.url, "http://localhost:8000/detect", whole=True
        )

    def check(self) -> None:
        """Send a small grey picture, to find out early what is wrong."""
        try:
            self.find(np.full((48, 64, 3), 128, dtype=np.uint8), "door")
        except DetectorError as error:
            raise SettingsError(str(error)) from error

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        """Return what the server finds; see `ObjectFinder.find`."""
        file = io.BytesIO()
        Image.fromarray(rgb).save(file, "PNG", compress_level=1)
        request = DetectionRequest(
            image=base64.b64encode(file.getvalue()).decode("ascii"),
            query=query,
            box_threshold=self.box_threshold,
            text_threshold=self.text_threshold,
        )
        answer = self._ask(_encoded(request))
        try:
            reply = DetectionReply.model_validate_json(answer)
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(map(str, first["loc"])) or "the whole"
            raise self._failed(
                f"sent something that is no list of detections ({where}: "
                f"{first['msg']})"
            ) from error
        return [
            FoundBox(box, label.strip() or query.strip(), score)
            for box, label, score in zip(
                reply.boxes, reply.labels, reply.scores, strict=True
            )
            if score >= self.box_threshold
        ]

    def _ask(self, body: str) -> bytes:
        attempt = 0
        while True:
            try:
                status, answer = exchange(
                    "POST",
                    self.url,
                    body,
                    seconds=self.timeout,
                    longest=LONGEST_REPLY,
                )
                if status == 200:
                    return answer
                why = f"answered {status}{_said(answer)}"
                final = status not in WORTH_ANOTHER_TRY
            except TimeoutError:
                why, final = f"did not answer within {self.timeout:g} s", False
            except ConnectionError as error:
                why, final = str(error), False
            except ValueError as error:
                why, final = str(error), True
            attempt += 1
            if final or attempt > self.retries:
                tries = "" if attempt == 1 else f", {attempt} times in a row"
                raise self._failed(why + tries)
            time.sleep(self.first_delay * 2 ** (attempt - 1))

    def _failed(self, why: str) -> DetectorError:
        return DetectorError(f"detector at {self.url} {why}")


def _encoded(request: DetectionRequest) -> str:
    # Words may hold halves of characters, which are no UTF-8.
    text = request.query.encode("utf-8", "replace").decode("utf-8")
    return request.model_copy(update={"query": text}).model_dump_json()


def _said(answer: bytes) -> str:
    """Return the beginning of what a server said with its error."""
    text = answer[:500].decode("utf-8", "replace").strip()
    return f": {text.splitlines()[0][:200]}" if text else ""
