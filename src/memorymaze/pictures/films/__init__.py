"""Walkthroughs: the first-person video of a route, as people are shown it in studies."""

from memorymaze.pictures.films.filming import (
    WalkthroughSettings,
    film_walkthrough,
)
from memorymaze.pictures.films.tour import Tour, tour_of

__all__ = ["Tour", "WalkthroughSettings", "film_walkthrough", "tour_of"]
