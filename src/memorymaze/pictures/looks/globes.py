"""Round worlds: globes on stands and in the air, planets, what turns round them."""

import math

from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.boards import sign_board
from memorymaze.pictures.looks.colours import Rgb
from memorymaze.pictures.looks.maps import earth, planet
from memorymaze.pictures.looks.object_model import Material
from memorymaze.pictures.looks.paints import metal, paint, picture
from memorymaze.pictures.looks.primitives import ball, cylinder, lathed, plate
from memorymaze.pictures.looks.shape import Shape
from memorymaze.pictures.looks.tubes import Point3, tube

STEEL: Rgb = (0.7, 0.71, 0.73)
BANDED = ("jupiter", "saturn", "uranus", "neptune", "venus")


def globe(order: Order) -> Assembly:
    """Build the earth: in a ring on a foot, or free where it hangs."""
    assembly = Assembly()
    surface = picture(earth(), 0.25 if order.mount == "ceiling" else 0.0)
    width = min(order.length, order.depth)
    if order.mount == "ceiling" or order.height < 1.1 * width:
        radius = order.height / 2
        assembly.add(surface, ball(radius, 36, 18).moved(z=radius))
        return assembly
    radius = width / 2 - min(0.03, 0.1 * width)
    middle = order.height - radius - 0.03
    axis = 23.4
    assembly.add(surface, ball(radius * 0.94, 32, 16).turned("x", axis).moved(z=middle))
    wood_ring = metal((0.72, 0.58, 0.28))
    assembly.add(wood_ring, _hoop(radius, 0.018, upright=True).moved(z=middle))
    assembly.add(
        paint((0.35, 0.22, 0.13), 0.3),
        lathed(
            [
                (width * 0.5, 0),
                (width * 0.48, 0.04),
                (0.08, 0.07),
                (0.05, 0.14),
                (0.04, middle - radius),
            ],
            18,
        ),
    )
    return assembly


def planet_model(order: Order) -> Assembly:
    """Build a planet on an arm from the wall, its name under it."""
    assembly = Assembly()
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
    assembly.add(
        surface,
        ball(radius, 30, 16)
        .scaled(flat, 1, 1)
        .moved(order.x[1] - radius * flat, 0, middle),
    )
    back = order.x[0]
    assembly.add(metal(STEEL), tube([(back, 0, middle), (0, 0, middle)], 0.03, 8))
    if "saturn" in name:
        ring = _hoop(radius * 1.4, 0.03, upright=False).turned("y", 15)
        assembly.add(paint((0.85, 0.78, 0.6)), ring.moved(0, 0, middle))
    if order.text:
        wide = min(order.length, 0.9) * 0.9
        pixels = sign_board(wide, label * 0.9, order.text, (0.08, 0.08, 0.14))
        assembly.add(
            picture(pixels),
            plate((back, back + 0.03), (-wide / 2, wide / 2), (0, label * 0.9)),
        )
    return assembly


def hanging_planets(order: Order) -> Assembly:
    """Build planets on wires round a golden sun, under the ceiling."""
    assembly = Assembly()
    reach = min(order.length, order.depth) / 2
    tall = order.height
    hub = metal(order.colour((0.83, 0.65, 0.22)))
    sun = min(0.28 * tall, 0.2 * reach)
    assembly.add(hub, ball(sun, 12, 8).moved(z=tall * 0.5))
    assembly.add(hub, cylinder(0.02, (0, tall - 0.5 * tall), 6).moved(z=tall * 0.5))
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
        assembly.add(surface, ball(size, 9, 6).moved(x, y, z))
        assembly.add(metal(STEEL), tube([(x, y, z), (x, y, tall)], 0.006, 4))
        if place == 5:
            assembly.add(
                paint((0.85, 0.75, 0.5)),
                _hoop(size * 1.6, 0.02, upright=False).turned("y", 20).moved(x, y, z),
            )
    hoop = _hoop(reach - 0.014, 0.014, upright=False)
    assembly.add(hub, hoop.moved(z=tall * 0.97))
    return assembly


def _hoop(radius: float, thick: float, *, upright: bool) -> Shape:
    points: list[Point3] = []
    for step in range(22):
        a = math.tau * step / 22
        c, s = radius * math.cos(a), radius * math.sin(a)
        points.append((0.0, c, s) if upright else (c, s, 0.0))
    return tube(points, thick, 5, closed=True)
