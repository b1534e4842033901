"""Turning points by LiDAR; those of plans are tested in `simulation/senses`."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import pytest
from shapely import Polygon, box

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose, heading_to, turn_between
from memorymaze.robot.api.control import Direction
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.senses.lidar import Lidar, LidarSettings
from memorymaze.robot.simulation.senses.odometry import Odometry, OdometrySettings
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.commands import direction_of
from memorymaze.robot.steering.turning_points import SCAN_PERIOD, LidarTurningPoints

BY_LIDAR = SimulationSettings(turning_points="lidar")
NOISY = {
    "lidar": LidarSettings(noise=0.03, drop_out=0.05),
    "odometry": OdometrySettings(
        scale_error=0.02, heading_drift=0.005, distance_noise=0.01, heading_noise=0.005
    ),
}


class Sighting(NamedTuple):
    """What the robot knew at one place."""

    number: int
    directions: frozenset[Direction | None]
    headings: tuple[float, ...]
    x: float
    y: float


def drive(
    scene: Scene, line: list[tuple[float, float]], seed: int = 0, **sensors: Any
) -> list[Sighting]:
    """Carry the sensors along a line, 0.2 m from scan to scan."""
    poses = [
        Pose(x, y, heading_to(begin, end))
        for begin, end in pairwise(line)
        for x, y in np.linspace(begin, end, math.ceil(math.dist(begin, end) / 0.2) + 1)
    ]
    rng = np.random.default_rng(seed)
    source = LidarTurningPoints(
        Lidar(scene, None, sensors.get("lidar"), rng).scan,
        poses[0],
        Odometry(poses[0], sensors.get("odometry"), rng).update,
    )
    seen: list[Sighting] = []
    for step, pose in enumerate(poses):
        source.update(pose, pose.heading, SCAN_PERIOD * step)
        if source.number is not None and source.current is not None:
            headings = tuple(way.heading for way in source.current.onward())
            found = frozenset(
                direction_of(turn_between(pose.heading, each)) for each in headings
            )
            seen.append(Sighting(source.number, found, headings, pose.x, pose.y))
    return seen


def corridors(plans: Any, *floors: Polygon | tuple[float, ...], **more: Any) -> Scene:
    """Build a scene of pieces of floor, without a single annotation."""
    parts = [
        plans.area(f"floor_{number}", box(*each) if isinstance(each, tuple) else each)
        for number, each in enumerate(floors)
    ]
    return build_scene(plans.site(*parts, *more.get("things", ())))


@pytest.mark.parametrize("width", [1.8, 2.4, 4.0])
@pytest.mark.parametrize("noise", [{}, NOISY], ids=["exact", "noisy"])
def test_a_t_junction_leaves_left_and_right(
    plans: Any, width: float, noise: dict[str, Any]
) -> None:
    half = width / 2
    scene = corridors(plans, (-half, -14, half, half), (-14, -half, 14, half))
    seen = drive(scene, [(0, -10), (0, 0)], **noise)
    assert {each.number for each in seen} == {1}
    assert {each.directions for each in seen} == {frozenset({"left", "right"})}
    assert -half - 0.8 < seen[0].y < -half + 1.0


@pytest.mark.parametrize("noise", [{}, NOISY], ids=["exact", "noisy"])
def test_a_crossing_leaves_three_ways_and_ends_behind_it(
    plans: Any, noise: dict[str, Any]
) -> None:
    scene = corridors(plans, (-1.2, -14, 1.2, 14), (-14, -1.2, 14, 1.2))
    seen = drive(scene, [(-10, 0), (10, 0)], **noise)
    assert {each.number for each in seen} == {1}
    all_three = frozenset({"left", "right", "forward"})
    assert {each.directions for each in seen} == {all_three}
    assert -2.2 < seen[0].x < 0 < seen[-1].x < 2.2


@pytest.mark.parametrize(("set_off", "numbers"), [(0, {1}), (3, {1, 2})])
def test_ways_that_do_not_face_each_other_are_two_turning_points(
    plans: Any, api_says: Callable[[str], None], set_off: float, numbers: set[int]
) -> None:
    api_says("that do not face each other are two turning points")
    scene = corridors(
        plans,
        (-14, -1.2, 14, 1.2),
        (-1.2, 0, 1.2, 12),
        (set_off - 1.2, -12, set_off + 1.2, 0),
    )
    seen = drive(scene, [(-10, 0), (12, 0)])
    assert {each.number for each in seen} == numbers
    assert any({"left", "right"} <= each.directions for each in seen) == (not set_off)


def test_a_corner_leaves_one_way(plans: Any) -> None:
    scene = corridors(plans, (-14, -1.2, 1.2, 1.2), (-1.2, -14, 1.2, 1.2))
    seen = drive(scene, [(-10, 0), (0, 0)])
    assert {each.directions for each in seen} == {frozenset({"right"})}


def test_ways_at_a_slant_are_told_apart(scenes: dict[str, Scene]) -> None:
    seen = drive(scenes["slanted_crossing"], [(-10, 0), (0, 0)])
    assert {each.directions for each in seen} == {
        frozenset({"forward", "slight_left", "right"})
    }


@pytest.mark.parametrize("noise", [{}, NOISY], ids=["exact", "noisy"])
def test_a_corridor_with_doors_and_a_bench_has_no_turning_point(
    scenes: dict[str, Scene], noise: dict[str, Any]
) -> None:
    assert drive(scenes["corridor"], [(2, 0), (17, 0)], **noise) == []


def test_door_niches_nooks_and_things_are_no_ways(plans: Any) -> None:
    scene = corridors(
        plans,
        (-12, -1.2, 12, 1.2),
        (-6.0, 1.2, -4.8, 2.0),  # a door set back, or left ajar
        (-1.5, 1.2, 1.5, 3.2),  # a nook 3 m wide and 2 m deep
        (5.0, -2.0, 6.2, -1.2),
        things=[
            plans.thing("cupboard", -3.5, -0.9, size=(1.5, 0.6, 2.0), degrees=90),
            plans.thing("machine", 3.5, 0.85, size=(1.0, 0.7, 1.8), degrees=-90),
            plans.thing("plant", 4.6, 0.85),
        ],
    )
    assert drive(scene, [(-10, 0), (10, 0)]) == []


def test_a_pillar_does_not_part_a_way(plans: Any) -> None:
    scene = corridors(
        plans,
        (-14, -3, 14, 3),
        things=[plans.thing("pillar", 4, 0, size=(0.6, 0.6, 3.0))],
    )
    assert drive(scene, [(-10, -1.5), (9, -1.5)]) == []


def test_coming_back_finds_the_same_number(plans: Any) -> None:
    scene = corridors(
        plans, (-14, -1.2, 14, 1.2), (-6.2, 0, -3.8, 10), (3.8, 0, 6.2, 10)
    )
    seen = drive(scene, [(-10, 0), (9, 0), (-10, 0)])
    numbers = [each.number for each in seen]
    order = [
        n for n, before in zip(numbers, [0, *numbers], strict=False) if n != before
    ]
    assert order == [1, 2, 1]
    ways_out = {1: "left", 2: "right"}
    there = numbers.index(2)
    for each in seen[:there]:
        assert each.directions == {"forward", ways_out[1]}
    for each in seen[numbers.index(1, there) :]:
        assert each.directions == {"forward", "right"}


def test_turning_faces_the_way_and_keeps_to_the_middle(plans: Any) -> None:
    scene = corridors(plans, (-14, -1.2, 14, 1.2), (-1.2, 0, 1.2, 14))
    robot = SimulatedRobot(scene, Pose(-8, 0, 0), BY_LIDAR)
    assert not robot.turn("left").turned
    while "left" not in robot.detect_turning_point():
        assert robot.move_forward(0.5).reason == "done"
    assert robot.turn("left").turned
    assert math.degrees(robot.pose.heading) == pytest.approx(90, abs=2)
    assert robot.pose.x == pytest.approx(0, abs=0.2)
    assert set(robot.detect_turning_point()) == {"forward", "right"}
    robot.move_forward(6)
    assert robot.detect_turning_point() == []
    assert robot.pose[:2] == pytest.approx((0, 6), abs=0.3)


def test_the_same_seed_gives_the_same_walk_and_answers(
    scenes: dict[str, Scene],
) -> None:
    line = [(-8.0, 0.0), (3.0, 0.0)]
    first, second, other = (
        drive(scenes["crossing"], line, seed, **NOISY) for seed in (5, 5, 6)
    )
    assert first == second
    assert first != other


def test_a_lidar_with_many_beams_is_refused(scenes: dict[str, Scene]) -> None:
    with pytest.raises(SettingsError, match="1 beam"):
        SimulatedRobot(
            scenes["corridor"],
            Pose(2, 0, 0),
            BY_LIDAR,
            lidar=LidarSettings.sixteen_beams(),
        )
