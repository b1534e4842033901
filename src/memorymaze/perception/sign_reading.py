"""Reading signs: which of the texts in view can be read, from what the view knows."""

import math
from typing import Protocol

from memorymaze.perception.tracking import Sighting, Tracker
from memorymaze.perception.visible_object import CameraView, VisibleText
from memorymaze.robot.api import READING_RANGE, SignText

LEAST_LETTER = 5.0
"""Pixels of a capital letter in the 640x480 picture below which nothing is read."""
WIDEST_FACING = math.radians(60)
"""A text that is turned farther away is not read."""
LEAST_SEEN = 0.6
"""Share of the thing's part in the picture that must be unhidden."""


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
        read = [each for each in view.visible_texts(READING_RANGE) if _readable(each)]
        read.sort(key=lambda each: (each.bearer.distance, each.bearer.bearing))
        numbers = self._tracker.update([
            Sighting(one_line(each.text), each.bearer.position, each.bearer.length)
            for each in read
        ])
        return [
            SignText(
                text=one_line(each.text),
                distance=each.bearer.distance,
                bearing_deg=math.degrees(each.bearer.bearing),
                track_id=number,
            )
            for each, number in zip(read, numbers, strict=True)
        ]


def one_line(text: str) -> str:
    """Return a text with single spaces and no line breaks."""
    return " ".join(text.split())


def _readable(seen: VisibleText) -> bool:
    return (
        seen.facing <= WIDEST_FACING
        and not seen.cut
        and seen.letter_height >= LEAST_LETTER
        and seen.bearer.visible_fraction >= LEAST_SEEN
        and one_line(seen.text) != ""
    )
