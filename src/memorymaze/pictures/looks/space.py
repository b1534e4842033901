"""Rockets, stations, globes and planets."""

import math

from memorymaze.pictures.looks.artwork import earth, planet
from memorymaze.pictures.looks.assembly import Assembly, Order, plinth
from memorymaze.pictures.looks.materials import (
    COAL,
    RED,
    STEEL,
    WHITE,
    Material,
    Rgb,
    metal,
    paint,
    picture,
    shade,
)
from memorymaze.pictures.looks.shapes import (
    Shape,
    around,
    ball,
    box,
    cylinder,
    extruded,
    lathed,
)
from memorymaze.pictures.looks.tubes import Point3, tube

BANDED = ("jupiter", "saturn", "uranus", "neptune", "venus")


def rocket(made: Assembly, order: Order) -> None:
    """Build a model of a launcher with boosters and fins on a base."""
    base = 0.16 * order.height
    plinth(made, order, base, (0.25, 0.27, 0.32))
    tall = order.height - base - 0.03
    r = min(0.11 * tall, min(order.length, order.depth) * 0.2)
    low = base + 0.03
    body = paint(order.colour(WHITE), 0.4)
    nose = [
        (r, low + 0.74 * tall),
        (r * 0.9, low + 0.84 * tall),
        (r * 0.55, low + 0.94 * tall),
        (0, low + tall),
    ]
    made.lathed(body, [(r, low + 0.07 * tall), *nose], 18)
    for z, tone in ((0.36, COAL), (0.62, RED), (0.72, COAL)):
        made.cylinder(
            paint(tone, 0.3), r * 1.015, (low + z * tall, low + (z + 0.03) * tall), 18
        )
    flame = metal((0.35, 0.33, 0.32))
    made.lathed(flame, [(r * 0.75, low), (r * 0.35, low + 0.08 * tall)], 14)
    for place in range(4):
        a = math.pi / 4 + place * math.pi / 2
        x, y = 1.55 * r * math.cos(a), 1.55 * r * math.sin(a)
        booster = lathed(
            [(0.5, 0.04), (0.5, 0.36), (0, 0.47)], 12, radius=r, height=tall, z=low
        )
        made.add(body, booster.moved(x, y))
        made.lathed(
            flame, [(r * 0.42, low), (r * 0.22, low + 0.05 * tall)], 10, at=(x, y, 0)
        )
        fin = extruded(
            [
                (0.9 * r, low + 0.05 * tall),
                (2.1 * r, low),
                (2.1 * r, low + 0.07 * tall),
                (0.9 * r, low + 0.22 * tall),
            ],
            (-0.012, 0.012),
            "y",
        )
        made.add(paint(RED, 0.3), fin.turned("z", 90.0 * place))


def rocket_engine(made: Assembly, order: Order) -> None:
    """Build a rocket engine, its bell down, in a frame with its words."""
    base = 0.12 * order.height
    plinth(made, order, base, (0.25, 0.27, 0.32))
    tall = order.height - base
    r = min(order.length, order.depth) * 0.42
    low = base + 0.04
    bell = metal(order.colour(STEEL))
    wall = [
        (r, low),
        (r * 0.88, low + 0.12 * tall),
        (r * 0.66, low + 0.28 * tall),
        (r * 0.36, low + 0.44 * tall),
        (r * 0.2, low + 0.5 * tall),
        (r * 0.32, low + 0.56 * tall),
        (r * 0.36, low + 0.66 * tall),
        (r * 0.3, low + 0.7 * tall),
    ]
    made.lathed(bell, wall, 22)
    for z, out in ((0.02, 1.0), (0.12, 0.9), (0.21, 0.78), (0.3, 0.64), (0.38, 0.5)):
        hoop = lathed(
            [
                (r * out * 0.98, low + z * tall),
                (r * out + 0.02, low + z * tall),
                (r * out + 0.02, low + (z + 0.015) * tall),
                (r * out * 0.98, low + (z + 0.015) * tall),
            ],
            15,
        )
        made.add(metal((0.45, 0.4, 0.36)), hoop)
    copper = metal((0.72, 0.43, 0.28))
    top = low + 0.7 * tall
    for place in range(3):
        a = math.tau * place / 3 + 0.5
        x, y = 0.5 * r * math.cos(a), 0.5 * r * math.sin(a)
        made.cylinder(
            metal(shade(STEEL, 0.7)),
            0.16 * r,
            (top - 0.2 * tall, top + 0.05 * tall),
            10,
            at=(x, y, 0),
        )
        made.tube(
            copper,
            [
                (x, y, top - 0.18 * tall),
                (x * 1.5, y * 1.5, top - 0.3 * tall),
                (x * 1.3, y * 1.3, low + 0.3 * tall),
            ],
            0.045 * r + 0.012,
            6,
        )
        made.tube(
            copper,
            [(x, y, top + 0.02 * tall), (0, 0, top + 0.1 * tall)],
            0.05 * r + 0.01,
            6,
        )
    made.add(
        metal(STEEL),
        cylinder(r * 0.22, (top, order.height - 0.06), 14),
        box(around(0, r * 0.5), around(0, r * 0.5), order.z.end(0.06)),
    )
    for x in (-1, 1):
        for y in (-1, 1):
            foot = (x * order.depth * 0.46, y * order.length * 0.46, base)
            made.tube(
                paint((0.2, 0.3, 0.5)),
                [foot, (x * r * 0.45, y * r * 0.45, order.height - 0.03)],
                0.03,
                6,
            )


def space_station_module(made: Assembly, order: Order) -> None:
    """Build a white cylinder on cradles: hatches, ribs, windows, its words."""
    low = 0.1 * order.height
    r = (order.height - low) / 2
    middle = low + r
    half = order.length / 2
    skin = paint(order.colour(WHITE), 0.2)
    profile = [
        (r * 0.5, -half),
        (r * 0.52, -half * 0.9),
        (r * 0.92, -half * 0.8),
        (r, -half * 0.76),
        (r, half * 0.76),
        (r * 0.92, half * 0.8),
        (r * 0.52, half * 0.9),
        (r * 0.5, half),
    ]
    flat = order.depth / (2 * r)
    cylinder_ = lathed(profile, 22).turned("x", 90).scaled(flat, 1, 1).moved(z=middle)
    made.add(skin, cylinder_)
    rib = paint((0.72, 0.73, 0.75), 0.2)
    for place in range(3):
        y = half * (-0.74 + 0.74 * place)
        hoop = lathed(
            [(r * 0.99, -0.03), (r * 1.02, -0.03), (r * 1.02, 0.03), (r * 0.99, 0.03)],
            28,
        )
        made.add(rib, hoop.turned("x", 90).scaled(flat, 1, 1).moved(0, y, middle))
    for side in (-1, 1):
        hatch = lathed([(r * 0.42, 0), (r * 0.42, 0.02)], 18).turned("x", 90)
        made.add(
            paint((0.3, 0.32, 0.36)),
            hatch.moved(0, side * (half - 0.005) + 0.01, middle),
        )
    front = order.depth / 2
    for side in (-1, 1):
        y = side * half * 0.52
        port = cylinder(r * 0.24, (0, 0.03), 20, along="x").moved(
            front * 0.955, y, middle + 0.28 * r
        )
        made.add(paint((0.35, 0.37, 0.4), 0.4), port)
        pane = cylinder(r * 0.19, (0, 0.035), 18, along="x").moved(
            front * 0.96, y, middle + 0.28 * r
        )
        made.add(paint((0.06, 0.12, 0.3), 0.9), pane)
        rail = [
            (front * 0.92, y - 0.3, middle - 0.3 * r),
            (front * 1.01, y - 0.3, middle - 0.3 * r),
            (front * 1.01, y + 0.3, middle - 0.3 * r),
            (front * 0.92, y + 0.3, middle - 0.3 * r),
        ]
        made.tube(paint((0.9, 0.75, 0.1)), rail, 0.016, 5)
    door = 0.26 * half
    made.box(
        paint((0.25, 0.27, 0.3)),
        (0, front * 0.93),
        (-door, door),
        (low * 0.9, middle + 0.5 * r),
        0.05,
    )
    made.words(
        order.text,
        (0.1, 0.2, 0.45),
        (0, front * 0.9),
        around(0, order.length * 0.25),
        (middle + 0.56 * r, middle + 0.56 * r + 0.3 * r),
    )
    for y in (-half * 0.55, half * 0.55):
        cradle = [
            (-front * 0.8, 0),
            (front * 0.8, 0),
            (front * 0.8, low * 1.8),
            (front * 0.45, low * 1.2),
            (-front * 0.45, low * 1.2),
            (-front * 0.8, low * 1.8),
        ]
        made.add(paint((0.3, 0.3, 0.33)), extruded(cradle, around(y, 0.06), "y"))


def globe(made: Assembly, order: Order) -> None:
    """Build the earth: in a ring on a foot, or free where it hangs."""
    surface = picture(earth(), 0.25 if order.mount == "ceiling" else 0.0)
    width = min(order.length, order.depth)
    if order.mount == "ceiling" or order.height < 1.1 * width:
        radius = order.height / 2
        made.ball(surface, radius, 36, 18, at=(0, 0, radius))
        return
    radius = width / 2 - min(0.03, 0.1 * width)
    middle = order.height - radius - 0.03
    axis = 23.4
    made.add(surface, ball(radius * 0.94, 32, 16).turned("x", axis).moved(z=middle))
    wood_ring = metal((0.72, 0.58, 0.28))
    made.add(wood_ring, _hoop(radius, 0.018, upright=True).moved(z=middle))
    made.lathed(
        paint((0.35, 0.22, 0.13), 0.3),
        [
            (width * 0.5, 0),
            (width * 0.48, 0.04),
            (0.08, 0.07),
            (0.05, 0.14),
            (0.04, middle - radius),
        ],
        18,
    )


def planet_model(made: Assembly, order: Order) -> None:
    """Build a planet on an arm from the wall, its name under it."""
    name = (order.text or "").lower()
    colour = order.colour((0.7, 0.6, 0.45))
    surface = picture(
        planet(
            colour, banded=any(each in name for each in BANDED), variant=order.variant
        )
    )
    label = min(0.2, 0.26 * order.height) if order.text else 0.0
    radius = min(order.length, order.height - label, order.depth * 1.6) / 2
    middle = order.height - radius
    flat = min(1.0, order.depth / (2 * radius) * 0.9)
    made.add(
        surface,
        ball(radius, 30, 16)
        .scaled(flat, 1, 1)
        .moved(order.x[1] - radius * flat, 0, middle),
    )
    back = order.x[0]
    made.tube(metal(STEEL), [(back, 0, middle), (0, 0, middle)], 0.03, 8)
    if "saturn" in name:
        ring = _hoop(radius * 1.4, 0.03, upright=False).turned("y", 15)
        made.add(paint((0.85, 0.78, 0.6)), ring.moved(0, 0, middle))
    made.words(
        order.text,
        (0.08, 0.08, 0.14),
        order.x.start(0.03),
        around(0, min(order.length, 0.9) * 0.45),
        (0, label * 0.9),
    )


def hanging_planets(made: Assembly, order: Order) -> None:
    """Build planets on wires round a golden sun, under the ceiling."""
    reach = min(order.length, order.depth) / 2
    tall = order.height
    hub = metal(order.colour((0.83, 0.65, 0.22)))
    sun = min(0.28 * tall, 0.2 * reach)
    made.ball(hub, sun, 12, 8, at=(0, 0, tall * 0.5))
    made.cylinder(hub, 0.02, (0, tall - 0.5 * tall), 6, at=(0, 0, tall * 0.5))
    tones: tuple[Rgb, ...] = (
        (0.6, 0.58, 0.55),
        (0.9, 0.75, 0.45),
        (0.2, 0.4, 0.75),
        (0.75, 0.3, 0.2),
        (0.85, 0.65, 0.4),
        (0.9, 0.8, 0.55),
        (0.55, 0.8, 0.85),
        (0.25, 0.35, 0.8),
        (0.7, 0.65, 0.6),
    )
    for place, tone in enumerate(tones):
        size = sun * (0.35 + 0.5 * (place in {4, 5}) + 0.12 * (place % 3))
        way = reach * (0.3 + 0.66 * place / len(tones))
        angle = 2.4 * place
        x, y = way * math.cos(angle), way * math.sin(angle)
        z = tall * (0.3 + 0.3 * ((place * 7) % 5) / 5)
        surface: Material = paint(tone, 0.4)
        made.ball(surface, size, 9, 6, at=(x, y, z))
        made.tube(metal(STEEL), [(x, y, z), (x, y, tall)], 0.006, 4)
        if place == 5:
            made.add(
                paint((0.85, 0.75, 0.5)),
                _hoop(size * 1.6, 0.02, upright=False).turned("y", 20).moved(x, y, z),
            )
    hoop = _hoop(reach - 0.014, 0.014, upright=False)
    made.add(hub, hoop.moved(z=tall * 0.97))


def _hoop(radius: float, thick: float, *, upright: bool) -> Shape:
    points: list[Point3] = []
    for step in range(22):
        a = math.tau * step / 22
        c, s = radius * math.cos(a), radius * math.sin(a)
        points.append((0.0, c, s) if upright else (c, s, 0.0))
    return tube(points, thick, 5, closed=True)
