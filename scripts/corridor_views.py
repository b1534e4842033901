"""Draw one picture of every kind of corridor, and a panorama, of the shipped plans.

A kind is a floor and a wall material; the longest corridor of each kind is shown, seen
by a robot that stands at its beginning. Open-air areas follow.

    python scripts/corridor_views.py --out docs/images
"""

import argparse
import math
from collections.abc import Iterator
from contextlib import closing
from itertools import combinations
from pathlib import Path

from PIL import Image, ImageDraw
from shapely import LineString

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.robot_size import CAMERA_HEIGHT
from memorymaze.basics.video_file import BT709, LIMITED_RANGE, video_frame
from memorymaze.runs.films import WalkthroughSettings
from memorymaze.runs.films.drawing import Artist
from memorymaze.world.cameras import (
    RenderedCamera,
    VisualScene,
    build_visual_scene,
)
from memorymaze.world.sites import Site, load_sites

WIDTH, HEIGHT, LABEL = 320, 240, 16
COLUMNS = 3
FROM_THE_END = 1.6
"""Metres from a corridor's end to the camera."""
SHRINK = 2
"""Pictures are drawn so many times larger, then reduced."""
PANORAMA_WIDTH = 960
COLOURS = 256


def main() -> None:
    """Draw all of them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("docs/images"), metavar="DIR")
    out: Path = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    for name, site in load_sites().items():
        scene = build_visual_scene(site)
        save(sheet(scene, list(views(site))), out / f"{name}_views.png")
        save(panorama(site), out / f"{name}_panorama.png")


def panorama(site: Site) -> Image.Image:
    """Return the view all round from the middle of route R1, as in films."""
    size = (SHRINK * PANORAMA_WIDTH, SHRINK * PANORAMA_WIDTH // 2)
    settings = WalkthroughSettings(size, panorama=True, height=CAMERA_HEIGHT)
    middle = site.find_route("R1").line.interpolate(0.5, normalized=True)
    with closing(Artist(site, settings)) as artist:
        planes = artist.planes(Pose(middle.x, middle.y, 0.0))
    colours = video_frame(planes).reformat(
        format="rgb24", src_colorspace=BT709, src_color_range=LIMITED_RANGE
    )
    return Image.fromarray(colours.to_ndarray()).reduce(SHRINK)


def views(site: Site) -> Iterator[tuple[str, Pose]]:
    """Yield the name and the pose of each picture."""
    shown: set[tuple[str, str]] = set()
    for corridor in sorted(site.corridors, key=lambda each: -each.length):
        kind = (corridor.floor_material, corridor.wall_material)
        if kind in shown:
            continue
        shown.add(kind)
        (ax, ay), (bx, by) = corridor.centre_line.coords
        heading = math.atan2(by - ay, bx - ax)
        share = min(FROM_THE_END / corridor.length, 0.3)
        pose = Pose(ax + (bx - ax) * share, ay + (by - ay) * share, heading)
        yield f"{corridor.id}: {kind[0]} floor, {kind[1]} walls", pose
    for area in site.areas:
        if area.open_air:
            inner = area.polygon.buffer(-1.0)
            ways = [LineString(ends) for ends in combinations(inner.exterior.coords, 2)]
            way = max(
                (each for each in ways if inner.covers(each)), key=lambda w: w.length
            )
            (ax, ay), (bx, by) = way.coords
            heading = math.atan2(by - ay, bx - ax)
            yield f"{area.id}: in the open air", Pose(ax, ay, heading)


def sheet(scene: VisualScene, wanted: list[tuple[str, Pose]]) -> Image.Image:
    """Return all pictures side by side, each with its name below."""
    rows = math.ceil(len(wanted) / COLUMNS)
    image = Image.new("RGB", (COLUMNS * WIDTH, rows * (HEIGHT + LABEL)), "white")
    pen = ImageDraw.Draw(image)
    size = (SHRINK * WIDTH, SHRINK * HEIGHT)
    with RenderedCamera(scene, *size, multisamples=4) as camera:
        for number, (name, pose) in enumerate(wanted):
            row, column = divmod(number, COLUMNS)
            x, y = column * WIDTH, row * (HEIGHT + LABEL)
            picture = Image.fromarray(camera.picture(pose)).reduce(SHRINK)
            image.paste(picture, (x, y))
            pen.text((x + 4, y + HEIGHT + 2), name, "black")
    return image


def save(image: Image.Image, path: Path) -> None:
    """Write a picture with few colours, which keeps it small."""
    image.quantize(COLOURS).save(path, optimize=True)
    print(path, f"{path.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
