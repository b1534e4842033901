"""What one sees through doors and panes, and that nothing of it stands in the way."""

import math
import random
from collections.abc import Iterator
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely import Point, Polygon
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.motion.wheeled_base import ROBOT_GROUP
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.world.cameras import (
    RenderedCamera,
    VisualScene,
    build_visual_scene,
)
from memorymaze.world.looks.doors import is_seen_through
from memorymaze.world.looks.floor_plan import WallSurroundings
from memorymaze.world.sites import load_sites
from memorymaze.world.sites.records import Door, Site

SITES = ("museum_5f", "museum_7f", "university")
ACUTE_CORNERS = {
    "museum_5f": [
        Pose(81.4, 42.8, 3.34),
        Pose(78.4, 47.6, 5.03),
        Pose(80.0, 32.2, 2.67),
        Pose(11.5, 26.5, 0.0),
    ]
}
"""Where boxes of rooms once stood in the floor."""
BEFORE = 1.0
"""Metres from a door to the camera."""
WIDTH, FIELD_OF_VIEW = 160, math.pi / 2
LENS = 0.4
"""Height of the camera over the floor, metres: that of the LiDAR."""
WITHIN = 0.03
"""Metres by which camera and LiDAR may differ."""
ON_PLAN = 0.01
"""Metres from the floor's edge at which a ray has met a wall as the plan has it: walls are
0.1 m thick in the physics, which is more than there is at the tip of an acute corner."""


@pytest.fixture(scope="module", params=SITES)
def site(request: pytest.FixtureRequest) -> Site:
    return load_sites()[request.param]


@pytest.fixture(scope="module")
def looks(site: Site) -> VisualScene:
    return build_visual_scene(site, looks="own")


def before(door: Door, site: Site) -> Pose:
    """Where one stands who looks straight at a door."""
    (ax, ay), (bx, by) = door.line.coords[0][:2], door.line.coords[-1][:2]
    middle = door.line.interpolate(0.5, normalized=True)
    across = np.array([ay - by, bx - ax]) / door.line.length
    if not site.walkable_floor.contains(
        Point(middle.x + across[0], middle.y + across[1])
    ):
        across = -across
    x, y = (middle.x, middle.y) + BEFORE * across
    return Pose(float(x), float(y), math.atan2(-across[1], -across[0]))


def doors_to_rooms(site: Site) -> Iterator[tuple[Door, Pose]]:
    surroundings = WallSurroundings(site)
    for door in site.doors:
        pose = before(door, site)
        middle = door.line.interpolate(0.5, normalized=True)
        behind, _ = surroundings.behind(middle.x, middle.y, pose.heading)
        if is_seen_through(door) and behind == "room":
            yield door, pose


def sky_in(looks: VisualScene, camera: RenderedCamera, pose: Pose) -> NDArray[np.bool_]:
    """Tell the pixels whose colour changes when the sky does."""
    places = looks.sky_places.copy()
    shown = camera.picture(pose)
    looks.sky_places[:] = (0.0, 0.0, -1e4)
    without = camera.picture(pose)
    looks.sky_places[:] = places
    return (shown != without).any(axis=2)


@pytest.mark.proof
def test_through_a_door_to_a_room_one_sees_no_sky(
    site: Site, looks: VisualScene
) -> None:
    seen: dict[str, int] = {}
    with RenderedCamera(looks, WIDTH, WIDTH, math.pi / 4) as camera:
        for door, pose in doors_to_rooms(site):
            frame = camera.frame(pose)
            numbers = [
                number
                for number, each in enumerate(frame.objects)
                if each.record is door
            ]
            through = np.isin(frame.instances, numbers)
            sky = sky_in(looks, camera, pose) & through
            if sky.any():
                seen[door.id] = int(sky.sum())
    assert not seen


@pytest.mark.proof
def test_camera_and_lidar_agree_where_they_see_walls(
    site: Site, looks: VisualScene
) -> None:
    poses = list(random_poses(site, random.Random(1), 150))
    poses += ACUTE_CORNERS.get(site.name, [])
    assert_agree(site, looks, build_scene(site), poses)


def test_nothing_behind_walls_stands_in_the_floor_at_an_acute_corner(
    two_rooms: Site,
) -> None:
    wedge = [(0, 0), (12, 0), (12, 10), (6.6, 10), (6, 4), (5.4, 10), (0, 10)]
    hall = replace(two_rooms.areas[0], polygon=Polygon(wedge), wall_material="glass")
    site = replace(
        two_rooms, areas=(hall,), corridors=(), turning_points=(), rooms=(), doors=(),
        landmarks=(), routes=(),
    )  # fmt: skip
    looks = build_visual_scene(site, looks="own")
    poses = [Pose(4.0, 6.0, 0.0), Pose(8.0, 5.0, math.pi), Pose(6.0, 2.0, math.pi / 2)]
    assert_agree(site, looks, build_scene(site), poses)


def random_poses(site: Site, rng: random.Random, count: int) -> Iterator[Pose]:
    free = site.walkable_floor.buffer(-0.3)
    west, south, east, north = free.bounds
    while count:
        x, y = rng.uniform(west, east), rng.uniform(south, north)
        if free.contains(Point(x, y)):
            count -= 1
            yield Pose(x, y, rng.uniform(-math.pi, math.pi))


def assert_agree(
    site: Site, looks: VisualScene, scene: Scene, poses: list[Pose]
) -> None:
    """Compare the level row of a picture with rays in the physics."""
    data = mujoco.MjData(scene.model)
    mujoco.mj_forward(scene.model, data)
    groups = np.ones(6, dtype=np.uint8)
    groups[ROBOT_GROUP] = 0
    focal = WIDTH / 2 / math.tan(FIELD_OF_VIEW / 2)
    boundary = site.walkable_floor.boundary
    compared, apart = 0, []
    with RenderedCamera(looks, WIDTH, 3, FIELD_OF_VIEW) as camera:
        for pose in poses:
            frame = camera.frame(pose, LENS)
            # A pixel may show whatever lies between its left and its right edge.
            sides = (np.arange(2 * WIDTH + 1) / 2 - WIDTH / 2) / focal
            depths, walls = np.empty(len(sides)), []
            for number, side in enumerate(sides):
                ray = np.array([
                    math.cos(pose.heading) + side * math.sin(pose.heading),
                    math.sin(pose.heading) - side * math.cos(pose.heading),
                    0.0,
                ])
                length = float(np.linalg.norm(ray))
                geom = np.zeros(1, dtype=np.int32)
                start = np.array([pose.x, pose.y, LENS])
                reach = mujoco.mj_ray(
                    scene.model, data, start, ray / length, groups, True, -1, geom
                )
                depths[number] = reach / length
                hit = Point(start[:2] + ray[:2] * depths[number])
                walls.append(
                    reach >= 0
                    and scene.objects[int(geom[0])].kind == "wall"
                    and boundary.distance(hit) < ON_PLAN
                )
            for column in range(WIDTH):
                rays = slice(2 * column, 2 * column + 3)
                shown = frame.object_at(1, column)
                depth = float(frame.depth[1, column])
                if all(walls[rays]) and shown and shown.kind == "wall":
                    compared += 1
                    low, high = depths[rays].min() - WITHIN, depths[rays].max() + WITHIN
                    if not low <= depth <= high and not is_trim(
                        boundary, pose, sides[2 * column + 1], depth, high
                    ):
                        apart.append((pose, column, depth, float(depths[rays][1])))
    assert compared > 20 * len(poses)
    assert not apart, f"{len(apart)} of {compared}: {apart[:5]}"


def is_trim(
    edge: BaseGeometry, pose: Pose, side: float, depth: float, wall: float
) -> bool:
    """Whether it is a bar of a glass wall, 12 mm proud, seen at a grazing angle."""
    x = pose.x + depth * (math.cos(pose.heading) + side * math.sin(pose.heading))
    y = pose.y + depth * (math.sin(pose.heading) - side * math.cos(pose.heading))
    return wall - depth < 0.15 and edge.distance(Point(x, y)) < 0.013
