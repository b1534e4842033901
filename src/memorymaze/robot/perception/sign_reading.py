"""Reading signs: from what the view knows, or from the picture with an OCR library.

The second needs the extra `ocr` (rapidocr and onnxruntime), imported when something is
first read; the library ships its weights.
"""

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import DetectorError
from memorymaze.basics.extras import require_extra
from memorymaze.basics.wording import single_spaced
from memorymaze.robot.api.control import READING_RANGE, SignText
from memorymaze.robot.api.steps import CameraPicture
from memorymaze.robot.perception.camera_view import (
    CameraView,
    PixelBox,
    VisibleText,
    box_bearing,
    place_at_bearing,
)
from memorymaze.robot.perception.picture_detector import depth_distance
from memorymaze.robot.perception.tracking import SingleSighting, Tracker

LEAST_LETTER = 5.0
"""Pixels of a capital letter in the 640x480 picture below which nothing is read."""
WIDEST_FACING = math.radians(60)
"""A text that is turned farther away is not read."""
LEAST_SEEN = 0.6
"""Share of the thing's part in the picture that must be unhidden."""
PICTURE_SIZE = (1280, 960)
"""Pixels of the picture that signs are read from: the camera's view, drawn finer."""
LEAST_SCORE = 0.7
"""Lines that the recogniser is less sure of are dropped."""
LINE_GAP = 0.9
"""Lines of one sign are at most so many line heights apart."""
SAME_SURFACE = 0.25
"""Metres by which the distances of lines of one sign may differ."""
SAME_PLACE = 0.8
"""Metres between two looks at a text that is taken for the same."""


class SignReader(Protocol):
    """Reads texts in a camera view; made anew for each episode."""

    def read(self, view: CameraView) -> list[SignText]:
        """Return the texts that can be read, the nearest first."""
        ...


class TruthSignReader:
    """Reads whatever a good camera could read, without a mistake.

    A text is read when it is within 6 m, turned to the camera by 60 degrees or less,
    the picture's edge does not cut it, its capital letters are at least 5 pixels high in the 640x480 picture, and at least
    60 % of the thing's part in the picture is unhidden. One reader serves one episode:
    it remembers what it has read, so that each text keeps its `track_id`.
    """

    def __init__(self) -> None:
        """Begin an episode."""
        self._tracker = Tracker()

    def read(self, view: CameraView) -> list[SignText]:
        """Return the texts that can be read, the nearest first."""
        found: list[_Found] = []
        texts = view.visible_texts(READING_RANGE, WIDEST_FACING)
        for seen in filter(_readable, texts):
            text, on = single_spaced(seen.text), seen.bearer
            sighting = SingleSighting(text, on.position, on.length)
            found.append(_Found(on.distance, on.bearing, text, sighting))
        return _sign_texts(found, self._tracker)


class _Found(NamedTuple):
    """A text in one look, before it is known whether it was read before."""

    distance: float
    bearing: float
    text: str
    sighting: SingleSighting


def _sign_texts(found: list[_Found], tracker: Tracker) -> list[SignText]:
    """Return what was read in one look, the nearest first, each with its track."""
    ordered = sorted(found, key=lambda each: (each.distance, each.bearing))
    numbers = tracker.update([each.sighting for each in ordered])
    return [
        SignText(each.text, each.distance, math.degrees(each.bearing), number)
        for each, number in zip(ordered, numbers, strict=True)
    ]


def _readable(seen: VisibleText) -> bool:
    return (
        seen.facing <= WIDEST_FACING
        and not seen.cut
        and seen.letter_height >= LEAST_LETTER
        and seen.bearer.visible_fraction >= LEAST_SEEN
        and single_spaced(seen.text) != ""
    )


@dataclass(frozen=True, slots=True)
class FoundLine:
    """A line of text in a picture."""

    box: PixelBox
    """Pixels (left, top, right, bottom)."""
    text: str
    """As read."""
    score: float
    """How sure the recogniser is, 0 to 1."""


class Recognizer(Protocol):
    """Reads lines in a picture; one serves any number of episodes."""

    def lines(self, rgb: NDArray[np.uint8]) -> Sequence[FoundLine]:
        """Return the lines of text in a picture, (height, width, 3)."""
        ...


class TextRecognizer:
    """RapidOCR with the PP-OCR weights that its wheel holds; loaded when first used."""

    def check(self) -> None:
        """Load it, to find out early what is missing."""
        _ = self._engine

    def lines(self, rgb: NDArray[np.uint8]) -> list[FoundLine]:
        """Return the lines of text in a picture; see `Recognizer.lines`."""
        engine = self._engine
        try:
            # It takes colours in the order blue, green, red.
            found = engine(np.ascontiguousarray(rgb[:, :, ::-1]))
        except Exception as error:
            raise DetectorError(f"signs: the recogniser failed ({error})") from error
        if found.boxes is None:
            return []
        return [
            FoundLine(_around(corners), str(text), float(score))
            for corners, text, score in zip(
                found.boxes, found.txts, found.scores, strict=True
            )
        ]

    @cached_property
    def _engine(self) -> Any:
        require_extra(
            "ocr",
            "rapidocr",
            "onnxruntime",
            purpose="signs read from pictures",
            otherwise="take --with signs=truth",
        )
        from rapidocr import RapidOCR

        logging.getLogger("RapidOCR").setLevel(logging.ERROR)
        return RapidOCR(params={"Global.log_level": "error"})


class PictureSignReader:
    """Reads the texts in the camera's picture; implements `SignReader`.

    The picture is drawn at 1280x960 pixels. Lines that stand close below each other on
    one surface become one text. One reader serves one episode: a text that is read at
    the same place again keeps its `track_id`, also where a letter is read otherwise.
    """

    def __init__(self, recognizer: Recognizer) -> None:
        """Begin an episode."""
        self._recognizer = recognizer
        self._tracker = Tracker()

    def read(self, view: CameraView) -> list[SignText]:
        """Return the texts that can be read, the nearest first."""
        picture = view.picture(*PICTURE_SIZE)
        found: list[_Found] = []
        for sign in _joined(self._placed(picture)):
            if sign.distance <= READING_RANGE:
                bearing = box_bearing(sign.box, PICTURE_SIZE[0])
                place = place_at_bearing(view.pose, sign.distance, bearing)
                sighting = SingleSighting("text", place, SAME_PLACE)
                found.append(_Found(sign.distance, bearing, sign.text, sighting))
        return _sign_texts(found, self._tracker)

    def _placed(self, picture: CameraPicture) -> list["_Placed"]:
        """Return the lines that are sure enough, with their distances, from the top."""
        placed: list[_Placed] = []
        for line in self._recognizer.lines(picture.rgb):
            text = single_spaced(line.text)
            distance = depth_distance(picture, line.box)
            if line.score >= LEAST_SCORE and text and distance is not None:
                height = line.box[3] - line.box[1]
                placed.append(_Placed(line.box, text, distance, height))
        return sorted(placed, key=lambda each: (each.box[1], each.box[0]))


class _Placed(NamedTuple):
    box: PixelBox
    text: str
    distance: float
    line_height: float


def _joined(lines: Sequence[_Placed]) -> list[_Placed]:
    """Put lines that stand below each other on one surface together."""
    signs: list[_Placed] = []
    for line in lines:
        above = next(
            (place for place, sign in enumerate(signs) if _goes_on(sign, line)), None
        )
        if above is None:
            signs.append(line)
            continue
        sign = signs[above]
        signs[above] = _Placed(
            (
                min(sign.box[0], line.box[0]),
                min(sign.box[1], line.box[1]),
                max(sign.box[2], line.box[2]),
                max(sign.box[3], line.box[3]),
            ),
            f"{sign.text} {line.text}",
            min(sign.distance, line.distance),
            line.line_height,
        )
    return signs


def _goes_on(sign: _Placed, line: _Placed) -> bool:
    height = min(sign.line_height, line.line_height)
    apart = line.box[1] - sign.box[3]
    shared = min(sign.box[2], line.box[2]) - max(sign.box[0], line.box[0])
    narrower = min(sign.box[2] - sign.box[0], line.box[2] - line.box[0])
    return (
        -0.5 * height <= apart <= LINE_GAP * height
        and shared >= 0.5 * narrower
        and max(sign.line_height, line.line_height) <= 2 * height
        and abs(sign.distance - line.distance) <= SAME_SURFACE
    )


def _around(corners: Any) -> PixelBox:
    xs, ys = np.asarray(corners, dtype=np.float64).T
    return float(xs.min()), float(ys.min()), float(xs.max()), float(ys.max())
