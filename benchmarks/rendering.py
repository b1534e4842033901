"""How many pictures a second the robot's camera gives on a route.

RGB, depth and instance ids together, and RGB alone, without multisampling, on the museum's
fifth floor along route R1; of several turns the fastest counts.
"""

import math
from collections.abc import Callable

from benchmarks.measuring import Row, timed
from memorymaze.basics.geometry.pose import Pose, heading_to
from memorymaze.world.cameras import (
    RenderedCamera,
    VisualScene,
    build_visual_scene,
)
from memorymaze.world.sites import Site, load_site

SITE, ROUTE = "museum_5f", "R1"
SIZES = ((224, 224), (640, 480))
POSES = 40
TURNS = 7


def run() -> list[Row]:
    site = load_site(SITE)
    scene, took = timed(lambda: build_visual_scene(site))
    rows = [Row(f"looks of {SITE} built", took / 1e3, "s")]
    for width, height in SIZES:
        rows += rates(scene, site, width, height)
    return rows


def rates(scene: VisualScene, site: Site, width: int, height: int) -> list[Row]:
    poses = along_route(site)
    both: list[float] = []
    colours: list[float] = []
    with RenderedCamera(scene, width, height) as camera:
        for pose in poses:
            camera.frame(pose)
        for _ in range(TURNS):
            both.append(milliseconds(camera.frame, poses))
            colours.append(milliseconds(camera.picture, poses))
    size = f"{width}x{height}"
    return [
        Row(f"RGB + depth + ids, {size}", 1e3 / min(both), "frames/s"),
        Row(f"RGB alone, {size}", 1e3 / min(colours), "frames/s"),
    ]


def milliseconds(draw: Callable[[Pose], object], poses: list[Pose]) -> float:
    """Return the mean time of a picture."""

    def all_poses() -> None:
        for pose in poses:
            draw(pose)

    return timed(all_poses)[1] / len(poses)


def along_route(site: Site) -> list[Pose]:
    """Return evenly spaced poses that look along the route."""
    line = site.find_route(ROUTE).line
    poses: list[Pose] = []
    for number in range(POSES):
        along = (line.length - 0.6) * number / (POSES - 1)
        here, there = line.interpolate(along), line.interpolate(along + 0.5)
        heading = heading_to((here.x, here.y), (there.x, there.y))
        poses.append(Pose(here.x, here.y, heading % (2 * math.pi)))
    return poses
