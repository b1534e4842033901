"""Draw an exported building with three.js, beside our own picture from the same pose.

    python scripts/exported_in_three.py museum_5f --route R1 --out side_by_side.jpg

Needs Chromium and what `scripts/setup_node_packages.sh` installs.
"""

import argparse
import base64
import io
import math
import shutil
import sys
import tempfile
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Page, Route, sync_playwright

from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.cameras import RenderedCamera, build_visual_scene
from memorymaze.world.exporting import export_site
from memorymaze.world.sites import load_site

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
WEBGL = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
ORIGIN = "http://exported.test"
PAGE = """<!doctype html><script type="importmap">{"imports": {
"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}
</script><script type="module" src="/exported_in_three.js"></script>"""
TYPES = {".js": "text/javascript", ".glb": "model/gltf-binary"}
FOV = math.radians(80)


@dataclass(frozen=True, eq=False)
class ThreePicture:
    """What three.js sees of an exported building."""

    rgb: NDArray[np.uint8]
    depth: NDArray[np.float32]
    """Along the optical axis, metres; infinite where nothing is."""
    meshes: NDArray[np.int32]
    """Places in `names`, -1 where nothing is."""
    names: tuple[tuple[str, str], ...]
    """Id and kind of every mesh."""


class Building:
    """A GLB that is open in a page."""

    def __init__(self, page: Page, width: int, height: int) -> None:
        """Wait until it is loaded."""
        self._page, self._size = page, (width, height)
        page.wait_for_function("window.is_ready")
        opened = page.evaluate(
            "([w, h]) => window.open_building(w, h)", [width, height]
        )
        self._names = tuple((each[0], each[1]) for each in opened)

    def picture(self, pose: Pose, height: float, fov: float = FOV) -> ThreePicture:
        """Draw it from a pose; height of the lens over the floor in metres."""
        rgb, numbers = self._page.evaluate(
            "([pose, height, fov]) => window.picture_from(pose, height, fov)",
            [[pose.x, pose.y, pose.heading], height, fov],
        )
        picture = Image.open(io.BytesIO(base64.b64decode(rgb.split(",")[1])))
        width, tall = self._size
        values = np.frombuffer(base64.b64decode(numbers), dtype=np.float32)
        # WebGL reads rows from the bottom.
        values = values.reshape(tall, width, 4)[::-1]
        meshes = np.round(values[:, :, 0]).astype(np.int32) - 1
        depth = np.where(meshes < 0, np.float32(np.inf), values[:, :, 1])
        return ThreePicture(
            np.array(picture.convert("RGB")), depth, meshes, self._names
        )


@contextmanager
def opened(
    glb: Path, node_modules: Path, width: int = 320, height: int = 240
) -> Generator[Building]:
    """Open a GLB in Chromium; nothing is asked of the network."""
    chromium = next(filter(None, map(shutil.which, BROWSERS)), None)
    if chromium is None:
        raise SystemExit("expected Chromium; scripts/setup_browser.sh installs it")

    def answer(route: Route) -> None:
        path = route.request.url.removeprefix(ORIGIN)
        file = {
            "/building.glb": glb,
            "/exported_in_three.js": Path(__file__).with_suffix(".js"),
        }.get(path, node_modules / path.removeprefix("/"))
        if path == "/":
            route.fulfill(body=PAGE, content_type="text/html")
        else:
            body = file.read_bytes()
            route.fulfill(body=body, content_type=TYPES[file.suffix])

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=chromium, headless=True, args=list(WEBGL)
        )
        page = browser.new_page(viewport={"width": width, "height": height})
        page.on("pageerror", lambda error: print(error, file=sys.stderr))
        page.on("console", lambda said: print(said.text, file=sys.stderr))
        page.route("**/*", answer)
        page.goto(f"{ORIGIN}/")
        yield Building(page, width, height)
        browser.close()


def main() -> None:
    """Make the picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("site", metavar="FILE|NAME")
    parser.add_argument("--route", default="R1", metavar="ID")
    parser.add_argument(
        "--pose",
        nargs=3,
        type=float,
        metavar=("X", "Y", "DEGREES"),
        help="another view",
    )
    parser.add_argument("--height", type=float, default=1.5, metavar="METRES")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE")
    options = parser.parse_args()
    site = load_site(options.site)
    pose = site.find_route(options.route).start
    if options.pose:
        x, y, degrees = options.pose
        pose = Pose(x, y, math.radians(degrees))
    width, height = 400, 300
    with RenderedCamera(
        build_visual_scene(site, looks="own"), width, height, FOV, multisamples=4
    ) as camera:
        ours = camera.picture(pose, options.height)
    node_modules = Path(sys.prefix) / "node" / "node_modules"
    with tempfile.TemporaryDirectory() as folder:
        (glb,) = export_site(site, "gltf", Path(folder) / "building.glb")
        with opened(glb, node_modules, width, height) as building:
            theirs = building.picture(pose, options.height).rgb
    gap = np.full((height, 8, 3), 255, dtype=np.uint8)
    Image.fromarray(np.hstack([ours, gap, theirs])).save(options.out, quality=82)
    print(options.out)


if __name__ == "__main__":
    main()
