"""From what a camera sees to things with names and signs with words.

Detectors and readers of signs, the vocabulary by which words are matched with things, and
turning points from LiDAR scans. What is truly seen comes in as a `CameraView`: no sites,
no simulation and no answers in here.
"""

from memorymaze.robot.perception.camera_view import (
    CameraView,
    ObjectDescription,
    VisibleObject,
)
from memorymaze.robot.perception.detector import Detector, TruthDetector
from memorymaze.robot.perception.matching import MATCH_THRESHOLD, match_score
from memorymaze.robot.perception.picture_detector import FoundBox, ObjectFinder
from memorymaze.robot.perception.tracking import SingleSighting, Tracker

__all__ = [
    "MATCH_THRESHOLD",
    "CameraView",
    "Detector",
    "FoundBox",
    "ObjectDescription",
    "ObjectFinder",
    "SingleSighting",
    "Tracker",
    "TruthDetector",
    "VisibleObject",
    "match_score",
]
