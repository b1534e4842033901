import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.senses.odometry import Odometry, OdometrySettings

places = st.floats(-20, 20)
headings = st.floats(-3, 3)
poses = st.builds(Pose, places, places, headings)


@given(start=poses, ways=st.lists(poses, min_size=1, max_size=5))
def test_without_drift_it_is_the_truth_seen_from_the_start(
    start: Pose, ways: list[Pose]
) -> None:
    odometry = Odometry(start)
    for pose in ways:
        odometry.update(pose)
    x, y, heading = odometry.pose
    cosine, sine = math.cos(start.heading), math.sin(start.heading)
    assert_allclose(
        (start.x + x * cosine - y * sine, start.y + x * sine + y * cosine),
        ways[-1][:2],
        atol=1e-9,
    )
    assert math.cos(start.heading + heading - ways[-1].heading) == pytest.approx(1)


def drive_square(odometry: Odometry) -> Pose:
    """Drive 10 m round a square in steps of 0.1 m, from the origin facing east."""
    x, y = 0.0, 0.0
    for side in range(4):
        heading = side * math.pi / 2
        for _ in range(25):
            x += 0.1 * math.cos(heading)
            y += 0.1 * math.sin(heading)
            odometry.update(Pose(x, y, heading))
        odometry.update(Pose(x, y, heading + math.pi / 2))
    return odometry.pose


def test_adding_up_motions_gives_the_same_place_as_the_truth() -> None:
    nearly = Odometry(Pose(0, 0, 0), OdometrySettings(scale_error=1e-12))
    assert_allclose(drive_square(nearly)[:2], (0, 0), atol=1e-9)


def test_scale_error_stretches_distances() -> None:
    odometry = Odometry(Pose(0, 0, 0), OdometrySettings(scale_error=0.1))
    for step in range(11):
        odometry.update(Pose(step / 10, 0, 0))
    assert odometry.pose == pytest.approx((1.1, 0, 0))


def test_heading_drifts_with_the_distance_and_not_on_the_spot() -> None:
    settings = OdometrySettings(heading_drift=0.02)
    odometry = Odometry(Pose(0, 0, 0), settings)
    odometry.update(Pose(0, 0, 1.0))
    assert odometry.pose.heading == pytest.approx(1.0)
    odometry.update(Pose(3, 0, 1.0))
    assert odometry.pose.heading == pytest.approx(1.06)


def test_turns_are_scaled() -> None:
    odometry = Odometry(Pose(0, 0, 0), OdometrySettings(turn_scale_error=-0.1))
    odometry.update(Pose(0, 0, 1.0))
    assert odometry.pose.heading == pytest.approx(0.9)


def test_noise_grows_with_the_root_of_the_distance_whatever_the_steps() -> None:
    settings = OdometrySettings(distance_noise=0.05, heading_noise=0.02)
    rng = np.random.default_rng(0)
    for steps in (10, 100):
        ends: list[Pose] = []
        for _ in range(200):
            odometry = Odometry(Pose(0, 0, 0), settings, rng)
            for step in range(1, steps + 1):
                odometry.update(Pose(4 * step / steps, 0, 0))
            ends.append(odometry.pose)
        assert np.std([each.x for each in ends]) == pytest.approx(0.1, rel=0.2)
        assert np.std([each.heading for each in ends]) == pytest.approx(0.04, rel=0.2)


def test_the_same_seed_gives_the_same_drift() -> None:
    settings = OdometrySettings(distance_noise=0.05, heading_noise=0.02)
    first, second, other = (
        drive_square(Odometry(Pose(0, 0, 0), settings, np.random.default_rng(seed)))
        for seed in (3, 3, 4)
    )
    assert first == second
    assert first != other


def test_settings_without_meaning_are_refused() -> None:
    with pytest.raises(SettingsError, match="distance_noise"):
        OdometrySettings(distance_noise=-0.1)
    with pytest.raises(SettingsError, match="heading_drift"):
        OdometrySettings(heading_drift=math.inf)
    with pytest.raises(SettingsError, match="generator"):
        Odometry(Pose(0, 0, 0), OdometrySettings(heading_noise=0.1))
