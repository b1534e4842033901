"""A furniture model for a thing of a plan: the best fitting one, stretched, painted."""

import math
from pathlib import Path

import numpy as np

from memorymaze.pictures.furniture.cache import (
    Credit,
    area_of,
    cache_folder,
    credits_in,
    load_model,
)
from memorymaze.pictures.furniture.choice import SIDEWAYS, UNPAINTED
from memorymaze.pictures.looks.assembly import MeshPart, ObjectModel, Order
from memorymaze.pictures.looks.materials import Material, Rgb, colours_of

MOST_STRETCH = 1.8
"""A model may become this much longer in one direction, compared with another."""
NEARLY = 1.2
"""Models that are stretched this much more than the best one are as good as it."""


def furniture_for(
    archetype: str, order: Order, folder: Path | None = None
) -> ObjectModel | None:
    """Return a converted model that fills the box of a thing exactly.

    Args:
        archetype: What the thing is, of `looks.catalogue`.
        order: Its size, colour and variant.
        folder: With converted models; None for the user's cache.

    Returns:
        The model; None where there is none, none has about the thing's proportions,
        or words have to stand on it.
    """
    folder = folder or cache_folder()
    pieces = credits_in(folder).get(archetype, ())
    if order.text or not pieces:
        return None
    sideways = archetype in SIDEWAYS
    stretched = sorted(
        (_stretch(each, order, sideways=sideways), number)
        for number, each in enumerate(pieces)
    )
    best = stretched[0][0]
    if best > MOST_STRETCH:
        return None
    good = [
        pieces[n] for how, n in stretched if how <= min(best * NEARLY, MOST_STRETCH)
    ]
    colour = next(iter(colours_of(order.colour_words)), None)
    if colour is None or archetype not in UNPAINTED:
        piece = good[order.variant % len(good)]
    else:
        piece = min(good, key=lambda each: math.dist(each.colour, colour))
    model = load_model(folder, piece.id)
    if sideways:
        model = _turned(model)
    model = _filling(model, order)
    if colour is not None and archetype not in UNPAINTED:
        model = _painted(model, colour)
    return model


def _stretch(piece: Credit, order: Order, *, sideways: bool) -> float:
    length, depth, height = piece.size
    if sideways:
        length, depth = depth, length
    ratios = (order.length / length, order.depth / depth, order.height / height)
    return max(ratios) / min(ratios)


def _turned(model: ObjectModel) -> ObjectModel:
    """Turn a model so that its left side faces the front."""
    to_right = np.array(((0, 1, 0), (-1, 0, 0), (0, 0, 1)), dtype=np.float32)
    return _moved(model, to_right, to_right, np.zeros(3, dtype=np.float32))


def _filling(model: ObjectModel, order: Order) -> ObjectModel:
    low, high = model.bounds()
    size = np.array((order.depth, order.length, order.height))
    scale = size / np.maximum(high - low, 1e-9)
    corner = np.array((-order.depth / 2, -order.length / 2, 0.0))
    return _moved(model, np.diag(scale), np.diag(1 / scale), corner - low * scale)


def _moved(
    model: ObjectModel, shape: np.ndarray, normals: np.ndarray, shift: np.ndarray
) -> ObjectModel:
    parts: list[MeshPart] = []
    for part in model.parts:
        assert part.normals is not None
        turned = part.normals @ normals.T
        turned /= np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-12)
        vertices = (part.vertices @ shape.T + shift).astype(np.float32)
        turned = turned.astype(np.float32)
        vertices.flags.writeable = turned.flags.writeable = False
        parts.append(MeshPart(vertices, part.faces, turned, part.uv, part.material))
    return ObjectModel(tuple(parts))


def _painted(model: ObjectModel, colour: Rgb) -> ObjectModel:
    """Give the largest part a colour; light and dark of its picture remain."""
    main = max(model.parts, key=area_of)
    texture = main.material.texture
    if texture is None:
        paint = Material((*colour, main.material.rgba[3]))
    else:
        light = texture.astype(np.float64).mean(axis=2, keepdims=True)
        light /= max(float(light.mean()), 1.0)
        pixels = np.clip(255 * light * np.array(colour), 0, 255).astype(np.uint8)
        pixels.flags.writeable = False
        paint = Material(main.material.rgba, pixels)
    return ObjectModel(
        tuple(
            MeshPart(part.vertices, part.faces, part.normals, part.uv, paint)
            if part is main
            else part
            for part in model.parts
        )
    )
