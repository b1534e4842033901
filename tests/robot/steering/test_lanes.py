import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.steering.lanes import (
    MIN_CLEARANCE,
    Lane,
    LaneFollower,
    lane_along,
    plan_lane,
)

LANE = lane_along(np.array([(0.0, 0.0), (10.0, 0.0)]), 1.0)


def lane_in(scene: Any, x: float, y: float, course: float = 0.0) -> Lane:
    pose = Pose(x, y, course)
    way = scene.straight_ways.way((x, y), course)
    return plan_lane(way, pose, scene.clearance, 1.0)


@given(
    things=st.lists(
        st.tuples(st.floats(4, 26), st.floats(-1.4, 1.4), st.floats(0, 360)), max_size=6
    )
)
def test_lanes_keep_clear_of_everything_and_end_near_their_line(
    plans: Any, things: list[tuple[float, float, float]]
) -> None:
    crates = [
        plans.thing(f"crate_{number}", x, y, degrees=degrees)
        for number, (x, y, degrees) in enumerate(things)
    ]
    site = plans.site(plans.corridor("way", 0, -2, 30, 2), *crates)
    scene = build_scene(site)
    lane = lane_in(scene, 1, 0)
    points = np.array([(station.x, station.y) for station in lane.stations])
    room = scene.clearance.to_anything(points)
    assert room.min() >= MIN_CLEARANCE - 0.021
    assert np.hypot(*np.diff(points, axis=0).T).max(initial=0) < 0.31
    assert abs(lane.stations[-1].y) <= 0.61
    if lane.end == "wall" and not crates:
        assert lane.stations[-1].x == pytest.approx(29.3)


def test_a_lane_begins_at_the_robot_and_joins_the_middle(plans: Any) -> None:
    scene = build_scene(plans.site(plans.corridor("way", 0, -2, 30, 2)))
    lane = lane_in(scene, 2, 1.0)
    assert (lane.stations[0].x, lane.stations[0].y) == pytest.approx((2, 1))
    slopes = [abs(station.heading) for station in lane.stations]
    assert max(slopes) < math.radians(25)
    assert all(abs(station.y) < 1e-9 for station in lane.stations if station.x > 6.5)


def test_a_lane_at_the_end_of_the_way_is_a_single_place(plans: Any) -> None:
    scene = build_scene(plans.site(plans.corridor("way", 0, -2, 30, 2)))
    lane = lane_in(scene, 29.6, 0)
    assert len(lane.stations) == 1
    assert (lane.length, lane.end) == (0, "wall")


def test_bends_are_driven_slowly() -> None:
    lane = lane_along(np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 3.0)]), 1.0)
    slowest = min(lane.stations, key=lambda station: station.speed)
    assert slowest.speed < 0.6
    assert math.dist((slowest.x, slowest.y), (3, 0)) < 0.5
    assert lane.stations[0].speed == 1.0


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
