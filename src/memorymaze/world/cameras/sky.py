"""The sky and the town around a building, as the six faces of a cube; made by code."""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.materials import Material

PIXELS = 512
"""Edge of each face."""
FACES = ("right", "left", "up", "down", "front", "back")
"""Order in which the physics engine wants them."""
SKY_DISTANCE = 99.9
"""Metres from the camera to the dome; what is farther away is behind it."""
DOME_CELLS = 8
"""Quads along an edge of each face of the dome."""
HORIZON = np.array([0.86, 0.90, 0.93])
ZENITH = np.array([0.42, 0.62, 0.86])


@cache
def sky_faces() -> tuple[NDArray[np.uint8], ...]:
    """Return the pictures (512, 512, 3), in the order of `FACES`."""
    outline = _skyline(np.random.default_rng(21))
    clouds = _clouds(np.random.default_rng(22))
    edge = (np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1
    across, down = np.meshgrid(edge, edge)
    directions = _directions(across, down)
    return tuple(
        _face(*directions[name], outline=outline, clouds=clouds) for name in FACES
    )


def sky_dome() -> list[MeshPart]:
    """Return the sky as a dome around the origin, seen from inside, z up.

    In software OpenGL it costs a tenth of the engine's own sky, because only the pixels
    that nothing stands in front of are drawn.
    """
    edge = np.linspace(-1, 1, DOME_CELLS + 1)
    across, down = (grid.ravel() for grid in np.meshgrid(edge, edge))
    inset = 1 - 1 / PIXELS
    uv = np.column_stack([across, down]) * inset / 2 + 0.5
    corner = np.arange((DOME_CELLS + 1) ** 2).reshape(DOME_CELLS + 1, -1)
    a, b, c, d = (
        part.ravel()
        for part in (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:])
    )
    faces = np.concatenate([np.column_stack([a, c, b]), np.column_stack([a, d, c])])
    parts: list[MeshPart] = []
    directions = _directions(across, down)
    for name, pixels in zip(FACES, sky_faces(), strict=True):
        x, y, z = directions[name]
        outward = np.column_stack([x, -z, y])
        outward /= np.linalg.norm(outward, axis=1, keepdims=True)
        parts.append(
            MeshPart(
                (outward * SKY_DISTANCE).astype(np.float32),
                faces.astype(np.int32),
                (-outward).astype(np.float32),
                uv.astype(np.float32),
                Material((1.0, 1.0, 1.0, 1.0), pixels, emission=1.0),
            )
        )
    return parts


def _directions(
    across: FloatArray, down: FloatArray
) -> dict[str, tuple[FloatArray, FloatArray, FloatArray]]:
    """Return where each face's pictures lie, by columns and rows in [-1, 1].

    Columns run to the right and rows down as one looks at the face from inside, with
    x to the right, y up and z towards the viewer.
    """
    one = np.ones_like(across)
    return {
        "right": (one, -down, -across),
        "left": (-one, -down, across),
        "up": (across, one, down),
        "down": (across, -one, -down),
        "front": (across, -down, one),
        "back": (-across, -down, -one),
    }


def _face(
    x: FloatArray,
    y: FloatArray,
    z: FloatArray,
    *,
    outline: FloatArray,
    clouds: FloatArray,
) -> NDArray[np.uint8]:
    flat = np.hypot(x, z)
    azimuth = (np.arctan2(z, x) / (2 * np.pi)) % 1.0
    rise = np.arctan2(y, flat)
    share = np.clip(rise / (np.pi / 2), 0, 1)[:, :, None] ** 0.6
    picture = HORIZON * (1 - share) + ZENITH * share
    # Clouds lie on a plane high above.
    height = np.maximum(y / np.maximum(flat, 1e-6), 0.05)
    u = (np.cos(azimuth * 2 * np.pi) / height * 40).astype(int) % len(clouds)
    v = (np.sin(azimuth * 2 * np.pi) / height * 40).astype(int) % len(clouds)
    cover = clouds[u, v] * np.clip((rise - 0.06) / 0.25, 0, 1)
    picture = picture * (1 - cover[:, :, None]) + cover[:, :, None]
    column = (azimuth * len(outline)).astype(int) % len(outline)
    for layer, (haze, tone) in enumerate((
        (0.62, np.array([0.52, 0.57, 0.62])),
        (0.30, np.array([0.44, 0.46, 0.47])),
    )):
        top = outline[column, layer]
        town = (rise < top) & (rise > -0.4)
        body = tone * (1 - haze) + HORIZON * haze
        storeys = np.sin(rise * (900 - 380 * layer)) > 0.3
        axes = np.sin(azimuth * (2600 - 1200 * layer)) > 0.1
        windows = (storeys & axes)[:, :, None] * np.array([0.07, 0.06, 0.04])
        picture = np.where(town[:, :, None], body - windows, picture)
    ground = rise < -0.015
    depth = np.clip(-rise / 0.5, 0, 1)[:, :, None] ** 0.5
    meadow = HORIZON * 0.75 * (1 - depth) + np.array([0.36, 0.42, 0.30]) * depth
    picture = np.where(ground[:, :, None], meadow, picture)
    trees = outline[column, 2]
    wood = (rise < trees) & (rise > -0.10)
    green = (
        np.array([0.27, 0.36, 0.23])
        + 0.03 * np.sin(azimuth * 700 + 60 * rise)[:, :, None]
    )
    picture = np.where(wood[:, :, None], green * 0.75 + HORIZON * 0.22, picture)
    return np.round(np.clip(picture, 0, 1) * 255).astype(np.uint8)


def _skyline(rng: np.random.Generator) -> FloatArray:
    """Return how high far houses, nearer houses and trees rise, by azimuth, radians."""
    columns = 2048
    outline = np.zeros((columns, 3))
    for layer, (lowest, spread, narrow, wide) in enumerate((
        (0.03, 0.10, 8, 34),
        (0.01, 0.06, 22, 70),
    )):
        at = 0
        while at < columns:
            width = int(rng.integers(narrow, wide))
            outline[at : at + width, layer] = lowest + spread * rng.random() ** 2
            at += width
    crowns = gaussian_filter(rng.standard_normal(columns), 9, mode="wrap")
    outline[:, 2] = -0.005 + 0.025 * crowns / crowns.std()
    return outline


def _clouds(rng: np.random.Generator) -> FloatArray:
    noise = np.zeros((256, 256))
    for size in (3.0, 8.0, 20.0):
        spots = gaussian_filter(rng.standard_normal(noise.shape), size, mode="wrap")
        noise += size * spots
    return np.clip((noise / noise.std() - 0.2) * 0.5, 0, 0.85)
