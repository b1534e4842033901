"""Draw contact sheets: one picture of every category that the shipped plans name.

Each thing stands in a hall, drawn as a robot's camera sees it, from 3 m or from where
all of it is in the picture, a little from its left. Things that no plan has follow.

    python scripts/contact_sheet.py --out docs/images
    python scripts/contact_sheet.py --looks my_things.glb --out sheets
"""

import argparse
import math
from collections.abc import Iterator
from pathlib import Path

from PIL import Image, ImageDraw
from shapely import Point
from shapely import box as rectangle

from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.cameras.camera import RenderedCamera
from memorymaze.world.cameras.visual_scene import build_visual_scene
from memorymaze.world.looks import OWN, Looks
from memorymaze.world.sites import load_sites
from memorymaze.world.sites.records import Area, Landmark, Mount, Site
from memorymaze.world.sites.solids import landmark_solid

CELL, LABEL, GAP = 180, 15, 3
"""Pixels of a picture's side, of the line under it, and between pictures."""
COLUMNS, ROWS = 9, 7
LARGEST_FILE = 300_000
"""Bytes of a picture in the documents."""
PIXELS = 720
"""Side of the pictures before they are cut to the thing, pixels."""
FIELD_OF_VIEW = math.radians(50)
EYE_HEIGHT = 1.25
NEAREST = 3.0
"""Metres from the camera to the thing."""
SIDEWAYS = math.radians(26)
"""How far from straight ahead things are looked at."""
BAY = 16.0
"""Metres of hall for each thing."""
DEPTH = 24.0
CEILING = 9.0
MARGIN = 1.25
"""Of the picture, as a multiple of the thing."""
EXTRAS: tuple[tuple[str, tuple[float, float, float]], ...] = (
    ("mystery contraption", (1.0, 0.6, 1.2)),
    ("standing person", (0.55, 0.4, 1.72)),
    ("walking person", (0.55, 0.85, 1.72)),
    ("chair", (0.5, 0.55, 0.85)),
    ("stool", (0.4, 0.4, 0.5)),
    ("desk", (1.4, 0.7, 0.74)),
    ("cabinet", (1.0, 0.45, 1.9)),
    ("rock", (0.6, 0.5, 0.45)),
    ("dinosaur skeleton", (4.0, 1.2, 2.4)),
    ("bicycle", (1.7, 0.55, 1.05)),
    ("car", (3.9, 1.7, 1.45)),
    ("suitcase", (0.45, 0.28, 1.05)),
    ("cardboard boxes", (0.6, 0.5, 0.8)),
    ("queue barrier", (1.8, 0.34, 0.95)),
    ("traffic cone", (0.36, 0.36, 0.7)),
    ("cart", (0.9, 0.5, 1.0)),
)
"""Things that no shipped plan has: unknown, walking, or left in the way."""


def main() -> None:
    """Draw all sheets and print their names."""
    parser = argparse.ArgumentParser(
        description="Draw contact sheets of all categories."
    )
    parser.add_argument("--out", type=Path, default=Path("docs/images"), metavar="DIR")
    parser.add_argument(
        "--only", default="", metavar="WORDS", help="categories with this in their name"
    )
    parser.add_argument(
        "--looks", default=OWN, metavar="FILE", help="models of your own (default: own)"
    )
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    examples = [each for each in _examples() if args.only in each.category]
    pictures = list(_pictures(examples, args.looks))
    step = COLUMNS * ROWS
    for number, start in enumerate(range(0, len(pictures), step), start=1):
        sheet = _sheet(pictures[start : start + step])
        _save(sheet, args.out / f"contact_sheet_{number}.png")


def _save(sheet: Image.Image, path: Path) -> None:
    """Write with as many colours as the size that documents allow leaves room for."""
    for colours in (256, 192, 128, 96, 64):
        palette = sheet.quantize(colours, method=Image.Quantize.MAXCOVERAGE, kmeans=2)
        palette.save(path, optimize=True)
        if path.stat().st_size <= LARGEST_FILE:
            break
    print(path)


def _examples() -> list[Landmark]:
    """Return one thing of each category, one with words where there is one."""
    found: dict[str, Landmark] = {}
    for site in load_sites(None).values():
        for thing in site.landmarks:
            known = found.get(thing.category)
            if known is None or (known.text is None and thing.text):
                found[thing.category] = thing
    examples = sorted(found.values(), key=lambda each: each.category.lower())
    return examples + [_extra(category, size) for category, size in EXTRAS]


def _extra(category: str, size: tuple[float, float, float]) -> Landmark:
    mount: Mount = "floor"
    return Landmark(
        category, Point(0, 0), category, None, None, None, 0.0, size, mount, True
    )


def _pictures(examples: list[Landmark], looks: Looks) -> Iterator[Image.Image]:
    """Draw each thing in its own bay of one long hall."""
    placed = [_in_bay(thing, number) for number, thing in enumerate(examples)]
    hall = Area(
        "hall",
        rectangle(-BAY, 0.0, BAY * (len(examples) + 1), DEPTH),
        None,
        "linoleum",
        "plaster",
        False,
    )
    site = Site(
        "contact_sheet", "", "", CEILING, "", None,
        (), (hall,), (), (), (), tuple(placed), (),
    )  # fmt: skip
    with RenderedCamera(
        build_visual_scene(site, looks=looks),
        PIXELS,
        PIXELS,
        FIELD_OF_VIEW,
        multisamples=4,
    ) as camera:
        for thing in placed:
            yield _labelled(_picture(camera, thing, site), thing.category)


def _in_bay(thing: Landmark, number: int) -> Landmark:
    depth = thing.size[1]
    off_wall = depth / 2 if thing.mount == "wall" else depth / 2 + 0.25
    return Landmark(
        f"{thing.id}_{number}",
        Point(number * BAY, off_wall),
        thing.category,
        thing.color,
        thing.name,
        thing.text,
        math.pi / 2,
        thing.size,
        thing.mount,
        thing.obstacle,
    )


def _picture(camera: RenderedCamera, thing: Landmark, site: Site) -> Image.Image:
    length, depth, height = thing.size
    middle = landmark_solid(thing, site).position
    across = length * math.cos(SIDEWAYS) + depth * math.sin(SIDEWAYS)
    reach = 0.5 * MARGIN * max(across, height + 0.3 * depth)
    away = max(NEAREST, reach / math.tan(FIELD_OF_VIEW / 2)) + depth / 2
    eye_height = max(EYE_HEIGHT, 0.28 * away) if middle[2] < 1.4 else EYE_HEIGHT
    x, y = middle[0] - away * math.sin(SIDEWAYS), middle[1] + away * math.cos(SIDEWAYS)
    pitch = math.atan2(middle[2] - eye_height, away)
    heading = math.atan2(middle[1] - y, middle[0] - x)
    pixels = camera.picture(Pose(x, y, heading), eye_height, pitch)
    distance = math.hypot(away, middle[2] - eye_height)
    half = PIXELS / 2 * reach / distance / math.tan(FIELD_OF_VIEW / 2)
    centre = PIXELS / 2
    corners = (centre - half, centre - half, centre + half, centre + half)
    return Image.fromarray(pixels).resize(
        (CELL, CELL), Image.Resampling.LANCZOS, box=_inside(corners)
    )


def _inside(
    corners: tuple[float, float, float, float],
) -> tuple[float, float, float, float]:
    left, top, right, bottom = (min(max(each, 0.0), PIXELS) for each in corners)
    return left, top, right, bottom


def _labelled(picture: Image.Image, words: str) -> Image.Image:
    cell = Image.new("RGB", (CELL, CELL + LABEL), (255, 255, 255))
    cell.paste(picture, (0, 0))
    ImageDraw.Draw(cell).text((4, CELL + 2), words, (0, 0, 0))
    return cell


def _sheet(pictures: list[Image.Image]) -> Image.Image:
    columns = min(COLUMNS, len(pictures))
    rows = math.ceil(len(pictures) / columns)
    wide, tall = CELL + GAP, CELL + LABEL + GAP
    sheet = Image.new("RGB", (columns * wide, rows * tall), (255, 255, 255))
    for place, picture in enumerate(pictures):
        sheet.paste(picture, (place % columns * wide, place // columns * tall))
    return sheet


if __name__ == "__main__":
    main()
