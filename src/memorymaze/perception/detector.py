"""What every detector does and refuses, and the one that knows what is really seen."""

import math
from typing import NamedTuple, Protocol

from memorymaze.errors import CommandError
from memorymaze.geometry.pose import Pose
from memorymaze.perception.camera_view import CameraView, VisibleObject
from memorymaze.perception.error_model import ErrorSource, Phantom
from memorymaze.perception.matching import MATCH_THRESHOLD, match_score
from memorymaze.perception.tracking import Sighting, Tracker
from memorymaze.robot.api import DETECTION_RANGE, Detection

LONGEST_QUERY = 300
"""Characters."""


class Detector(Protocol):
    """Finds things by name in a camera view; made anew for each episode.

    A detector that knows the truth asks the view for its `visible_objects`; one that
    looks asks it for a `picture`, which is drawn then and not before.
    """

    def detect(self, view: CameraView, query: str) -> list[Detection]:
        """Return what fits the words, the nearest first.

        Args:
            view: One look of the camera.
            query: Any English words.

        Raises:
            CommandError: The query is longer than any name of a thing.
            DetectorError: The detector failed, which is not the query's fault.
        """
        ...


def check_query(query: str) -> None:
    """Refuse what is longer than any name of a thing.

    Raises:
        CommandError: It is.
    """
    if len(query) > LONGEST_QUERY:
        raise CommandError(
            "detect_from_RGB_image: expected what to look for in a few words, at"
            f" most {LONGEST_QUERY} characters, got {len(query)} characters"
        )


class TruthDetector:
    """Finds whatever the view says is seen and the words could mean.

    What limits it are the picture's edges, what hides what, and the depth sensor's
    range; it mistakes one thing for another, or misses it, only where it is given a
    source of errors. One detector serves one episode: it remembers the things it has
    found, so that each keeps its `track_id`.
    """

    def __init__(
        self, range_limit: float = DETECTION_RANGE, errors: ErrorSource | None = None
    ) -> None:
        """Begin an episode.

        Args:
            range_limit: Metres; things whose nearest seen part is farther are dropped.
            errors: Of this episode; None makes none.
        """
        if not range_limit > 0:
            raise ValueError(
                f"range_limit: expected metres greater than 0, got {range_limit}"
            )
        self._range_limit = range_limit
        self._errors = errors
        self._tracker = Tracker()

    def detect(self, view: CameraView, query: str) -> list[Detection]:
        """Return the things seen that fit the words, the nearest first.

        Args:
            view: One look of the camera.
            query: Any English words; see `docs/perception.md` for how they are read.

        Raises:
            CommandError: The query is longer than any name of a thing.
        """
        check_query(query)
        seen = sorted(view.visible_objects(self._range_limit), key=_nearness)
        scores = [match_score(query, each.description) for each in seen]
        fitting = [
            (each, score)
            for each, score in zip(seen, scores, strict=True)
            if score >= MATCH_THRESHOLD
        ]
        finds = [
            _find_of(each, each.description.category, score) for each, score in fitting
        ]
        if self._errors is not None:
            others = [
                each
                for each, score in zip(seen, scores, strict=True)
                if score < MATCH_THRESHOLD
            ]
            finds = [
                find
                for find, (each, _) in zip(finds, fitting, strict=True)
                if not self._errors.misses(each, view.pose, query)
            ]
            finds += self._false_alarms(self._errors, others, view.pose, query)
            finds.sort(key=lambda each: (each.distance, each.bearing))
        numbers = self._tracker.update([each.sighting for each in finds])
        return [
            Detection(
                label=each.label,
                box=each.box,
                score=each.score,
                distance=each.distance,
                bearing_deg=math.degrees(each.bearing),
                track_id=number,
            )
            for each, number in zip(finds, numbers, strict=True)
        ]

    def _false_alarms(
        self, errors: ErrorSource, others: list[VisibleObject], pose: Pose, query: str
    ) -> list["_Find"]:
        """Return what is mistaken for what is asked for, under the name asked for."""
        name = " ".join(query.split())
        confused = [
            _find_of(each, name, errors.false_score(each, pose, query))
            for each in others
            if errors.confuses(each, pose, query)
        ]
        phantoms = errors.phantoms(pose, query, self._range_limit)
        return confused + [_phantom_find(each, name, pose) for each in phantoms]


class _Find(NamedTuple):
    label: str
    box: tuple[float, float, float, float]
    score: float
    distance: float
    bearing: float
    sighting: Sighting


def _find_of(thing: VisibleObject, label: str, score: float) -> _Find:
    sighting = Sighting(label, thing.position, thing.length)
    return _Find(label, thing.box, score, thing.distance, thing.bearing, sighting)


def _phantom_find(phantom: Phantom, label: str, pose: Pose) -> _Find:
    heading = pose.heading + phantom.bearing
    place = (
        pose.x + phantom.distance * math.cos(heading),
        pose.y + phantom.distance * math.sin(heading),
    )
    return _Find(
        label,
        phantom.box,
        phantom.score,
        phantom.distance,
        phantom.bearing,
        Sighting(label, place, 0.0),
    )


def _nearness(thing: VisibleObject) -> tuple[float, float]:
    return thing.distance, thing.bearing
