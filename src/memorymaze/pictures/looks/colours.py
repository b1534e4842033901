"""Colour words of site plans as numbers."""

import re
from functools import cache

Rgb = tuple[float, float, float]
"""Red, green, blue in [0, 1]."""

NAMED: dict[str, Rgb] = {
    "amber": (0.95, 0.66, 0.12),
    "aluminium": (0.74, 0.75, 0.77),
    "aluminum": (0.74, 0.75, 0.77),
    "beige": (0.87, 0.80, 0.66),
    "black": (0.09, 0.09, 0.10),
    "blue": (0.13, 0.36, 0.75),
    "brass": (0.76, 0.62, 0.28),
    "beech": (0.80, 0.62, 0.42),
    "bronze": (0.48, 0.34, 0.20),
    "brown": (0.45, 0.29, 0.17),
    "chrome": (0.78, 0.79, 0.82),
    "clear": (0.72, 0.83, 0.88),
    "copper": (0.72, 0.43, 0.28),
    "cork": (0.74, 0.56, 0.36),
    "cream": (0.95, 0.91, 0.80),
    "cyan": (0.15, 0.70, 0.80),
    "glass": (0.72, 0.83, 0.88),
    "gold": (0.83, 0.65, 0.22),
    "gray": (0.55, 0.56, 0.58),
    "green": (0.14, 0.52, 0.26),
    "grey": (0.55, 0.56, 0.58),
    "ivory": (0.95, 0.92, 0.84),
    "magenta": (0.78, 0.15, 0.55),
    "maroon": (0.45, 0.09, 0.13),
    "marble": (0.90, 0.89, 0.87),
    "navy": (0.08, 0.13, 0.34),
    "oak": (0.74, 0.56, 0.36),
    "olive": (0.42, 0.44, 0.18),
    "orange": (0.93, 0.49, 0.11),
    "pine": (0.80, 0.64, 0.42),
    "pink": (0.93, 0.56, 0.68),
    "purple": (0.44, 0.22, 0.58),
    "red": (0.79, 0.13, 0.13),
    "silver": (0.74, 0.75, 0.77),
    "steel": (0.68, 0.70, 0.72),
    "stone": (0.62, 0.60, 0.56),
    "tan": (0.78, 0.64, 0.46),
    "teak": (0.55, 0.36, 0.20),
    "teal": (0.07, 0.48, 0.50),
    "terracotta": (0.72, 0.38, 0.25),
    "turquoise": (0.13, 0.66, 0.66),
    "violet": (0.50, 0.30, 0.72),
    "walnut": (0.38, 0.25, 0.16),
    "white": (0.93, 0.93, 0.92),
    "wood": (0.66, 0.46, 0.28),
    "wooden": (0.66, 0.46, 0.28),
    "yellow": (0.96, 0.79, 0.13),
}
TONES = {"dark": 0.55, "deep": 0.7, "light": 1.45, "pale": 1.6, "bright": 1.15}
WOODS = frozenset({"wood", "wooden", "oak", "walnut", "brown", "pine", "beech", "teak"})


@cache
def colours_of(words: str | None) -> tuple[Rgb, ...]:
    """Return the colours that words such as `dark blue and white` name, in order.

    Empty where no word is known.
    """
    found: list[Rgb] = []
    tone = 1.0
    for word in re.findall(r"[a-z]+", (words or "").lower()):
        if word in TONES:
            tone = TONES[word]
        elif word in NAMED:
            # A noun before a colour, as in "stone grey", only says which grey.
            if found and word in {"grey", "gray"} and "stone" in (words or "").lower():
                continue
            found.append(shade(NAMED[word], tone))
            tone = 1.0
    return tuple(found)


def is_wooden(words: str | None) -> bool:
    """Return whether colour words name wood."""
    return any(word in WOODS for word in re.findall(r"[a-z]+", (words or "").lower()))


def shade(colour: Rgb, factor: float) -> Rgb:
    """Return a colour darker (factor < 1) or nearer to white (factor > 1)."""
    if factor <= 1:
        red, green, blue = (factor * each for each in colour)
        return red, green, blue
    return mixed(colour, (1.0, 1.0, 1.0), min(1.0, factor - 1))


def mixed(colour: Rgb, other: Rgb, share: float) -> Rgb:
    """Return a colour with a share of another one, in [0, 1]."""
    red, green, blue = (
        (1 - share) * a + share * b for a, b in zip(colour, other, strict=True)
    )
    return red, green, blue


def ink_on(ground: Rgb) -> Rgb:
    """Return black or white, whichever reads better on a ground."""
    red, green, blue = ground
    light = 0.299 * red + 0.587 * green + 0.114 * blue
    return (0.05, 0.05, 0.07) if light > 0.56 else (1.0, 1.0, 1.0)


def rgb255(colour: Rgb) -> tuple[int, int, int]:
    """Return a colour in whole numbers up to 255."""
    red, green, blue = (round(255 * min(max(each, 0.0), 1.0)) for each in colour)
    return red, green, blue
