import math

import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory


def test_a_trajectory_knows_its_points_length_and_duration() -> None:
    walk = Trajectory([
        TimedPose(1.0, 0, 0, 0),
        TimedPose(4.0, 3, 0, 0),
        TimedPose(6.5, 3, 4, 1),
    ])
    assert walk.points.tolist() == [[0, 0], [3, 0], [3, 4]]
    assert (walk.length, walk.duration) == (7.0, 5.5)
    assert walk.poses[2].pose == Pose(3, 4, 1)


def test_turning_on_the_spot_takes_time_and_no_way() -> None:
    turn = Trajectory([TimedPose(0, 1, 1, 0), TimedPose(2, 1, 1, math.pi)])
    assert (turn.length, turn.duration) == (0.0, 2.0)


def test_points_cannot_be_changed() -> None:
    points = Trajectory([TimedPose(0, 1, 2, 0)]).points
    with pytest.raises(ValueError, match="read-only"):
        points[0, 0] = 5


@pytest.mark.parametrize(
    ("poses", "message"),
    [
        pytest.param([], "at least one pose", id="empty"),
        pytest.param([(0, math.nan, 0, 0)], "pose 0 is not finite", id="nan"),
        pytest.param(
            [(2, 0, 0, 0), (1, 0, 0, 0)], "backwards from 2 s", id="backwards"
        ),
    ],
)
def test_what_is_no_trajectory_is_refused(
    poses: list[tuple[float, float, float, float]], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        Trajectory(TimedPose(*pose) for pose in poses)
