"""The offline detector: it knows what the camera really sees."""

import math
from typing import Protocol

from memorymaze.errors import CommandError
from memorymaze.perception.tracking import Sighting, Tracker
from memorymaze.perception.visible_object import CameraView, VisibleObject
from memorymaze.perception.vocabulary import MATCH_THRESHOLD, match_score
from memorymaze.robot.api import DETECTION_RANGE, Detection

__all__ = ["LONGEST_QUERY", "Detector", "TruthDetector"]

LONGEST_QUERY = 300
"""Characters."""


class Detector(Protocol):
    """Finds things by name in a camera view; made anew for each episode."""

    def detect(self, view: CameraView, query: str) -> list[Detection]:
        """Return what fits the words, the nearest first."""
        ...


class TruthDetector:
    """Finds whatever the view says is seen and the words could mean.

    What limits it are the picture's edges, what hides what, and the depth sensor's
    range; it never mistakes one thing for another. One detector serves one episode:
    it remembers the things it has found, so that each keeps its `track_id`.
    """

    def __init__(self, range_limit: float = DETECTION_RANGE) -> None:
        """Begin an episode.

        Args:
            range_limit: Metres; things whose nearest seen part is farther are dropped.
        """
        if not range_limit > 0:
            raise ValueError(
                f"range_limit: expected metres greater than 0, got {range_limit}"
            )
        self._range_limit = range_limit
        self._tracker = Tracker()

    def detect(self, view: CameraView, query: str) -> list[Detection]:
        """Return the things seen that fit the words, the nearest first.

        Args:
            view: One look of the camera.
            query: Any English words; see `docs/perception.md` for how they are read.

        Raises:
            CommandError: The query is longer than any name of a thing.
        """
        if len(query) > LONGEST_QUERY:
            raise CommandError(
                "detect_from_RGB_image: expected what to look for in a few words, at"
                f" most {LONGEST_QUERY} characters, got {len(query)} characters"
            )
        seen = sorted(view.visible_objects(self._range_limit), key=_nearness)
        scores = [match_score(query, each.description) for each in seen]
        found = [
            (each, score)
            for each, score in zip(seen, scores, strict=True)
            if score >= MATCH_THRESHOLD
        ]
        numbers = self._tracker.update([
            Sighting(each.description.category, each.position, each.length)
            for each, _ in found
        ])
        return [
            Detection(
                label=each.description.category,
                box=each.box,
                score=score,
                distance=each.distance,
                bearing_deg=math.degrees(each.bearing),
                track_id=number,
            )
            for (each, score), number in zip(found, numbers, strict=True)
        ]


def _nearness(thing: VisibleObject) -> tuple[float, float]:
    return thing.distance, thing.bearing
