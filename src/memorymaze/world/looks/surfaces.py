"""Floors, walls and ceilings: pictures of one bay, made by code with fixed seeds.

A picture covers a bay of 2.4 m (a wall's also the whole height of the room) and
repeats. The light of the lamp in the middle of the bay is painted in, and so is the
shade near floor and ceiling, because the renderer has neither.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, zoom

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.world.looks.materials import Material

PIXELS = 512
"""Edge of every picture."""
DADO = 1.05
"""Metres up to which long empty walls have panels."""


@cache
def solid(
    red: float, green: float, blue: float, alpha: float = 1.0, emission: float = 0.0
) -> Material:
    """Return a plain colour."""
    return Material((red, green, blue, alpha), None, emission, 0.1)


@cache
def floor(name: str) -> Material:
    """Return a floor covering by its name in the plan."""
    rng = np.random.default_rng(11)
    makers = {
        "carpet": _carpet,
        "linoleum": _linoleum,
        "wood": _parquet,
        "concrete": _screed,
        "tile": _tiles,
    }
    glossy = {"carpet": 0.05, "linoleum": 0.1, "wood": 0.13, "concrete": 0.08}
    picture = (
        makers[name](rng) * _lamp_glow(glossy.get(name, 0.14))[np.newaxis, :, None]
    )
    return Material((1, 1, 1, 1), _bytes(picture), 0.0, 0.2)


@cache
def wall(name: str) -> Material:
    """Return a wall by its name in the plan; what is solid of it, where it is glass."""
    rng = np.random.default_rng(12)
    makers = {
        "plaster": _plaster,
        "glass": _plaster,
        "wood_panel": _wood_panels,
        "brick": _bricks,
        "concrete": _cast_concrete,
    }
    height = (np.arange(PIXELS) + 0.5) / PIXELS
    # Rows from the top: darker right under the ceiling and above the floor.
    shade = 1 - 0.16 * np.exp(-height / 0.05) - 0.2 * np.exp(-(1 - height) / 0.07)
    shade *= 1.03 - 0.1 * height
    # A lamp lights the wall in an arch below it.
    across = np.cos(2 * np.pi * ((np.arange(PIXELS) + 0.5) / PIXELS - 0.5))
    arch = 0.09 * across[None, :] * np.exp(-height / 0.45)[:, None]
    picture = makers[name](rng) * (shade[:, None] * (1 + arch))[:, :, None]
    return Material((1, 1, 1, 1), _bytes(picture), 0.0, 0.1)


@cache
def ceiling(kind: str) -> Material:
    """Return a ceiling: `panels` of 0.6 m, or `high`, dark slats over large halls."""
    rng = np.random.default_rng(13)
    picture = _ceiling_panels(rng) if kind == "panels" else _slats(rng)
    return Material(
        (1, 1, 1, 1), _bytes(picture * _lamp_glow(0.06)[None, :, None]), 0.0, 0.0
    )


@cache
def foot_shade() -> Material:
    """Return the shade on the floor along a wall: dark at the top of its picture."""
    alpha = 0.34 * (1 - np.linspace(0, 1, 64)) ** 2
    pixels = np.zeros((64, 8, 4))
    pixels[:, :, 3] = alpha[:, None]
    return Material((1, 1, 1, 0.99), _bytes(pixels), 0.0, 0.0)


@cache
def panelling(height: float) -> Material:
    """Return what dresses a bay of a long empty wall: panels, a rail, light from above.

    It is laid over the wall, with nothing in it that one would call a thing.
    """
    rows = (np.arange(PIXELS)[::-1, None] + 0.5) / PIXELS * height
    columns = (np.arange(PIXELS // 2)[None, :] + 0.5) / (PIXELS // 2)
    dark = np.where((rows > 0.09) & (rows < DADO), 0.15, 0.0) + 0 * columns
    joints = np.abs((2 * columns) % 1.0 - 0.5) > 0.495
    dark = np.maximum(dark, np.where(joints & (rows < DADO), 0.34, 0.0))
    dark = np.maximum(dark, np.where(np.abs(rows - DADO) < 0.035, 0.42, 0.0))
    seams = np.abs(columns - 0.5) > 0.497
    for seam in np.arange(DADO + 1.3, height - 0.3, 1.3):
        seams = seams | (np.abs(rows - seam) < 0.008)
    dark = np.maximum(dark, np.where(seams & (rows > DADO), 0.16, 0.0))
    spread = 0.12 + 0.22 * np.maximum(height - rows, 0.0)
    light = np.exp(-(((columns - 0.5) / spread) ** 2)) * np.exp(-(height - rows) / 0.7)
    light = np.where(rows > DADO + 0.1, 0.4 * light, 0.0)
    pixels = np.zeros((PIXELS, PIXELS // 2, 4))
    pixels[:, :, :3] = np.where((light > dark)[:, :, None], 1.0, (0.22, 0.16, 0.11))
    pixels[:, :, 3] = np.maximum(light, dark)
    return Material((1, 1, 1, 0.99), _bytes(pixels), 0.0, 0.0)


@cache
def blob_shadow() -> Material:
    """Return the soft round shadow under a thing, its picture as large as the shadow."""
    rows, columns = np.mgrid[-1:1:64j, -1:1:64j]
    # A rounded square: things are boxes more often than balls.
    distance = (np.abs(rows) ** 3 + np.abs(columns) ** 3) ** (1 / 3)
    alpha = 0.5 * np.clip((1 - distance) / 0.45, 0, 1) ** 1.4
    pixels = np.zeros((64, 64, 4))
    pixels[:, :, 3] = alpha
    return Material((1, 1, 1, 0.99), _bytes(pixels), 0.0, 0.0)


@cache
def facade() -> Material:
    """Return an outer wall: a storey's height of it, with a window in the middle."""
    rng = np.random.default_rng(15)
    picture = _colour(0.78, 0.75, 0.70) + 0.02 * _grain(rng, 1.0)[:, :, None]
    for joint in range(0, PIXELS, PIXELS // 4):
        picture[:, joint : joint + 2] *= 0.86
        picture[joint : joint + 2] *= 0.86
    low, high = int(0.24 * PIXELS), int(0.70 * PIXELS)
    left, right = int(0.22 * PIXELS), int(0.78 * PIXELS)
    picture[low - 10 : high + 14, left - 10 : right + 10] = (0.34, 0.35, 0.37)
    sky = np.linspace(0.78, 0.46, high - low)[:, None, None]
    picture[low:high, left:right] = sky * np.array([0.80, 0.93, 1.0])
    blind = int(low + 0.3 * (high - low))
    picture[low:blind, left : (left + right) // 2] = (0.80, 0.79, 0.75)
    middle = (left + right) // 2
    picture[low:high, middle - 5 : middle + 5] = (0.34, 0.35, 0.37)
    picture[high + 6 : high + 14, left - 14 : right + 14] = (0.86, 0.85, 0.82)
    return Material((1, 1, 1, 1), _bytes(picture), 0.0, 0.0)


@cache
def dim_wall() -> Material:
    """Return the side wall of a room whose lights are off."""
    return Material((0.44, 0.43, 0.42, 1.0), None, 0.0, 0.0)


@cache
def dim_view() -> Material:
    """Return the far end of a room whose lights are off: shelves, a board, a desk."""
    rng = np.random.default_rng(14)
    picture = _colour(0.42, 0.41, 0.40) * np.linspace(1.0, 0.72, PIXELS)[:, None, None]
    pixel = PIXELS / 2.6
    for left in (0.06, 0.56):
        x0, x1 = int(left * PIXELS), int((left + 0.22) * PIXELS)
        top = int(PIXELS - 1.9 * pixel)
        picture[top:, x0:x1] = (0.20, 0.17, 0.14)
        for shelf in range(5):
            y = top + int((0.05 + 0.37 * shelf) * pixel)
            x = x0 + 4
            while x < x1 - 8:
                wide = int(rng.integers(4, 9))
                tall = int(rng.uniform(0.18, 0.30) * pixel)
                bottom = y + int(0.33 * pixel)
                book = rng.uniform(0.14, 0.40, 3)
                picture[bottom - tall : bottom, x : min(x + wide, x1 - 4)] = book
                x += wide + 1
    x0, x1 = int(0.33 * PIXELS), int(0.50 * PIXELS)
    y0, y1 = int(PIXELS - 1.9 * pixel), int(PIXELS - 1.1 * pixel)
    picture[y0:y1, x0:x1] = (0.56, 0.57, 0.57)
    picture[
        int(PIXELS - 0.75 * pixel) : int(PIXELS - 0.68 * pixel), x0 - 20 : x1 + 20
    ] = 0.3
    picture[int(PIXELS - 0.68 * pixel) :, x0 - 10 : x0 - 2] = 0.2
    picture[int(PIXELS - 0.68 * pixel) :, x1 + 2 : x1 + 10] = 0.2
    return Material((1, 1, 1, 1), _bytes(gaussian_filter(picture, (1.2, 1.2, 0))), 0, 0)


def _bytes(picture: FloatArray) -> NDArray[np.uint8]:
    pixels = np.round(np.clip(picture, 0, 1) * 255).astype(np.uint8)
    pixels.setflags(write=False)
    return pixels


def _lamp_glow(strength: float) -> FloatArray:
    """Brightness along a bay with its lamp in the middle."""
    along = (np.arange(PIXELS) + 0.5) / PIXELS
    return 1 + strength * np.cos(2 * np.pi * (along - 0.5))


def _colour(red: float, green: float, blue: float) -> FloatArray:
    return np.full((PIXELS, PIXELS, 3), (red, green, blue))


def _grain(rng: np.random.Generator, size: float) -> FloatArray:
    """Noise in about [-1, 1] that repeats, its spots about `size` pixels large."""
    noise = gaussian_filter(
        rng.standard_normal((PIXELS, PIXELS)), size, mode="wrap", truncate=3
    )
    return noise / (3 * noise.std())


def _streaks(rng: np.random.Generator, tall: float, wide: float) -> FloatArray:
    """Noise in about [-1, 1] that repeats, drawn out along rows or columns."""
    noise = rng.standard_normal((PIXELS, PIXELS))
    streaks = np.asarray(gaussian_filter(noise, (tall, wide), mode="wrap"))
    return streaks / (3 * streaks.std())


def _clouds(rng: np.random.Generator, cells: int) -> FloatArray:
    """Large soft spots in about [-1, 1] that repeat."""
    coarse = rng.standard_normal((cells, cells))
    noise = np.asarray(
        zoom(coarse, PIXELS // cells, order=3, mode="grid-wrap", grid_mode=True)
    )
    return noise / (3 * noise.std())


def _carpet(rng: np.random.Generator) -> FloatArray:
    # Carpet tiles of 0.6 m, laid crosswise, in a mottled grey-blue.
    picture = _colour(0.36, 0.40, 0.46)
    fibre = 0.6 * _grain(rng, 0.7) + 0.5 * _grain(rng, 2)
    edge = PIXELS // 4
    for row in range(4):
        for column in range(4):
            cell = (
                slice(row * edge, (row + 1) * edge),
                slice(column * edge, (column + 1) * edge),
            )
            tone = 0.97 if (row + column) % 2 else 1.03
            picture[cell] *= tone + 0.008 * rng.standard_normal()
            stripes = np.sin(np.arange(edge) * 2 * np.pi / 8) * 0.02
            lines = stripes[:, None] if (row + column) % 2 else stripes[None, :]
            picture[cell] += lines[:, :, None]
    picture += 0.16 * fibre[:, :, None] * np.array([1, 1, 1.05])
    flecks = _grain(rng, 1.2) > 0.75
    picture[flecks] += (0.12, 0.09, 0.02)
    return picture


def _linoleum(rng: np.random.Generator) -> FloatArray:
    picture = _colour(0.70, 0.70, 0.64)
    picture += 0.05 * _clouds(rng, 16)[:, :, None] + 0.03 * _clouds(rng, 64)[:, :, None]
    chips = _grain(rng, 1.0)
    picture[chips > 0.7] = (0.50, 0.52, 0.50)
    picture[chips < -0.75] = (0.84, 0.84, 0.80)
    return gaussian_filter(picture, (0.6, 0.6, 0), mode="wrap")


def _parquet(rng: np.random.Generator) -> FloatArray:
    # Boards of 0.12 m by 1.2 m along the bay, each row shifted.
    picture = _colour(0.64, 0.46, 0.29)
    rows = 20
    streaks = _streaks(rng, 0.8, 28)
    for row in range(rows):
        top, bottom = row * PIXELS // rows, (row + 1) * PIXELS // rows
        shift = int(rng.integers(PIXELS))
        for half in range(2):
            columns = (np.arange(PIXELS // 2) + shift + half * PIXELS // 2) % PIXELS
            tone = 1 + 0.09 * rng.standard_normal()
            block = picture[top:bottom]
            block[:, columns] *= np.array([tone, tone * 0.99, tone * 0.96])
            block[:, columns[0]] *= 0.72
            picture[top:bottom] = block
        picture[top] *= 0.74
    return picture * (1 + 0.2 * streaks[:, :, None])


def _screed(rng: np.random.Generator) -> FloatArray:
    picture = _colour(0.60, 0.60, 0.59)
    picture += 0.06 * _clouds(rng, 8)[:, :, None] + 0.04 * _clouds(rng, 32)[:, :, None]
    picture += 0.04 * _grain(rng, 0.8)[:, :, None]
    picture[:3] *= 0.75
    picture[:, :3] *= 0.75
    return picture


def _tiles(rng: np.random.Generator) -> FloatArray:
    # Stone tiles of 0.6 m with narrow joints.
    picture = _colour(0.80, 0.77, 0.71)
    edge = PIXELS // 4
    veins = np.abs(_clouds(rng, 16) + 0.5 * _clouds(rng, 32))
    picture += 0.05 * _clouds(rng, 8)[:, :, None]
    picture -= 0.10 * np.exp(-veins / 0.05)[:, :, None] * np.array([0.8, 0.9, 1.0])
    for row in range(4):
        for column in range(4):
            cell = (
                slice(row * edge, (row + 1) * edge),
                slice(column * edge, (column + 1) * edge),
            )
            picture[cell] *= 1 + 0.022 * rng.standard_normal()
    picture += 0.02 * _grain(rng, 0.8)[:, :, None]
    for joint in range(0, PIXELS, edge):
        picture[joint : joint + 2] = (0.56, 0.54, 0.50)
        picture[:, joint : joint + 2] = (0.56, 0.54, 0.50)
    return picture


def _plaster(rng: np.random.Generator) -> FloatArray:
    picture = _colour(0.90, 0.88, 0.83)
    picture += 0.012 * _clouds(rng, 16)[:, :, None]
    return picture + 0.014 * _grain(rng, 1.0)[:, :, None]


def _wood_panels(rng: np.random.Generator) -> FloatArray:
    # Panels of 0.8 m with dark joints and upright grain.
    picture = _colour(0.60, 0.41, 0.25)
    streaks, waves = _streaks(rng, 36, 1.0), _streaks(rng, 50, 7)
    picture *= 1 + 0.16 * streaks[:, :, None] + 0.14 * waves[:, :, None]
    for panel in range(3):
        left, right = panel * PIXELS // 3, (panel + 1) * PIXELS // 3
        picture[:, left:right] *= 1 + 0.05 * rng.standard_normal()
        picture[:, left : left + 2] *= 0.45
        picture[:, left + 2] *= 1.12
    middle = int(PIXELS * 0.62)
    picture[middle : middle + 2] *= 0.55
    return picture


def _bricks(rng: np.random.Generator) -> FloatArray:
    # Stretchers of 0.24 m; the number of courses suits a room about 3 m high.
    courses, across = 40, 10
    picture = _colour(0.72, 0.68, 0.62)
    for course in range(courses):
        top = course * PIXELS // courses
        bottom = (course + 1) * PIXELS // courses
        shift = (course % 2) * PIXELS // across // 2
        for brick in range(across):
            left = brick * PIXELS // across + shift
            width = PIXELS // across - 2
            columns = (left + np.arange(width)) % PIXELS
            tone = 1 + 0.12 * rng.standard_normal()
            hue = 0.03 * rng.standard_normal()
            colour = np.array([0.60 + hue, 0.32, 0.24]) * tone
            picture[top : bottom - 2, columns] = colour
    return picture * (1 + 0.12 * _grain(rng, 1.0)[:, :, None])


def _cast_concrete(rng: np.random.Generator) -> FloatArray:
    # Shuttering panels of 1.2 m with tie holes.
    picture = _colour(0.66, 0.66, 0.65)
    picture += 0.05 * _clouds(rng, 8)[:, :, None] + 0.03 * _clouds(rng, 32)[:, :, None]
    picture += 0.03 * _grain(rng, 0.9)[:, :, None]
    half = PIXELS // 2
    for joint in (0, half):
        picture[:, joint : joint + 2] *= 0.72
        picture[joint : joint + 2] *= 0.8
    rows, columns = np.mgrid[0:PIXELS, 0:PIXELS]
    for y in (PIXELS // 8, 3 * PIXELS // 8, 5 * PIXELS // 8, 7 * PIXELS // 8):
        for x in (PIXELS // 8, 3 * PIXELS // 8, 5 * PIXELS // 8, 7 * PIXELS // 8):
            hole = np.hypot(rows - y, columns - x) < 3.5
            picture[hole] *= 0.55
    return picture


def _ceiling_panels(rng: np.random.Generator) -> FloatArray:
    picture = _colour(0.88, 0.88, 0.86)
    pores = _grain(rng, 0.8)
    picture[pores > 0.8] *= 0.86
    edge = PIXELS // 4
    for joint in range(0, PIXELS, edge):
        picture[joint : joint + 3] = (0.97, 0.97, 0.96)
        picture[:, joint : joint + 3] = (0.97, 0.97, 0.96)
        picture[joint + 3] *= 0.8
        picture[:, joint + 3] *= 0.8
    return picture


def _slats(rng: np.random.Generator) -> FloatArray:
    # Light slats of 0.1 m before a darker void, for halls with high ceilings.
    picture = _colour(0.34, 0.34, 0.36)
    pitch = PIXELS // 16
    for slat in range(16):
        top = slat * pitch
        tone = 0.80 + 0.02 * rng.standard_normal()
        picture[top : top + int(pitch * 0.72)] = (tone, tone, tone * 0.98)
        picture[top] *= 0.85
    return picture
