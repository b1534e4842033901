import math
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.senses.lidar import Lidar, LidarSettings


@pytest.fixture(scope="module")
def hall(plans: Any) -> Scene:
    """40 m by 4 m along y = 0, a box of 0.5 m at (5, 0) and a low step at (3, 0)."""
    return build_scene(
        plans.site(
            plans.area("hall", plans.corridor("", -20, -2, 20, 2).polygon),
            plans.thing("box", 5, 0),
            plans.thing("step", 3, 0, size=(0.5, 0.5, 0.2)),
        )
    )


def range_at(scan: Any, degrees: float) -> float:
    return float(scan.ranges[np.abs(scan.angles - math.radians(degrees)).argmin()])


def test_a_scan_measures_walls_and_things_at_its_height(hall: Scene) -> None:
    scan = Lidar(hall).scan(Pose(0, 0.1, 0), time=3.0)
    assert scan.time == 3.0
    assert scan.ranges.shape == scan.angles.shape == (360,)
    assert range_at(scan, 0) == pytest.approx(4.75)
    assert range_at(scan, 90) == pytest.approx(1.9)
    assert range_at(scan, -90) == pytest.approx(2.1)
    assert range_at(scan, -180) == pytest.approx(20.0)
    low = Lidar(hall, None, LidarSettings(height=0.1)).scan(Pose(0, 0.1, 0))
    assert range_at(low, 0) == pytest.approx(2.75)


def test_angles_are_relative_to_the_robot(hall: Scene) -> None:
    scan = Lidar(hall).scan(Pose(0, 0.1, math.pi / 2))
    assert range_at(scan, 0) == pytest.approx(1.9)
    assert range_at(scan, -90) == pytest.approx(4.75)


def test_beyond_and_below_its_range_nothing_comes_back(hall: Scene) -> None:
    scan = Lidar(hall, None, LidarSettings(nearest=2.0, farthest=6.0)).scan(
        Pose(0, 0.1, 0)
    )
    assert range_at(scan, -180) == math.inf
    assert range_at(scan, 90) == math.inf
    assert range_at(scan, -90) == pytest.approx(2.1)
    assert not np.isnan(scan.ranges).any()


def test_sixteen_beams_reach_floor_and_ceiling(hall: Scene) -> None:
    lidar = Lidar(hall, None, LidarSettings.sixteen_beams(rays=90))
    scan = lidar.scan(Pose(-10, 0, 0))
    assert scan.ranges.shape == (16, 90)
    assert_allclose(scan.elevations[[0, -1]], np.radians([-15, 15]))
    ahead = int(np.abs(scan.angles).argmin())
    assert scan.ranges[0, ahead] == pytest.approx(0.4 / math.sin(math.radians(15)))
    assert scan.ranges[-1, ahead] == pytest.approx(2.6 / math.sin(math.radians(15)))
    points = scan.points()
    assert len(points) == np.isfinite(scan.ranges).sum()
    assert np.abs(points[:, 1]).max() == pytest.approx(2.0)
    assert points[:, 2].min() == pytest.approx(-0.4)
    assert points[:, 2].max() == pytest.approx(2.6)


def test_noise_and_drop_outs_are_as_set_and_repeat_with_the_seed(hall: Scene) -> None:
    exact = Lidar(hall).scan(Pose(2, 0.1, 0)).ranges[90:270]
    settings = LidarSettings(noise=0.05, drop_out=0.2)
    noisy = [
        np.concatenate([lidar.scan(Pose(2, 0.1, 0)).ranges[90:270] for _ in range(40)])
        for lidar in (
            Lidar(hall, None, settings, np.random.default_rng(seed))
            for seed in (1, 1, 2)
        )
    ]
    assert_array_equal(noisy[0], noisy[1])
    assert (noisy[0] != noisy[2]).any()
    kept = np.isfinite(noisy[0])
    assert 0.75 < kept.mean() < 0.85
    errors = (noisy[0] - np.tile(exact, 40))[kept]
    assert 0.045 < errors.std() < 0.055
    assert abs(errors.mean()) < 0.005


@pytest.mark.parametrize(
    ("settings", "named"),
    [
        ({"rays": 0}, "rays"),
        ({"rays": 1.5}, "rays"),
        ({"farthest": -1.0}, "nearest"),
        ({"drop_out": 1.1}, "drop_out"),
        ({"noise": math.nan}, "noise"),
    ],
)
def test_settings_without_meaning_are_refused(
    settings: dict[str, Any], named: str
) -> None:
    with pytest.raises(SettingsError, match=named):
        LidarSettings(**settings)


def test_noise_needs_a_source(hall: Scene) -> None:
    with pytest.raises(SettingsError, match="generator"):
        Lidar(hall, None, LidarSettings(noise=0.01))


def test_the_robot_does_not_see_itself(hall: Scene, put_robot: Any) -> None:
    robot = put_robot(hall, 0, 0.1)
    assert_allclose(robot.lidar_scan().ranges, Lidar(hall).scan(robot.pose).ranges)
