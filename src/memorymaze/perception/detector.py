"""What every detector does, and what it refuses."""

from typing import Protocol

from memorymaze.errors import CommandError
from memorymaze.perception.visible_object import CameraView
from memorymaze.robot.api import Detection

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
