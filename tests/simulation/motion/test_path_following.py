import math

import numpy as np
import pytest

from memorymaze.geometry.pose import Pose
from memorymaze.simulation.motion.lanes import lane_along
from memorymaze.simulation.motion.path_following import LaneFollower

LANE = lane_along(np.array([(0.0, 0.0), (10.0, 0.0)]), 1.0)


def test_it_knows_its_place_beside_the_lane() -> None:
    follower = LaneFollower(LANE)
    follower.update(Pose(4.05, 0.3, 0.1))
    assert follower.offset == pytest.approx(0.3)
    assert follower.remaining == pytest.approx(5.95)
    assert follower.off_course == pytest.approx(0.1)
    assert follower.station.x == pytest.approx(4.0)


@pytest.mark.parametrize("speed", [0.2, 1.0])
@pytest.mark.parametrize("offset", [-0.3, 0.3])
def test_steering_brings_it_back_whatever_the_speed(
    speed: float, offset: float
) -> None:
    follower = LaneFollower(LANE)
    x, y, heading = 0.0, offset, 0.0
    period, aside = 0.05, []
    while x < 8:
        follower.update(Pose(x, y, heading))
        heading += follower.turn_rate(speed) * period
        x += speed * math.cos(heading) * period
        y += speed * math.sin(heading) * period
        aside.append(y)
    assert abs(aside[-1]) < 0.02
    overshoot = -min(math.copysign(1, offset) * each for each in aside)
    assert overshoot < 0.2 * abs(offset)
