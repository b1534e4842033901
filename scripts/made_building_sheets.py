"""Draw sheets of made buildings: 24 floors from above, and views in six of them.

python scripts/made_building_sheets.py --out docs/images
"""

import argparse
import tempfile
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from PIL import Image
from shapely import LineString

from memorymaze.basics.geometry.pose import Pose, heading_to
from memorymaze.world.cameras import RenderedCamera, build_visual_scene
from memorymaze.world.construction import BUILDING_KINDS, make_building
from memorymaze.world.drawing.plan_picture import draw_site
from memorymaze.world.sites import Route, Site

EACH = 3
"""Floors of each kind."""
FLOOR_WIDTH, FLOOR_HEIGHT = 440, 400
VIEW_WIDTH, VIEW_HEIGHT = 320, 240
VIEWED = ("university", "museum", "hospital", "mall", "station", "airport")
BEFORE_TURN = 4.0
"""Metres before a turn from which it is seen."""
QUALITY = 62


def main() -> None:
    """Draw both sheets."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("docs/images"), metavar="DIR")
    out: Path = parser.parse_args().out
    floors = [
        drawn(make_building(kind, seed))
        for kind in BUILDING_KINDS
        for seed in range(EACH)
    ]
    save(sheet(floors, 4), out / "made_buildings.jpg")
    views = [view for kind in VIEWED for view in seen(make_building(kind, 0))]
    save(sheet(views, 4), out / "made_building_views.jpg")


def drawn(site: Site) -> Image.Image:
    """Return a floor from above, with its routes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "floor.png"
        draw_site(site, path, routes=True)
        with Image.open(path) as whole:
            small = whole.convert("RGB")
    small.thumbnail((FLOOR_WIDTH, FLOOR_HEIGHT), Image.Resampling.LANCZOS)
    cell = Image.new("RGB", (FLOOR_WIDTH, FLOOR_HEIGHT), "white")
    left, top = (FLOOR_WIDTH - small.width) // 2, (FLOOR_HEIGHT - small.height) // 2
    cell.paste(small, (left, top))
    return cell


def seen(site: Site) -> list[Image.Image]:
    """Return what a robot sees at four places along a route."""
    scene = build_visual_scene(site)
    poses = poses_along(site.find_route("R2"))
    with RenderedCamera(scene, 2 * VIEW_WIDTH, 2 * VIEW_HEIGHT) as camera:
        return [Image.fromarray(camera.frame(pose).rgb).reduce(2) for pose in poses]


def poses_along(route: Route) -> list[Pose]:
    """Return the start, places before the first two turns, and one before the goal."""
    poses = [route.start]
    corners = [(x, y) for x, y, *_ in route.line.coords]
    for before, corner in list(pairwise(corners))[:2]:
        poses.append(_looking(before, corner))
    poses.append(_looking(corners[-2], corners[-1]))
    return poses


def _looking(start: tuple[float, float], end: tuple[float, float]) -> Pose:
    line = LineString([start, end])
    place = line.interpolate(max(line.length - BEFORE_TURN, 0.0))
    return Pose(place.x, place.y, heading_to(start, end))


def sheet(pictures: Sequence[Image.Image], columns: int) -> Image.Image:
    """Return pictures of one size in rows."""
    width, height = pictures[0].size
    rows = -(-len(pictures) // columns)
    whole = Image.new("RGB", (columns * width, rows * height), "white")
    for index, picture in enumerate(pictures):
        whole.paste(picture, (index % columns * width, index // columns * height))
    return whole


def save(picture: Image.Image, path: Path) -> None:
    """Write a picture and say so."""
    picture.save(path, quality=QUALITY, optimize=True)
    print(path)


if __name__ == "__main__":
    main()
