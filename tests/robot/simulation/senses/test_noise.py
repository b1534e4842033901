import math

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.robot.simulation.senses.lidar import LidarSettings
from memorymaze.robot.simulation.senses.noise import (
    NOISE_LEVELS,
    NoiseSettings,
    parse_noise,
)
from memorymaze.robot.simulation.senses.odometry import OdometrySettings


@pytest.mark.parametrize(
    ("text", "lidar", "odometry"),
    [
        pytest.param(
            "heavy",
            LidarSettings(noise=0.03, drop_out=0.05),
            OdometrySettings(
                scale_error=0.02,
                heading_drift=math.radians(0.3),
                distance_noise=0.01,
                heading_noise=math.radians(0.3),
            ),
            id="a level",
        ),
        pytest.param(
            "light, lidar_drop_out=0.2",
            LidarSettings(noise=0.01, drop_out=0.2),
            NOISE_LEVELS["light"].odometry,
            id="a level and an error",
        ),
        pytest.param(
            "lidar_range_noise=0.02,odometry_turn_scale_error=-0.01",
            LidarSettings(noise=0.02),
            OdometrySettings(turn_scale_error=-0.01),
            id="errors alone, all else exact",
        ),
    ],
)
def test_noise_is_read_from_text(
    text: str, lidar: LidarSettings, odometry: OdometrySettings
):
    noise = parse_noise(text)
    assert (noise.lidar, noise.odometry) == (lidar, odometry)
    assert parse_noise(str(noise)) == noise


def test_every_error_is_smaller_in_the_light_than_in_the_heavy():
    light, heavy = (
        dict(part.split("=") for part in str(NOISE_LEVELS[level]).split(","))
        for level in ("light", "heavy")
    )
    assert light.keys() == heavy.keys()
    assert all(float(light[name]) < float(heavy[name]) for name in light)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("huge", "light, heavy"),
        ("heavyy", "did you mean 'heavy'"),
        ("", "light, heavy"),
        ("lidar_noise=1", "lidar_range_noise, lidar_drop_out, odometry_scale_error"),
        ("lidar_drop_out=1.5", "lidar_drop_out: expected a number from 0 to 1"),
        ("lidar_range_noise=-1", "lidar_range_noise: expected a number of at least 0"),
        ("odometry_heading_drift_deg=inf", "heading_drift_deg: expected a number"),
        ("lidar_drop_out=0", "other than 0, got none; leave noise out"),
    ],
)
def test_noise_without_meaning_is_refused_by_name(text: str, named: str):
    with pytest.raises(SettingsError, match=named):
        parse_noise(text)


def test_noise_is_called_by_its_level_or_by_its_errors():
    assert NOISE_LEVELS["heavy"].called == "heavy noise"
    few = NoiseSettings(lidar_drop_out=0.2)
    assert few.called == "noise lidar_drop_out=0.2"
