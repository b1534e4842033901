"""Pictures of places: the earth, other planets, floor plans."""

from functools import cache

import numpy as np
from PIL import Image, ImageDraw

from memorymaze.pictures.looks.boards import Pixels, blank, pixels_of, whole
from memorymaze.pictures.looks.colours import Rgb, ink_on, rgb255, shade
from memorymaze.simulation.senses.lettering import Field, write

SEA: Rgb = (0.14, 0.36, 0.66)
LAND: Rgb = (0.28, 0.52, 0.24)
ICE: Rgb = (0.93, 0.95, 0.96)
# Coarse outlines in degrees east and north, drawn by hand.
CONTINENTS: tuple[tuple[tuple[int, int], ...], ...] = (
    (
        (-165, 62), (-156, 71), (-120, 70), (-95, 72), (-82, 64), (-94, 58), (-80, 52),
        (-65, 60), (-56, 52), (-70, 43), (-81, 31), (-81, 25), (-90, 30), (-97, 26),
        (-96, 19), (-88, 21), (-84, 10), (-79, 8), (-95, 15), (-106, 21), (-117, 32),
        (-124, 42), (-130, 54), (-150, 60),
    ),
    (
        (-78, 8), (-62, 10), (-50, 1), (-35, -6), (-40, -21), (-48, -27), (-58, -38),
        (-66, -46), (-69, -54), (-74, -48), (-71, -18), (-81, -5),
    ),
    (
        (-10, 36), (-9, 43), (-1, 44), (-4, 48), (8, 54), (11, 58), (5, 59), (14, 67),
        (26, 71), (42, 66), (60, 69), (75, 73), (105, 77), (140, 73), (180, 68), (162, 60),
        (156, 52), (140, 54), (128, 40), (121, 39), (121, 29), (108, 21), (108, 11),
        (103, 2), (98, 14), (90, 22), (80, 14), (77, 8), (72, 20), (60, 25), (48, 30),
        (58, 18), (44, 13), (35, 29), (36, 36), (27, 37), (19, 42), (12, 45), (17, 39),
        (8, 44), (0, 39),
    ),
    (
        (-6, 35), (10, 37), (32, 31), (43, 12), (51, 11), (40, -4), (40, -16), (32, -28),
        (20, -35), (12, -18), (13, -6), (8, 4), (-8, 5), (-17, 14), (-13, 27),
    ),
    (
        (114, -22), (122, -17), (131, -12), (137, -15), (142, -11), (147, -20), (153, -28),
        (150, -37), (140, -38), (130, -32), (116, -35),
    ),
    ((-55, 60), (-44, 60), (-22, 70), (-20, 80), (-45, 83), (-68, 77)),
    ((130, 31), (135, 34), (140, 36), (141, 42), (145, 44), (141, 45), (139, 38), (132, 35)),
    ((-5, 50), (1, 52), (-2, 57), (-6, 58), (-3, 54)),
    ((44, -25), (48, -15), (50, -16), (47, -25)),
    ((95, 5), (106, -6), (118, -9), (119, 4), (109, 1), (104, -2)),
    ((132, -1), (141, -3), (150, -10), (141, -9)),
    ((167, -46), (173, -35), (178, -38), (172, -43)),
    ((-180, -73), (-60, -68), (0, -70), (100, -66), (180, -73), (180, -90), (-180, -90)),
)  # fmt: skip


@cache
def earth(sea: Rgb = SEA, land: Rgb = LAND) -> Pixels:
    """Return the earth's surface to wrap round a ball, (256, 512, 3)."""
    image = Image.new("RGB", (512, 256), rgb255(sea))
    _draw_continents(image, whole(image), land)
    draw = ImageDraw.Draw(image)
    draw.rectangle([0, 0, 512, 9], rgb255(ICE))
    return pixels_of(image)


@cache
def world_map(width: float, height: float, text: str, sea: Rgb, land: Rgb) -> Pixels:
    """Return a map of the world with its words above it."""
    image = blank(width, height, shade(sea, 1.25) if sea != land else SEA)
    everything = whole(image)
    top = 0.2 * image.height if text else 0.0
    _draw_continents(image, Field(0, top, everything.right, everything.bottom), land)
    draw = ImageDraw.Draw(image)
    for step in range(1, 8):
        x = image.width * step / 8
        draw.line([x, top, x, image.height], rgb255(shade(sea, 1.5)), 1)
    if text:
        draw.rectangle([0, 0, image.width, top], rgb255((0.96, 0.96, 0.94)))
        write(image, Field(0, 0, image.width, top).inset(0.14), text, (0.06, 0.08, 0.2))
    return pixels_of(image)


@cache
def planet(colour: Rgb, *, banded: bool, variant: int = 0) -> Pixels:
    """Return a planet's surface to wrap round a ball: cloud bands or craters."""
    rng = np.random.default_rng(variant + 41)
    image = Image.new("RGB", (256, 128), rgb255(colour))
    draw = ImageDraw.Draw(image)
    if banded:
        for row in range(0, 128, 8):
            tone = shade(colour, float(rng.uniform(0.7, 1.5)))
            draw.rectangle([0, row, 256, row + int(rng.integers(3, 9))], rgb255(tone))
        draw.ellipse([140, 74, 172, 90], rgb255((0.72, 0.3, 0.16)))
    else:
        for x, y, r in rng.random((70, 3)):
            size = 1.5 + 9 * r**3
            tone = rgb255(shade(colour, float(rng.uniform(0.72, 1.2))))
            u, v = 10 + 236 * x, 12 + 104 * y
            draw.ellipse([u - size, v - size, u + size, v + size], tone)
    return pixels_of(image)


@cache
def floor_map(
    width: float, height: float, text: str, ground: Rgb, variant: int
) -> Pixels:
    """Return a floor plan to find one's way by, its words above it, and a red dot."""
    image = blank(width, height, ground)
    rng = np.random.default_rng(variant + 17)
    draw = ImageDraw.Draw(image)
    field = whole(image).inset(0.05)
    top = field.top + (0.3 * field.height if text else 0.0)
    write(
        image, Field(field.left, field.top, field.right, top - 4), text, ink_on(ground)
    )
    inks: list[Rgb] = [
        (0.62, 0.79, 0.9), (0.95, 0.83, 0.55), (0.73, 0.86, 0.65), (0.93, 0.7, 0.68),
    ]  # fmt: skip
    columns, rows = 6, 3
    w, h = field.width / columns, (field.bottom - top) / rows
    for column in range(columns):
        for row in range(rows):
            x, y = field.left + column * w, top + row * h
            grow = 0.0 if rng.random() < 0.6 else 0.12
            room = [x + 0.08 * w, y + 0.1 * h, x + (0.86 + grow) * w, y + 0.86 * h]
            fill = inks[int(rng.integers(len(inks)))]
            draw.rectangle(room, rgb255(fill), rgb255((0.25, 0.27, 0.3)), 2)
    x, y = field.left + 2.93 * w, top + 1.93 * h
    r = 0.16 * min(w, h)
    draw.ellipse([x - r, y - r, x + r, y + r], rgb255((0.86, 0.08, 0.08)))
    return pixels_of(image)


def _draw_continents(image: Image.Image, field: Field, land: Rgb) -> None:
    draw = ImageDraw.Draw(image)
    for outline in CONTINENTS:
        points = [
            (
                field.left + (east + 180) / 360 * field.width,
                field.top + (90 - north) / 180 * field.height,
            )
            for east, north in outline
        ]
        frozen = min(north for _, north in outline) < -80 or outline[0] == (-55, 60)
        draw.polygon(points, rgb255(ICE if frozen else land))
