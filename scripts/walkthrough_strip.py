"""Draw frames of walkthroughs of the shipped plans: one row a building.

python scripts/walkthrough_strip.py --out docs/images
"""

import argparse
import math
from pathlib import Path

from PIL import Image

from memorymaze.robot.simulation.cameras import visual_scene_of
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.runs.films import WalkthroughSettings
from memorymaze.runs.films.walkthrough import tour_of
from memorymaze.world.cameras import RenderedCamera
from memorymaze.world.sites import load_sites

WIDTH, HEIGHT, FRAMES = 320, 180, 5
SHRINK = 2
"""Drawn so many times as large, then made smaller, which smooths it."""


def main() -> None:
    """Draw the picture into a folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("docs/images"))
    folder = parser.parse_args().out
    sites = load_sites()
    image = Image.new("RGB", (FRAMES * WIDTH, len(sites) * HEIGHT))
    settings = WalkthroughSettings()
    for row, site in enumerate(sites.values()):
        scene = build_scene(site)
        poses = list(tour_of(scene, site.find_route("R1")).poses(settings.fps))
        # The middle of each fifth of the film.
        chosen = [
            poses[len(poses) * (2 * k + 1) // (2 * FRAMES)] for k in range(FRAMES)
        ]
        size = (SHRINK * WIDTH, SHRINK * HEIGHT)
        with RenderedCamera(visual_scene_of(scene), *size, math.pi / 2) as camera:
            for column, pose in enumerate(chosen):
                picture = Image.fromarray(camera.picture(pose, settings.height))
                image.paste(picture.reduce(SHRINK), (column * WIDTH, row * HEIGHT))
    path = folder / "walkthrough_strip.jpg"
    image.save(path, quality=85, optimize=True)
    print(path, f"{path.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
