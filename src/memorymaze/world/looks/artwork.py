"""Pictures that things show: paintings, posters, boards, screens and maps."""

from functools import cache

import numpy as np
from PIL import Image, ImageDraw

from memorymaze.world.looks.boards import blank, graded, pixels_of, whole
from memorymaze.world.looks.lettering import Field, write
from memorymaze.world.looks.materials import (
    OCEAN,
    PURE_WHITE,
    Pixels,
    Rgb,
    ink_on,
    mixed,
    rgb255,
    shade,
)
from memorymaze.world.looks.word_lists import read_table

NIGHT: Rgb = (0.04, 0.05, 0.14)
LAND: Rgb = (0.28, 0.52, 0.24)
ICE: Rgb = (0.93, 0.95, 0.96)
_Outline = tuple[tuple[int, int], ...]


@cache
def painting_picture(width: float, height: float, colour: Rgb, variant: int) -> Pixels:
    """Return a painted landscape in tones of a colour, within a mount."""
    image = blank(width, height, (0.93, 0.91, 0.86))
    landscape(image, whole(image).inset(0.08), colour, variant)
    return pixels_of(image)


def landscape(image: Image.Image, field: Field, colour: Rgb, variant: int) -> None:
    """Draw hills under a sky with a sun into a field of a picture."""
    rng = np.random.default_rng(variant + 71)
    width, height = int(field.width), int(field.height)
    left, top = int(field.left), int(field.top)
    sky = graded((width, height), shade(colour, 1.35), shade(colour, 1.8))
    image.paste(sky, (left, top))
    draw = ImageDraw.Draw(image)
    r = 0.1 * min(width, height)
    x, y = left + width * rng.uniform(0.2, 0.8), top + height * 0.28
    draw.ellipse([x - r, y - r, x + r, y + r], rgb255((1.0, 0.93, 0.7)))
    across = np.linspace(0, 1, 60)
    for layer in range(4):
        line = np.full_like(across, 0.42 + 0.15 * layer)
        for _ in range(3):
            swing, pace, phase = rng.uniform((0.02, 3, 0), (0.06, 11, 6))
            line += swing * np.sin(pace * across + phase)
        crest = zip(
            (left + across * (width - 1)).tolist(),
            (top + np.clip(line, 0, 1) * (height - 1)).tolist(),
            strict=True,
        )
        bottom = top + height - 1
        outline = [(left, bottom), *crest, (left + width - 1, bottom)]
        draw.polygon(outline, rgb255(shade(colour, 1.15 - 0.22 * layer)))


def scene_into(image: Image.Image, field: Field, colour: Rgb, variant: int) -> None:
    """Draw a picture of the kind exhibitions show; every variant is another one."""
    rng = np.random.default_rng(variant)
    scene = SCENES[int(rng.integers(len(SCENES)))]
    accent = ACCENTS[int(rng.integers(len(ACCENTS)))]
    # Drawn apart, so that nothing stands out of the field.
    part = Image.new("RGB", (max(8, int(field.width)), max(8, int(field.height))))
    scene(part, mixed(colour, accent, 0.4), rng)
    image.paste(part, (int(field.left), int(field.top)))


def _hills(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    landscape(image, whole(image), colour, int(rng.integers(1 << 30)))


def _planet(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    """Draw a planet with spots or a ring among stars."""
    draw = ImageDraw.Draw(image)
    w, h = image.size
    draw.rectangle([0, 0, w, h], rgb255(NIGHT))
    for x, y in rng.random((60, 2)):
        _disc(draw, x * w, y * h, 1, PURE_WHITE)
    x, y = w * rng.uniform(0.25, 0.75), h * rng.uniform(0.35, 0.65)
    r = min(w, h) * rng.uniform(0.18, 0.4)
    _disc(draw, x, y, r, shade(colour, 1.25))
    for a, b, size in rng.uniform((-0.5, -0.5, 0.1), (0.5, 0.5, 0.3), (4, 3)):
        _disc(draw, x + a * r, y + b * r, size * r, shade(colour, 0.8 + size))
    if rng.random() < 0.5:
        tilt = r * rng.uniform(0.1, 0.5)
        ends = [x - 1.7 * r, y + tilt, x + 1.7 * r, y - tilt]
        draw.line(ends, rgb255(shade(colour, 1.7)), max(2, int(0.08 * r)))


def _waves(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    draw = ImageDraw.Draw(image)
    w, h = image.size
    draw.rectangle([0, 0, w, h], rgb255(shade(colour, 0.45)))
    across = np.linspace(0, 1, 60)
    for row in range(int(rng.integers(2, 6))):
        swing, pace, phase, middle = rng.uniform((0.08, 4, 0, 0.3), (0.3, 22, 6, 0.7))
        wave = middle + swing * np.sin(pace * across + phase)
        line = list(zip((across * w).tolist(), (wave * h).tolist(), strict=True))
        draw.line(line, rgb255(shade(colour, 1.2 + 0.15 * row)), max(2, h // 40))


def _cells(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    draw = ImageDraw.Draw(image)
    w, h = image.size
    draw.rectangle([0, 0, w, h], rgb255(shade(colour, 1.7)))
    for x, y, r in rng.random((int(rng.integers(6, 26)), 3)):
        size = min(w, h) * (0.04 + 0.14 * r)
        _disc(draw, x * w, y * h, size, shade(colour, 0.6 + 0.8 * r))
        _disc(draw, x * w, y * h, 0.3 * size, shade(colour, 0.4))


def _town(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    """Draw rows of houses with lit windows."""
    draw = ImageDraw.Draw(image)
    w, h = image.size
    draw.rectangle([0, 0, w, h], rgb255(shade(colour, 1.6)))
    for row in range(3):
        x = 0.0
        while x < w:
            wide = w * rng.uniform(0.06, 0.16)
            top = h * (0.15 + 0.22 * row + 0.3 * rng.random())
            draw.rectangle([x, top, x + wide, h], rgb255(shade(colour, 1 - 0.28 * row)))
            for a, b in rng.random((4, 2)):
                u, v = x + 0.15 * wide + 0.6 * a * wide, top + 0.1 * h + 0.5 * b * h
                draw.rectangle([u, v, u + 0.1 * wide, v + 3], rgb255((1.0, 0.93, 0.7)))
            x += wide * 1.08


def _layers(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    """Draw layers of rock."""
    draw = ImageDraw.Draw(image)
    w, h = image.size
    across = np.linspace(0, 1, 40)
    phase, swing = rng.uniform(0, 6), rng.uniform(0.02, 0.09)
    top = 0.0
    while top < 1.2:
        edge = (top + swing * np.sin(5 * across + phase + 2 * top)) * h
        line = zip((across * w).tolist(), edge.tolist(), strict=True)
        tone = shade(colour, float(rng.uniform(0.45, 1.7)))
        draw.polygon([(0, h), *line, (w, h)], rgb255(tone))
        top += rng.uniform(0.06, 0.22)


def _orbits(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    draw = ImageDraw.Draw(image)
    w, h = image.size
    draw.rectangle([0, 0, w, h], rgb255(shade(colour, 0.3)))
    x, y = w * rng.uniform(0.3, 0.7), h * rng.uniform(0.3, 0.7)
    count = int(rng.integers(3, 8))
    for ring in range(1, count + 1):
        r = 0.75 * max(w, h) * ring / count
        draw.ellipse([x - r, y - r, x + r, y + r], None, rgb255(shade(colour, 1.2)), 2)
        turn = rng.uniform(0, 2 * np.pi)
        size = min(w, h) * rng.uniform(0.02, 0.06)
        spot = (x + r * np.cos(turn), y + r * np.sin(turn))
        _disc(draw, *spot, size, shade(colour, 1.6))
    _disc(draw, x, y, 0.08 * min(w, h), (1.0, 0.93, 0.7))


def _mosaic(image: Image.Image, colour: Rgb, rng: np.random.Generator) -> None:
    """Draw triangles in tones of a colour."""
    draw = ImageDraw.Draw(image)
    w, h = image.size
    columns = int(rng.integers(3, 8))
    edge = w / columns
    for column in range(columns):
        for row in range(int(h / edge) + 1):
            x, y = column * edge, row * edge
            corners = [(x, y), (x + edge, y), (x + edge, y + edge), (x, y + edge)]
            for first in (0, 2):
                three = [corners[(first + place) % 4] for place in range(3)]
                draw.polygon(three, rgb255(shade(colour, float(rng.uniform(0.4, 1.7)))))


def _disc(draw: ImageDraw.ImageDraw, x: float, y: float, r: float, colour: Rgb) -> None:
    draw.ellipse([x - r, y - r, x + r, y + r], rgb255(colour))


SCENES = (_hills, _planet, _waves, _cells, _town, _layers, _orbits, _mosaic)
ACCENTS: tuple[Rgb, ...] = (
    (0.85, 0.3, 0.2), (0.2, 0.45, 0.8), (0.9, 0.7, 0.2), (0.25, 0.6, 0.35),
    (0.5, 0.3, 0.65), (0.2, 0.6, 0.62), (0.5, 0.5, 0.52),
)  # fmt: skip


@cache
def poster_picture(
    width: float, height: float, text: str, colour: Rgb, variant: int
) -> Pixels:
    """Return a poster: its words large over a picture."""
    image = blank(width, height, colour)
    everything = whole(image)
    cut = everything.top + (0.62 if text else 0.0) * everything.height
    lower = Field(0, cut, everything.right, everything.bottom)
    scene_into(image, lower, mixed(colour, (0.5, 0.5, 0.5), 0.15), variant)
    ImageDraw.Draw(image).rectangle(
        [0, cut - 3, image.width, cut + 3], rgb255(ink_on(colour))
    )
    upper = Field(0, 0, everything.right, cut - 3).inset(0.06)
    write(image, upper, text, ink_on(colour))
    return pixels_of(image)


@cache
def headlined(
    width: float, height: float, text: str, ground: Rgb, variant: int
) -> Pixels:
    """Return an exhibition panel: a headline, small print and a picture."""
    image = blank(width, height, ground)
    ink = ink_on(ground)
    field = whole(image).inset(0.06)
    cut = field.top + 0.36 * field.height
    write(
        image,
        Field(field.left, field.top, field.right, cut),
        text,
        ink,
        align=0.0,
        most_lines=3,
    )
    body = Field(field.left, cut + 0.05 * field.height, field.right, field.bottom)
    middle = body.left + 0.42 * body.width
    _small_print(
        image,
        Field(body.left, body.top, middle - 0.03 * body.width, body.bottom),
        mixed(ground, ink, 0.62),
        variant,
    )
    accent = ground if ink[0] > 0.5 else (0.2, 0.42, 0.62)
    scene_into(
        image,
        Field(middle, body.top, body.right, body.bottom),
        shade(accent, 1.2),
        variant,
    )
    return pixels_of(image)


@cache
def cork_board(
    width: float, height: float, text: str, ground: Rgb, variant: int
) -> Pixels:
    """Return a notice board: a strip with its words over pinned papers."""
    image = blank(width, height, ground)
    rng = np.random.default_rng(variant + 3)
    pixels = np.array(image, dtype=float) + rng.normal(
        0, 9, (image.height, image.width, 1)
    )
    image = Image.fromarray(np.clip(pixels, 0, 255).astype(np.uint8))
    draw = ImageDraw.Draw(image)
    everything = whole(image).inset(0.05)
    cut = everything.top
    if text:
        cut = everything.top + 0.27 * everything.height
        strip = Field(everything.left, everything.top, everything.right, cut)
        draw.rectangle([*strip], rgb255((0.97, 0.96, 0.92)))
        write(image, strip.inset(0.1), text, (0.08, 0.1, 0.2))
    papers = [
        PURE_WHITE,
        (1.0, 0.95, 0.6),
        (0.75, 0.9, 1.0),
        (1.0, 0.8, 0.8),
        (0.8, 0.95, 0.8),
    ]
    columns = max(3, round(4.4 * everything.width / everything.height / 1.4))
    step_x = everything.width / columns
    step_y = (everything.bottom - cut) / 2
    for column in range(columns):
        for row in range(2):
            if rng.random() < 0.15:
                continue
            w, h = step_x * rng.uniform(0.6, 0.85), step_y * rng.uniform(0.6, 0.86)
            x = everything.left + column * step_x + rng.uniform(0.05, 0.15) * step_x
            y = cut + row * step_y + rng.uniform(0.08, 0.14) * step_y
            sheet = Field(x, y, x + w, y + h)
            paper = papers[int(rng.integers(len(papers)))]
            draw.rectangle([*sheet], rgb255(paper))
            _small_print(image, sheet.inset(0.16), mixed(paper, (0, 0, 0), 0.55), row)
            pin = rgb255((0.8, 0.1, 0.1))
            draw.ellipse([x + w / 2 - 3, y + 1, x + w / 2 + 3, y + 7], pin)
    return pixels_of(image)


@cache
def marker_board(width: float, height: float, text: str, variant: int) -> Pixels:
    """Return a whiteboard with strokes of markers, or its words."""
    image = blank(width, height, (0.97, 0.98, 0.98))
    field = whole(image).inset(0.12)
    if text:
        write(image, field, text, (0.1, 0.15, 0.5))
        return pixels_of(image)
    rng = np.random.default_rng(variant + 29)
    draw = ImageDraw.Draw(image)
    inks: list[Rgb] = [(0.1, 0.15, 0.55), (0.75, 0.1, 0.1), (0.05, 0.4, 0.2)]
    for row in range(5):
        y = field.top + (row + 0.5) * field.height / 6
        end = field.left + field.width * rng.uniform(0.3, 0.55)
        xs = np.arange(field.left, end, 5)
        ys = y + rng.normal(0, 3.5, len(xs))
        points = list(zip(xs.tolist(), ys.tolist(), strict=True))
        draw.line(points, rgb255(inks[row % 3]), 2)
    x, y = field.left + 0.8 * field.width, field.top + 0.4 * field.height
    r = 0.16 * field.height
    draw.ellipse([x - r, y - r, x + r, y + r], outline=rgb255(inks[1]), width=3)
    draw.line([x - 2 * r, y + 2 * r, x + r, y - 2 * r], rgb255(inks[0]), 3)
    return pixels_of(image)


@cache
def film(
    width: float, height: float, text: str, variant: int, *, tiles: int = 1
) -> Pixels:
    """Return what a screen shows: a picture with its words, in tiles on a video wall."""
    image = blank(width, height, NIGHT)
    everything = whole(image)
    colours: list[Rgb] = [
        (0.1, 0.35, 0.7),
        (0.1, 0.5, 0.5),
        (0.4, 0.25, 0.6),
        (0.6, 0.3, 0.2),
    ]
    tall = everything.height > 1.2 * everything.width
    edge = everything.height * ((0.56 if tall else 0.48) if text else 0.0)
    # Words stand above the picture on tall screens and below it on broad ones.
    words = Field(0, 0, everything.right, edge)
    shown = Field(0, edge, everything.right, everything.bottom)
    if text and not tall:
        words = Field(0, everything.bottom - edge, everything.right, everything.bottom)
        shown = Field(0, 0, everything.right, everything.bottom - edge)
    scene_into(image, shown.inset(0.03), colours[variant % 4], variant)
    write(image, words.inset(0.08), text, PURE_WHITE)
    draw = ImageDraw.Draw(image)
    for place in range(1, tiles):
        x, y = image.width * place / tiles, image.height * place / tiles
        draw.line([x, 0, x, image.height], 0, 3)
        draw.line([0, y, image.width, y], 0, 3)
    return pixels_of(image)


@cache
def photo_picture(width: float, height: float, tone: Rgb) -> Pixels:
    """Return rows of small framed portraits."""
    image = blank(width, height, (0.88, 0.87, 0.84))
    draw = ImageDraw.Draw(image)
    rows, columns = 3, max(3, round(3 * width / height))
    w, h = image.width / columns, image.height / rows
    for row in range(rows):
        for column in range(columns):
            x, y = (column + 0.12) * w, (row + 0.1) * h
            draw.rectangle([x, y, x + 0.76 * w, y + 0.8 * h], rgb255(shade(tone, 0.6)))
            inner = (x + 0.06 * w, y + 0.06 * h, x + 0.7 * w, y + 0.74 * h)
            draw.rectangle(inner, rgb255((0.82, 0.82, 0.8)))
            cx, cy, r = x + 0.38 * w, y + 0.33 * h, 0.12 * h
            dark = rgb255((0.3 + 0.05 * (column % 3), 0.28, 0.27))
            draw.ellipse([cx - r, cy - r, cx + r, cy + r], dark)
            draw.pieslice([cx - 2 * r, cy + r, cx + 2 * r, cy + 5 * r], 180, 360, dark)
    return pixels_of(image)


@cache
def flag_picture(width: float, height: float, first: Rgb, second: Rgb) -> Pixels:
    """Return a flag of three bands with a disc."""
    image = blank(width, height, first)
    draw = ImageDraw.Draw(image)
    w, h = image.size
    draw.rectangle([0, h / 3, w, 2 * h / 3], rgb255(second))
    r = 0.12 * min(w, h)
    draw.ellipse([w / 2 - r, h / 2 - r, w / 2 + r, h / 2 + r], rgb255(first))
    return pixels_of(image)


def _small_print(image: Image.Image, field: Field, ink: Rgb, variant: int) -> None:
    """Draw bars where small print would stand, which nobody reads."""
    draw = ImageDraw.Draw(image)
    rng = np.random.default_rng(variant + 7)
    step = max(5.0, field.height / 9)
    y = field.top
    while y + step * 0.4 < field.bottom:
        end = field.left + field.width * rng.uniform(0.65, 1.0)
        draw.rectangle([field.left, y, end, y + step * 0.34], rgb255(ink))
        y += step


@cache
def world_map_picture(
    width: float, height: float, text: str, sea: Rgb, land: Rgb
) -> Pixels:
    """Return a map of the world with its words above it."""
    image = blank(width, height, shade(sea, 1.25) if sea != land else OCEAN)
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
def floor_map_picture(
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
        (0.62, 0.79, 0.9), (0.95, 0.83, 0.55), (0.73, 0.86, 0.65), (0.93, 0.7, 0.68)
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


@cache
def _continents() -> tuple[_Outline, ...]:
    """Return coarse outlines in degrees east and north, drawn by hand."""
    return read_table("continents.json", tuple[_Outline, ...])


def _draw_continents(image: Image.Image, field: Field, land: Rgb) -> None:
    draw = ImageDraw.Draw(image)
    for outline in _continents():
        points = [
            (
                field.left + (east + 180) / 360 * field.width,
                field.top + (90 - north) / 180 * field.height,
            )
            for east, north in outline
        ]
        frozen = min(north for _, north in outline) < -80 or outline[0] == (-55, 60)
        draw.polygon(points, rgb255(ICE if frozen else land))
