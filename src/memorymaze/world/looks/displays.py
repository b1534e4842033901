"""What surfaces show that are drawn for each thing: words, posters, screens, maps."""

import re
from collections.abc import Callable
from dataclasses import dataclass

from memorymaze.basics.signposts import signposts
from memorymaze.world.looks import artwork
from memorymaze.world.looks.boards import (
    PICTOGRAMS,
    Pictogram,
    blank_board,
    exit_board,
    pictogram_board,
    sign_board,
)
from memorymaze.world.looks.materials import (
    CHALK,
    OCEAN,
    SAFETY_GREEN,
    Pixels,
    Rgb,
)


@dataclass(frozen=True, slots=True)
class Display:
    """A surface to draw on, and what is known of its thing."""

    width: float
    """Metres."""
    height: float
    text: str
    """Empty where it has none."""
    category: str
    ground: Rgb
    """The colour to draw on, or the main colour of what is drawn."""
    second: Rgb | None
    """The second colour that the plan names."""
    variant: int
    """Tells pictures apart that nobody described."""

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.width, self.height


def _back_of_words(on: Display) -> Pixels:
    """Draw words to be read from behind too, unless they point somewhere."""
    if any(post.arrow for post in signposts(on.text)):
        return blank_board(*on.size, on.ground)
    return sign_board(*on.size, on.text, on.ground)


def _menu(on: Display) -> Pixels:
    lines = "\n".join((on.text or on.category).split(" / "))
    return sign_board(*on.size, lines, on.ground)


def _sign(on: Display) -> Pixels:
    """Draw words, and a pictogram where one says more."""
    text = (on.text or on.category).strip()
    pictograms = _pictograms(text)
    if pictograms and 0.6 < on.width / on.height < 1.6:
        return pictogram_board(*on.size, text, pictograms, on.ground)
    return sign_board(*on.size, text, on.ground)


def _heart(on: Display) -> Pixels:
    ground = on.ground if min(on.ground) < 0.7 else SAFETY_GREEN
    return pictogram_board(*on.size, on.text or "AED", ("heart",), ground)


def _restroom_sign(on: Display) -> Pixels:
    pictograms = _pictograms(on.text) or ("woman", "man")
    return pictogram_board(*on.size, on.text, pictograms, on.ground)


def _world_map(on: Display) -> Pixels:
    sea = OCEAN if min(on.ground) > 0.8 else on.ground
    return artwork.world_map_picture(*on.size, on.text, sea, on.second or artwork.LAND)


def _pictograms(text: str) -> tuple[Pictogram, ...]:
    """Return those for the words that a text begins with."""
    for words, pictograms in PICTOGRAMS.items():
        if re.match(rf"{words}\b", text, re.IGNORECASE):
            return pictograms
    return ()


DISPLAYS: dict[str, Callable[[Display], Pixels]] = {
    "words": lambda on: sign_board(*on.size, on.text, on.ground),
    "words:framed": lambda on: sign_board(*on.size, on.text, on.ground, framed=True),
    "words:back": _back_of_words,
    "picture:banded planet": lambda on: artwork.planet(
        on.ground, banded=True, variant=on.variant
    ),
    "picture:cork board": lambda on: artwork.cork_board(
        *on.size, on.text, on.ground, on.variant
    ),
    "picture:exit": lambda on: exit_board(*on.size, on.text or "EXIT"),
    "picture:film": lambda on: artwork.film(*on.size, on.text, on.variant),
    "picture:flag": lambda on: artwork.flag_picture(
        *on.size, on.ground, on.second or CHALK
    ),
    "picture:floor map": lambda on: artwork.floor_map_picture(
        *on.size, on.text, on.ground, on.variant
    ),
    "picture:heart": _heart,
    "picture:menu": _menu,
    "picture:painting": lambda on: artwork.painting_picture(
        *on.size, on.ground, on.variant
    ),
    "picture:panel": lambda on: artwork.headlined(
        *on.size, on.text, on.ground, on.variant
    ),
    "picture:photos": lambda on: artwork.photo_picture(*on.size, on.ground),
    "picture:planet": lambda on: artwork.planet(
        on.ground, banded=False, variant=on.variant
    ),
    "picture:poster": lambda on: artwork.poster_picture(
        *on.size, on.text, on.ground, on.variant
    ),
    "picture:restroom sign": _restroom_sign,
    "picture:screen": lambda on: artwork.film(*on.size, "", on.variant),
    "picture:sign": _sign,
    "picture:video wall": lambda on: artwork.film(
        *on.size, on.text, on.variant, tiles=3
    ),
    "picture:whiteboard": lambda on: artwork.marker_board(
        *on.size, on.text, on.variant
    ),
    "picture:world map": _world_map,
}
"""What draws a surface, by the name of its material in a file of models."""
