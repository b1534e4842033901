"""How surfaces look: colours and their words, paints, wood, metal and glass."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from memorymaze.world.looks.word_lists import read_table

Rgb = tuple[float, float, float]
"""Red, green, blue in [0, 1]."""
Pixels = NDArray[np.uint8]
DULL, POLISHED = 0.1, 0.5
"""The two degrees of shininess of paints: few, so that they can be drawn at once."""
OPAQUE_FROM = 0.999
"""Alpha from which on nothing is seen through."""
CHALK: Rgb = (0.93, 0.93, 0.92)
INK: Rgb = (0.12, 0.12, 0.14)
LEAD: Rgb = (0.16, 0.17, 0.18)
OCEAN: Rgb = (0.14, 0.36, 0.66)
PURE_WHITE: Rgb = (1.0, 1.0, 1.0)
SAFETY_GREEN: Rgb = (0.0, 0.48, 0.24)
STEEL: Rgb = (0.7, 0.71, 0.73)


@dataclass(frozen=True, slots=True, eq=False)
class Material:
    """How a surface looks; shared between models, so compare by identity."""

    rgba: tuple[float, float, float, float]
    """Colour in [0, 1], which multiplies the texture; alpha below 1 is seen through."""
    texture: NDArray[np.uint8] | None = None
    """Picture (height, width, 3 or 4), first row at the top; read-only."""
    emission: float = 0.0
    """Share of its own colour that it gives off, in [0, 1]."""
    shininess: float = 0.1
    """0 is dull, 1 is polished."""

    @property
    def is_clear(self) -> bool:
        """Whether one sees through it."""
        return self.rgba[3] < OPAQUE_FROM


@dataclass(frozen=True, slots=True)
class ColourWords:
    """What `colours.json` says of colour words."""

    colours: Mapping[str, Rgb]
    tones: Mapping[str, float]
    """Words before a colour, with the factor by which they change it."""
    woods: frozenset[str]
    """Colours that wood has."""


@cache
def colour_words() -> ColourWords:
    """Return the colour words that are known; read once."""
    return read_table("colours.json", ColourWords)


@cache
def colours_of(words: str | None) -> tuple[Rgb, ...]:
    """Return the colours that words such as `dark blue and white` name, in order.

    Empty where no word is known.
    """
    known = colour_words()
    found: list[Rgb] = []
    tone = 1.0
    for word in re.findall(r"[a-z]+", (words or "").lower()):
        if word in known.tones:
            tone = known.tones[word]
        elif word in known.colours:
            # A noun before a colour, as in "stone grey", only says which grey.
            if found and word in {"grey", "gray"} and "stone" in (words or "").lower():
                continue
            found.append(shade(known.colours[word], tone))
            tone = 1.0
    return tuple(found)


def is_wooden(words: str | None) -> bool:
    """Return whether colour words name wood."""
    return any(
        word in colour_words().woods
        for word in re.findall(r"[a-z]+", (words or "").lower())
    )


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


def srgb(light: Sequence[float]) -> Rgb:
    """Return a colour from shares of light, which formats of meshes have."""
    red, green, blue = (
        12.92 * each if each <= 0.0031308 else 1.055 * each ** (1 / 2.4) - 0.055
        for each in light
    )
    return red, green, blue


def paint(colour: Rgb, shininess: float = DULL) -> Material:
    """Return a plain painted surface, dull or polished, whichever is nearer."""
    return _paint(colour, POLISHED if shininess >= 0.3 else DULL)


@cache
def _paint(colour: Rgb, shininess: float) -> Material:
    return Material((*colour, 1.0), shininess=shininess)


def metal(colour: Rgb) -> Material:
    """Return a polished surface."""
    return paint(colour, POLISHED)


@cache
def glow(colour: Rgb, strength: float = 0.8) -> Material:
    """Return a surface that shines by itself."""
    return Material((*colour, 1.0), emission=strength)


@cache
def glass(tint: Rgb = (0.75, 0.88, 0.92), alpha: float = 0.28) -> Material:
    """Return a pane that is seen through."""
    return Material((*tint, alpha), shininess=0.8)


def picture(pixels: NDArray[np.uint8], emission: float = 0.0) -> Material:
    """Return a surface that shows a picture; the array becomes read-only."""
    pixels.flags.writeable = False
    return Material((1.0, 1.0, 1.0, 1.0), pixels, emission)


@cache
def wood(colour: Rgb) -> Material:
    """Return wood with its grain along the picture's width."""
    return picture(grain(colour))


@cache
def grain(colour: Rgb) -> NDArray[np.uint8]:
    """Return a picture of wood, (128, 256, 3)."""
    rng = np.random.default_rng(5)
    across = np.linspace(0, 1, 128)[:, None]
    along = np.linspace(0, 1, 256)[None, :]
    bent = across + 0.025 * np.sin(2 * np.pi * (along * 1.3 + across * 0.7))
    rings = 0.5 + 0.5 * np.sin(2 * np.pi * bent * 17 + 2 * np.sin(9 * bent))
    fibres = rng.normal(0, 1, (128, 1)) + 0.5 * rng.normal(0, 1, (128, 256))
    tone = 1 - 0.16 * rings + 0.025 * fibres
    seams = (np.arange(128) % 64 < 1)[:, None] * 0.18
    pixels = np.array(colour) * (tone - seams)[:, :, None]
    return (255 * np.clip(pixels, 0, 1)).astype(np.uint8)
