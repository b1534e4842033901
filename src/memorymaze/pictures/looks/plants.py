"""Plants in pots and planters."""

import math

import numpy as np

from memorymaze.geometry.points import FloatArray
from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.materials import Rgb, paint, shade
from memorymaze.pictures.looks.shapes import (
    Shape,
    lathed,
)
from memorymaze.pictures.looks.tubes import plant_leaves, tube

SOIL: Rgb = (0.2, 0.13, 0.08)
GREENS: tuple[Rgb, ...] = ((0.13, 0.42, 0.15), (0.2, 0.52, 0.2), (0.1, 0.33, 0.16))
POTS: tuple[Rgb, ...] = ((0.72, 0.38, 0.25), (0.88, 0.87, 0.84), (0.25, 0.26, 0.28))


def potted_plant(made: Assembly, order: Order) -> None:
    """Build a plant in a pot: broad leaves, a small tree, or long blades."""
    rng = order.rng()
    reach = min(order.length, order.depth) / 2
    pot = min(0.32 * order.height, 0.42)
    wide = reach * 0.72
    made.lathed(
        paint(POTS[order.variant % 3], 0.2),
        [
            (0.72, 0),
            (0.95, 0.85),
            (1, 0.86),
            (1, 1),
            (0.88, 1),
            (0.86, 0.92),
            (0, 0.92),
        ],
        18,
        radius=wide,
        height=pot,
    )
    made.lathed(paint(SOIL, 0.0), [(wide * 0.86, pot * 0.9), (0, pot * 0.96)], 12)
    kind = order.variant % 3
    green = (
        GREENS[kind]
        if order.colour_words in {None, "green"}
        else order.colour(GREENS[0])
    )
    top = order.height
    if kind == 0:
        made.add(paint(green, 0.3), _bush(rng, 46, pot, top, reach))
        stalks = [
            tube(
                [
                    (0, 0, pot * 0.9),
                    (0.05 * math.cos(a), 0.05 * math.sin(a), top * 0.75),
                ],
                0.012,
                5,
            )
            for a in (0.3, 2.4, 4.4)
        ]
        made.add(paint(shade(green, 0.8)), *stalks)
        return
    if kind == 1:
        crown = pot + 0.42 * (top - pot)
        made.tube(
            paint((0.4, 0.28, 0.18)),
            [(0, 0, pot * 0.9), (0.02, 0.01, crown), (0, 0, top * 0.85)],
            [0.03, 0.024, 0.012],
            7,
        )
        made.add(paint(green, 0.3), _bush(rng, 64, crown, top, reach))
        return
    count = 26
    angles = np.arange(count) * 2.4
    spread = np.linspace(0.12, 1.0, count) * reach
    base = np.column_stack([
        0.03 * np.cos(angles),
        0.03 * np.sin(angles),
        np.full(count, pot * 0.9),
    ])
    knee = np.column_stack([
        0.55 * spread * np.cos(angles),
        0.55 * spread * np.sin(angles),
        top - 0.3 * spread - 0.12 * rng.random(count),
    ])
    tip = np.column_stack([
        spread * np.cos(angles),
        spread * np.sin(angles),
        knee[:, 2] - 0.45 * spread + 0.06,
    ])
    widths = np.full(count, 0.22 * reach)
    made.add(
        paint(green, 0.3),
        plant_leaves(base, knee, widths),
        plant_leaves(knee * 0.97 + base * 0.03, tip, widths * 0.8),
    )


def planter(made: Assembly, order: Order) -> None:
    """Build a long tub with a hedge and flowers."""
    rng = order.rng()
    tub = order.height * 0.48
    body = paint(order.colour((0.72, 0.38, 0.25)))
    made.box(body, order.x, order.y, (0, tub), 0.02)
    made.box(
        paint(SOIL, 0.0),
        order.x.inset(0.04),
        order.y.inset(0.04),
        (tub - 0.02, tub + 0.01),
    )
    reach = order.depth / 2
    count = max(2, round(order.length / order.depth))
    for place in range(count):
        y = order.y[0] + order.length * (place + 0.5) / count
        bush = _bush(rng, 34, tub, order.height, reach)
        made.add(paint(GREENS[place % 3], 0.2), bush.moved(y=y))
        for flower in range(3):
            angle = 2.1 * flower + place
            spot = lathed([(0.0, 0), (0.035, 0.02), (0.0, 0.035)], 6)
            tone = (0.9, 0.3, 0.4) if place % 2 else (0.95, 0.85, 0.3)
            made.add(
                paint(tone),
                spot.moved(
                    0.6 * reach * math.cos(angle),
                    y + 0.5 * reach * math.sin(angle),
                    order.height * 0.92,
                ),
            )


def _bush(
    rng: np.random.Generator, count: int, low: float, high: float, reach: float
) -> Shape:
    """Return leaves all round an upright axis."""
    angles = np.arange(count) * 2.399
    up = np.linspace(0.05, 1.0, count)
    outward = np.sqrt(np.clip(1 - (2 * up - 1.05) ** 2, 0.05, 1))
    heading = np.column_stack([np.cos(angles), np.sin(angles)])
    height = low + up * (high - low) * 0.93
    start: FloatArray = np.column_stack([
        heading * (outward * reach * 0.2)[:, None],
        height - 0.1 * (high - low),
    ])
    length = outward * reach * rng.uniform(0.85, 1.0, count)
    drop = rng.uniform(-0.02, 0.1, count) * (high - low)
    end = np.column_stack([heading * length[:, None], np.minimum(height + drop, high)])
    end[-1] = (0.02, 0.0, high)
    start[-1, 2] = high - 0.2 * (high - low)
    return plant_leaves(start, end, 0.32 * reach + 0.16 * length)
