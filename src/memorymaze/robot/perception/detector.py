"""What every detector does and refuses, and the one that knows what is really seen."""

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple, Protocol

from memorymaze.basics.errors import CommandError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.control import DETECTION_RANGE, Detection
from memorymaze.robot.perception.camera_view import (
    CameraView,
    PixelBox,
    VisibleObject,
    Wanted,
    place_at_bearing,
)
from memorymaze.robot.perception.error_model import ErrorSource, Phantom
from memorymaze.robot.perception.matching import MATCH_THRESHOLD, match_score
from memorymaze.robot.perception.tracking import SingleSighting, Tracker

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
    """Refuse what is longer than any name of a thing."""
    if len(query) > LONGEST_QUERY:
        raise CommandError(
            "detect_from_RGB_image: expected what to look for in a few words, at"
            f" most {LONGEST_QUERY} characters, got {len(query)} characters"
        )


class Find(NamedTuple):
    """Something found in one look, before it is known whether it was seen before."""

    label: str
    box: PixelBox
    score: float
    distance: float
    bearing: float
    sighting: SingleSighting


def detections(finds: Iterable[Find], tracker: Tracker) -> list[Detection]:
    """Return what was found in one look, the nearest first, each with its track."""
    ordered = sorted(finds, key=lambda each: (each.distance, each.bearing))
    numbers = tracker.update([each.sighting for each in ordered])
    return [
        Detection(
            label=each.label,
            box=each.box,
            score=each.score,
            distance=each.distance,
            bearing_deg=math.degrees(each.bearing),
            track_id=number,
        )
        for each, number in zip(ordered, numbers, strict=True)
    ]


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
            query: Any English words; see `docs/seeing.md` for how they are read.

        Raises:
            CommandError: The query is longer than any name of a thing.
        """
        check_query(query)
        errors = self._errors
        finds: list[Find] = []
        others: list[VisibleObject] = []
        # Who may take one thing for another looks at all.
        wanted = _fitting(query) if errors is None else None
        for each in view.visible_objects(self._range_limit, wanted):
            score = match_score(query, each.description)
            if score < MATCH_THRESHOLD:
                others.append(each)
            elif errors is None or not errors.misses(each, view.pose, query):
                finds.append(_find_of(each, each.description.category, score))
        if errors is not None:
            finds += self._false_alarms(errors, others, view.pose, query)
        return detections(finds, self._tracker)

    def _false_alarms(
        self, errors: ErrorSource, others: list[VisibleObject], pose: Pose, query: str
    ) -> list[Find]:
        """Return what is mistaken for what is asked for, under the name asked for."""
        name = " ".join(query.split())
        confused = [
            _find_of(each, name, errors.false_score(each, pose, query))
            for each in others
            if errors.confuses(each, pose, query)
        ]
        phantoms = errors.phantoms(pose, query, self._range_limit)
        return confused + [_phantom_find(each, name, pose) for each in phantoms]


@lru_cache(maxsize=4096)
def _fitting(query: str) -> Wanted:
    """Return the test whether a thing fits some words, the same for the same words."""
    return lambda thing: match_score(query, thing) >= MATCH_THRESHOLD


def _find_of(thing: VisibleObject, label: str, score: float) -> Find:
    sighting = SingleSighting(label, thing.position, thing.length)
    return Find(label, thing.box, score, thing.distance, thing.bearing, sighting)


def _phantom_find(phantom: Phantom, label: str, pose: Pose) -> Find:
    place = place_at_bearing(pose, phantom.distance, phantom.bearing)
    return Find(
        label,
        phantom.box,
        phantom.score,
        phantom.distance,
        phantom.bearing,
        SingleSighting(label, place, 0.0),
    )
