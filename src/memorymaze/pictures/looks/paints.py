"""Materials that things share, made once per process."""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.object_model import Material

DULL, POLISHED = 0.1, 0.5
"""The two degrees of shininess of paints: few, so that they can be drawn at once."""


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
