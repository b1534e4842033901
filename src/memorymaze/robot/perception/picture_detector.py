"""From boxes that a model finds in a picture to detections with distance and track.

The model is an `ObjectFinder`: it sees colours only. Distance comes from the depth
picture, direction from the box.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from memorymaze.robot.api.control import DETECTION_RANGE, Detection
from memorymaze.robot.api.steps import CameraPicture
from memorymaze.robot.perception.camera_view import (
    CameraView,
    PixelBox,
    box_bearing,
    place_at_bearing,
)
from memorymaze.robot.perception.detector import Find, check_query, detections
from memorymaze.robot.perception.tracking import SingleSighting, Tracker

SAME_THING = 0.7
"""Overlap (intersection over union) from which two boxes are one thing."""


@dataclass(frozen=True, slots=True)
class FoundBox:
    """Something a model found in a picture."""

    box: PixelBox
    """Pixels (left, top, right, bottom)."""
    label: str
    """What the model calls it."""
    score: float
    """How sure it is, 0 to 1."""

    def __post_init__(self) -> None:
        """Refuse what is no box of a picture."""
        left, top, right, bottom = self.box
        if not (left <= right and top <= bottom and all(map(math.isfinite, self.box))):
            raise ValueError(
                "expected a box as left, top, right, bottom in pixels, got "
                f"{list(self.box)}"
            )
        if not self.label.strip() or not 0 <= self.score <= 1:
            raise ValueError(
                "expected a box with a label and a score from 0 to 1, got "
                f"{self.label!r} and {self.score}"
            )


class ObjectFinder(Protocol):
    """Finds things by name in a picture; one serves any number of episodes."""

    def find(self, rgb: NDArray[np.uint8], query: str) -> Sequence[FoundBox]:
        """Return what fits any words in a picture, (height, width, 3), and leave it as it is.

        Raises:
            DetectorError: It failed, which is not the query's fault.
        """
        ...


class PictureDetector:
    """Looks for things in the camera's picture with a model; implements `Detector`.

    Boxes are cut at the picture's edge; of two that overlap by 70 % the better one is
    kept. The distance is the median over the box of the depth sensor's, so a thing must
    fill half of its box; farther than the range it is dropped. One detector serves one
    episode: things that are found again where they were keep their `track_id`,
    whatever the model calls them.
    """

    def __init__(
        self, finder: ObjectFinder, range_limit: float = DETECTION_RANGE
    ) -> None:
        """Begin an episode; things farther than some metres are dropped."""
        self._finder = finder
        self._range_limit = range_limit
        self._tracker = Tracker()

    def detect(self, view: CameraView, query: str) -> list[Detection]:
        """Return what the model finds near enough, the nearest first; see `Detector`."""
        check_query(query)
        picture = view.picture()
        height, width = picture.depth.shape
        cut = [
            _cut(each, width, height) for each in self._finder.find(picture.rgb, query)
        ]
        finds: list[Find] = []
        for each in _without_doubles([found for found in cut if found is not None]):
            distance = depth_distance(picture, each.box)
            if distance is not None and distance <= self._range_limit:
                bearing = box_bearing(each.box, width)
                sighting = SingleSighting(
                    "thing",
                    place_at_bearing(view.pose, distance, bearing),
                    distance * (each.box[2] - each.box[0]) / (width / 2),
                )
                finds.append(
                    Find(each.label, each.box, each.score, distance, bearing, sighting)
                )
        return detections(finds, self._tracker)


def depth_distance(picture: CameraPicture, box: PixelBox) -> float | None:
    """Return metres from the lens to what fills a box; None where nothing is.

    That is the median depth over the box, along the way to its middle. The picture is
    90 degrees wide; what of the box is outside it is left out.
    """
    height, width = picture.depth.shape
    left, top, right, bottom = box
    rows = slice(max(math.floor(top), 0), max(math.ceil(bottom), 0))
    columns = slice(max(math.floor(left), 0), max(math.ceil(right), 0))
    depths = picture.depth[rows, columns]
    depths = depths[np.isfinite(depths)]
    if not depths.size:
        return None
    focal = width / 2
    across = ((left + right) / 2 - width / 2) / focal
    down = ((top + bottom) / 2 - height / 2) / focal
    return float(np.median(depths)) * math.sqrt(1 + across**2 + down**2)


def _cut(found: FoundBox, width: int, height: int) -> FoundBox | None:
    """Cut a box at the picture's edge; None where nothing of it is inside."""
    left, top, right, bottom = found.box
    left, right = max(left, 0.0), min(right, float(width))
    top, bottom = max(top, 0.0), min(bottom, float(height))
    if right - left < 1 or bottom - top < 1:
        return None
    return FoundBox((left, top, right, bottom), found.label, found.score)


def _without_doubles(found: Sequence[FoundBox]) -> list[FoundBox]:
    kept: list[FoundBox] = []
    for each in sorted(found, key=lambda each: -each.score):
        if all(_overlap(each.box, other.box) < SAME_THING for other in kept):
            kept.append(each)
    return kept


def _overlap(a: PixelBox, b: PixelBox) -> float:
    """Return the intersection over union of two boxes."""
    wide = min(a[2], b[2]) - max(a[0], b[0])
    tall = min(a[3], b[3]) - max(a[1], b[1])
    if wide <= 0 or tall <= 0:
        return 0.0
    shared = wide * tall
    areas = sum((box[2] - box[0]) * (box[3] - box[1]) for box in (a, b))
    return shared / (areas - shared)
