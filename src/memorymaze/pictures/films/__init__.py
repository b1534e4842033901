"""Walkthroughs: the first-person video of a route, as people are shown it in studies.

Holds the drawing of frames and the video file; no drives (`simulation`), no replays.
"""

from memorymaze.pictures.films.settings import WalkthroughSettings

__all__ = ["WalkthroughSettings"]
