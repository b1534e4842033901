"""How many LiDAR scans a second the physics scene gives, on one core.

The baseline cuts the same rays with all walls and things on the plan by numpy. At 10
scans a simulated second, a rate of 1,500 scans/s is 150 times real time. Seconds are of
processor time, so that other work on the machine counts less.
"""

import math
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from shapely import Polygon

from benchmarks.measuring import Row
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.senses.lidar import Lidar, LidarSettings
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Site, load_site
from memorymaze.world.sites.solids import Solid, door_solid, landmark_solid

PLAIN = "numpy, all rays with all edges of the plan"
POSES = 60
REPEATS = 5
SCANS_PER_SECOND = 10.0
"""Of a usual LiDAR, in simulated time."""

FloatArray = NDArray[np.float64]


def run() -> list[Row]:
    rows: list[Row] = []
    for name in BUILTIN_SITE_NAMES:
        site = load_site(name)
        scene = build_scene(site)
        poses = along_routes(site)
        flat, solid = Lidar(scene), Lidar(scene, None, LidarSettings.sixteen_beams())
        edges = edges_at(site, flat.settings.height)
        angles = flat.scan(poses[0]).angles

        rate = scans_per_second(flat, poses)
        rows += [
            Row(
                f"{name}: 2D scans of 360 rays",
                rate,
                "scans/s",
                plain_scans_per_second(edges, poses[::10], angles),
                PLAIN,
                target=1500.0,
                higher_is_better=True,
            ),
            Row(
                f"{name}: 2D scans of 360 rays, {SCANS_PER_SECOND:.0f} a second",
                rate / SCANS_PER_SECOND,
                "x real time",
                higher_is_better=True,
            ),
            Row(
                f"{name}: 3D scans of 16 x {solid.settings.rays} rays",
                scans_per_second(solid, poses[::10]),
                "scans/s",
                target=SCANS_PER_SECOND,
                higher_is_better=True,
            ),
        ]
    return rows


def along_routes(site: Site) -> list[Pose]:
    """Return poses on the reference routes, evenly."""
    lines = [each.line for each in site.routes if each.role == "reference"]
    poses: list[Pose] = []
    for number in range(POSES):
        line = lines[number % len(lines)]
        point = line.interpolate(number / POSES, normalized=True)
        poses.append(Pose(point.x, point.y, 0.1 * number))
    return poses


def scans_per_second(lidar: Lidar, poses: list[Pose]) -> float:
    def all_poses() -> None:
        for pose in poses:
            lidar.scan(pose)

    return len(poses) / processor_seconds(all_poses)


def processor_seconds(call: Callable[[], None]) -> float:
    def once() -> float:
        began = time.process_time()
        call()
        return time.process_time() - began

    return min(once() for _ in range(REPEATS))


def plain_scans_per_second(
    edges: FloatArray, poses: list[Pose], angles: FloatArray
) -> float:
    def all_poses() -> None:
        for pose in poses:
            plain_scan(edges, pose, angles, 20.0)

    return len(poses) / processor_seconds(all_poses)


def edges_at(site: Site, height: float) -> FloatArray:
    """Return what a level ray of this height can hit, as edges, (N, 2, 2) metres."""
    rings = [site.walkable_floor.exterior, *site.walkable_floor.interiors]
    solids = [door_solid(each, site) for each in site.doors]
    solids += [landmark_solid(each, site) for each in site.landmarks]
    rings += [
        footprint(each).exterior
        for each in solids
        if abs(each.position[2] - height) <= each.half_size[2]
    ]
    corners = [np.asarray(ring.coords)[:, :2] for ring in rings]
    return np.concatenate([np.stack([each[:-1], each[1:]], axis=1) for each in corners])


def footprint(solid: Solid) -> Polygon:
    x, y, _ = solid.position
    depth, length, _ = solid.half_size
    cosine, sine = math.cos(solid.heading), math.sin(solid.heading)
    return Polygon([
        (
            x + a * depth * cosine - b * length * sine,
            y + a * depth * sine + b * length * cosine,
        )
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ])


def plain_scan(
    edges: FloatArray, pose: Pose, angles: FloatArray, farthest: float
) -> FloatArray:
    """Return the ranges of a 2D scan, metres, `inf` without a hit."""
    a, b = edges[:, 0] - pose[:2], edges[:, 1] - pose[:2]
    headings = angles + pose.heading
    ux, uy = np.cos(headings)[:, np.newaxis], np.sin(headings)[:, np.newaxis]
    left_of_a = ux * a[:, 1] - uy * a[:, 0]
    left_of_b = ux * b[:, 1] - uy * b[:, 0]
    along_a = ux * a[:, 0] + uy * a[:, 1]
    along_b = ux * b[:, 0] + uy * b[:, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        ranges = (along_a * left_of_b - along_b * left_of_a) / (left_of_b - left_of_a)
    cut = (left_of_a > 0) != (left_of_b > 0)
    return np.where(cut & (ranges > 0) & (ranges <= farthest), ranges, np.inf).min(
        axis=1
    )
