"""Walkthroughs: the first-person video of a route, as people are shown it in studies.

Holds the drive along the route and the drawing of frames; no replays of walks (`replay`).
"""

from memorymaze.runs.films.settings import WalkthroughSettings

__all__ = ["WalkthroughSettings"]
