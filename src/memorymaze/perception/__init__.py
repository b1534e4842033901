"""From what a camera sees to things with names; no sites and no answers in here."""

from memorymaze.perception.detector import Detector
from memorymaze.perception.tracking import Sighting, Tracker
from memorymaze.perception.truth_detector import TruthDetector
from memorymaze.perception.visible_object import (
    CameraView,
    ObjectDescription,
    VisibleObject,
)
from memorymaze.perception.vocabulary import MATCH_THRESHOLD, match_score

__all__ = [
    "MATCH_THRESHOLD",
    "CameraView",
    "Detector",
    "ObjectDescription",
    "Sighting",
    "Tracker",
    "TruthDetector",
    "VisibleObject",
    "match_score",
]
