"""What CARLA's sensors send, byte by byte, and when."""

import math
from threading import Timer
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from memorymaze.basics.errors import RobotBodyError
from memorymaze.robot.carla.sensors import SensorFeed, depth_of, rgb_of, scan_of


def _picture(*bgra: tuple[int, int, int, int]) -> Any:
    return SimpleNamespace(width=len(bgra), height=1, raw_data=bytes(sum(bgra, ())))


def _points(*points: tuple[float, float]) -> Any:
    rows = [(x, y, 0.0, 1.0) for x, y in points]
    return SimpleNamespace(raw_data=np.array(rows, np.float32).tobytes())


def test_a_picture_comes_as_blue_green_red_and_alpha() -> None:
    assert rgb_of(_picture((1, 2, 3, 255), (4, 5, 6, 0))).tolist() == [
        [[3, 2, 1], [6, 5, 4]]
    ]


def test_depth_is_a_number_of_24_bits_of_which_blue_has_the_highest() -> None:
    depth = depth_of(
        _picture((0, 0, 1, 255), (0, 1, 0, 255), (1, 0, 0, 255), (255, 255, 255, 255))
    )
    step = 1000 / (2**24 - 1)
    assert depth.dtype == np.float32
    assert depth[0] == pytest.approx([step, 256 * step, 65536 * step, math.inf])


def test_a_scan_has_what_is_to_the_left_at_positive_angles() -> None:
    """CARLA's y is to the right."""
    scan = scan_of(_points((0.0, -2.0), (3.0, 0.0)), 7.0)
    assert scan.time == 7.0
    assert len(scan.angles) == 360
    found = {
        round(math.degrees(a)): r for a, r in zip(scan.angles, scan.ranges, strict=True)
    }
    assert found[90] == pytest.approx(2.0)
    assert found[0] == pytest.approx(3.0)
    assert sum(map(math.isfinite, scan.ranges)) == 2


def test_what_is_straight_behind_is_the_first_angle_from_either_side() -> None:
    for aside in (-1e-4, 1e-4):
        scan = scan_of(_points((-5.0, aside)), 0.0)
        assert scan.ranges[0] == pytest.approx(5.0)


def test_an_angle_has_the_ray_that_is_nearest_to_it_and_not_the_shortest() -> None:
    off = math.radians(0.4)
    beside = (2 * math.cos(off), 2 * math.sin(off))
    for points in ((beside, (3.0, 0.0)), ((3.0, 0.0), beside)):
        assert scan_of(_points(*points), 0.0).ranges[180] == pytest.approx(3.0)


def test_the_body_itself_and_what_is_too_far_are_no_returns() -> None:
    scan = scan_of(_points((0.15, 0.0), (0.0, 25.0)), 0.0)
    assert not np.isfinite(scan.ranges).any()
    assert not np.isfinite(scan_of(SimpleNamespace(raw_data=b""), 0.0).ranges).any()  # type: ignore[arg-type]


def _data(frame: int) -> Any:
    return SimpleNamespace(frame=frame)


def test_a_frame_that_comes_late_is_awaited() -> None:
    feed = SensorFeed[Any]("sensor.camera.rgb")
    feed.keep(_data(6))
    Timer(0.02, feed.keep, (_data(7),)).start()
    assert feed.at(7, 5.0).frame == 7


def test_an_older_frame_that_comes_after_a_newer_one_is_left_out() -> None:
    feed = SensorFeed[Any]("sensor.camera.rgb")
    feed.keep(_data(7))
    feed.keep(_data(6))
    assert feed.at(7, 0.0).frame == 7


@pytest.mark.parametrize(
    ("came", "words"),
    [([], "got none"), ([6], "got frame 6 as the last"), ([8], "got frame 8")],
)
def test_a_frame_that_never_comes_is_told_with_its_sensor(
    came: list[int], words: str
) -> None:
    feed = SensorFeed[Any]("sensor.lidar.ray_cast")
    for frame in came:
        feed.keep(_data(frame))
    with pytest.raises(RobotBodyError, match=rf"ray_cast: expected frame 7 .*{words}"):
        feed.at(7, 0.01)
