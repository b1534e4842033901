"""Walkthroughs: the first-person video of a route, as people are shown it in studies.

Holds the drive, the filming and the video file; no replays of runs.
"""

from memorymaze.pictures.films.filming import Tour, film_walkthrough, tour_of
from memorymaze.pictures.films.settings import WalkthroughSettings

__all__ = ["Tour", "WalkthroughSettings", "film_walkthrough", "tour_of"]
