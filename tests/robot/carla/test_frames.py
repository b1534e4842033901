"""By CARLA's own transforms: left-handed, degrees."""

import math

import carla
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.carla.frames import pose_of, transform_of

POSES = st.builds(
    Pose, *[st.floats(-200, 200)] * 2, st.floats(-math.pi, math.pi, exclude_min=True)
)


@pytest.mark.parametrize(
    ("heading", "ahead", "left"),
    [
        (0.0, (1, 0), (0, -1)),
        (math.pi / 2, (0, -1), (-1, 0)),
        (math.pi, (-1, 0), (0, 1)),
        (-math.pi / 2, (0, 1), (1, 0)),
    ],
)
def test_north_is_minus_y_and_left_is_against_the_yaw(
    heading: float, ahead: tuple[int, int], left: tuple[int, int]
) -> None:
    transform = transform_of(Pose(3, 4, heading), 0.5)
    place = transform.location
    assert (place.x, place.y, place.z) == (3, -4, 0.5)
    forward, right = transform.get_forward_vector(), transform.get_right_vector()
    assert (forward.x, forward.y) == pytest.approx(ahead, abs=1e-6)
    assert (-right.x, -right.y) == pytest.approx(left, abs=1e-6)


@given(POSES)
def test_a_pose_is_the_same_after_there_and_back(pose: Pose) -> None:
    back = pose_of(transform_of(pose))
    assert (back.x, back.y) == pytest.approx((pose.x, pose.y), abs=2e-5)
    assert turn_between(pose.heading, back.heading) == pytest.approx(0, abs=2e-6)


@given(POSES, st.floats(-20, 20), st.floats(-20, 20))
def test_what_a_robot_sees_is_where_carla_puts_it(
    pose: Pose, ahead: float, left: float
) -> None:
    """A point by the robot's axes, through CARLA's transform and by ours."""
    there = transform_of(pose).transform(carla.Location(ahead, -left, 0))
    cosine, sine = math.cos(pose.heading), math.sin(pose.heading)
    ours = pose.x + ahead * cosine - left * sine, pose.y + ahead * sine + left * cosine
    assert (there.x, -there.y) == pytest.approx(ours, abs=1e-4)
