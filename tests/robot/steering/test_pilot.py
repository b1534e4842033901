import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from shapely import LineString, Polygon, box
from shapely.affinity import rotate
from tests.robot.simulation.conftest import PutRobot

from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene

ApiSays = Callable[[str], None]


def walk_until(robot: SimulatedRobot, direction: str) -> None:
    for _ in range(100):
        if direction in robot.detect_turning_point():
            return
        assert robot.move_forward(0.5).reason == "done", robot.pose
    raise AssertionError(f"never met a way {direction}")


def offsets_from(robot: SimulatedRobot, line: list[tuple[float, float]]) -> np.ndarray:
    from shapely import Point

    way = LineString(line)
    points = robot.trajectory().points
    return np.array([way.distance(Point(point)) for point in points])


def test_halts_before_the_wall_at_the_end(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 1, 0)
    result = robot.move_forward(100)
    assert result.reason == "wall"
    assert result.distance == pytest.approx(robot.pose.x - 1, abs=0.02)
    assert robot.pose.x == pytest.approx(20 - 0.7, abs=0.03)
    assert robot.move_forward(1).distance < 0.02
    assert robot.collisions == ()


def test_halts_at_a_corner_inside_its_turning_point(put_robot: PutRobot) -> None:
    robot = put_robot("l_shape", 1, 0)
    result = robot.move_forward(100)
    assert result.reason == "wall"
    assert robot.pose.x == pytest.approx(12 - 0.7, abs=0.03)
    assert abs(robot.pose.heading) < 0.02, "it must not begin to turn the corner"
    assert robot.detect_turning_point() == ["left"]


@pytest.mark.parametrize(
    ("x", "y", "degrees", "expected"),
    [
        pytest.param(0, -8, 90, ["left", "right"], id="from the stem"),
        pytest.param(-9, 0, 0, ["right", "forward"], id="from the west"),
        pytest.param(9, 0, 180, ["left", "forward"], id="from the east"),
    ],
)
def test_tells_the_ways_on_from_each_side_of_a_t_junction(
    put_robot: PutRobot, x: float, y: float, degrees: float, expected: list[str]
) -> None:
    robot = put_robot("t_junction", x, y, degrees)
    while not robot.detect_turning_point():
        assert robot.move_forward(0.5).reason == "done"
    assert robot.detect_turning_point() == expected
    assert robot.turning_point_id() is not None


@pytest.mark.parametrize(("direction", "end"), [("left", -11.3), ("right", 11.3)])
def test_turns_into_the_middle_of_the_way_chosen(
    put_robot: PutRobot, direction: str, end: float
) -> None:
    robot = put_robot("t_junction", 0, -9, 90)
    walk_until(robot, direction)
    result = robot.turn(direction)
    assert result.turned
    assert result.angle_deg == pytest.approx(90 if direction == "left" else -90, abs=2)
    while robot.move_forward(0.5).reason == "done":
        pass
    assert robot.pose.x == pytest.approx(end, abs=0.05)
    assert offsets_from(robot, [(0, -9), (0, 0), (end, 0)]).max() < 0.1
    assert robot.collisions == ()


def test_turns_after_overrunning_the_junction_to_its_wall(put_robot: PutRobot) -> None:
    robot = put_robot("t_junction", 0, -9, 90)
    assert robot.move_forward(50).reason == "wall"
    assert robot.turn("left").turned
    assert robot.pose.y == pytest.approx(0, abs=0.05)
    assert robot.pose.heading == pytest.approx(math.pi, abs=0.02)


def test_goes_straight_on_over_a_crossing(put_robot: PutRobot) -> None:
    robot = put_robot("crossing", -10, 0)
    robot.move_forward(18)
    assert robot.pose.x == pytest.approx(8, abs=0.05)
    assert offsets_from(robot, [(-12, 0), (12, 0)]).max() < 0.05


def test_finds_slanted_ways_by_their_own_word_and_by_left(put_robot: PutRobot) -> None:
    for word in ("slight_left", "left"):
        robot = put_robot("slanted_crossing", -10, 0)
        walk_until(robot, "slight_left")
        assert robot.detect_turning_point() == ["right", "forward", "slight_left"]
        assert robot.turn(word).turned
        assert robot.pose.heading == pytest.approx(math.radians(50), abs=0.02)
        robot.move_forward(6)
        assert offsets_from(robot, [(-12, 0), (0, 0), (7.071, 8.426)]).max() < 0.15


def test_refuses_a_direction_without_a_way_and_says_what_there_is(
    put_robot: PutRobot,
) -> None:
    robot = put_robot("l_shape", 1, 0)
    walk_until(robot, "left")
    before = robot.time
    result = robot.turn("right")
    assert not result.turned
    assert result.angle_deg == 0
    assert "left, around" in result.message
    assert robot.time == before
    assert robot.refused_turns == 1


def test_turns_nowhere_but_around_outside_turning_points(put_robot: PutRobot) -> None:
    robot = put_robot("l_shape", 5, 0)
    assert robot.detect_turning_point() == []
    assert robot.turning_point_id() is None
    assert "not a turning point" in robot.turn("left").message
    assert robot.turn("around").turned
    assert abs(robot.pose.heading) == pytest.approx(math.pi, abs=0.02)
    robot.move_forward(3)
    assert robot.pose.x == pytest.approx(2, abs=0.1)


def test_suggests_a_direction_for_a_misspelt_one(put_robot: PutRobot) -> None:
    robot = put_robot("l_shape", 11, 0)
    result = robot.turn("lefft")
    assert not result.turned
    assert "did you mean 'left'" in result.message


def test_numbers_turning_points_in_the_order_it_meets_them(put_robot: PutRobot) -> None:
    robot = put_robot("loop", 1, 4, 90)
    seen = []
    for _ in range(5):
        walk_until(robot, "right")
        seen.append(robot.turning_point_id())
        robot.turn("right")
        here = robot.turning_point_id()
        while robot.turning_point_id() == here:
            robot.move_forward(0.5)
    assert seen == [1, 2, 3, 4, 1]


def test_passes_an_obstacle_and_returns_to_the_middle(
    plans: Any, put_robot: PutRobot
) -> None:
    site = plans.site(
        plans.corridor("way", 0, -1.5, 20, 1.5), plans.thing("crate", 10, 0.2)
    )
    robot = put_robot(build_scene(site), 1, 0)
    assert robot.move_forward(16).reason == "done"
    offsets = offsets_from(robot, [(0, 0), (20, 0)])
    assert offsets.max() > 0.3
    assert abs(robot.pose.y) < 0.1
    assert robot.collisions == ()


def test_halts_before_a_gap_that_is_too_narrow(
    plans: Any, put_robot: PutRobot, api_says: ApiSays
) -> None:
    api_says("for a person try again, which waits again; for a thing that never helps")
    site = plans.site(
        plans.corridor("way", 0, -1, 20, 1),
        plans.thing("north", 10, 0.65, size=(0.8, 0.5, 1.0)),
        plans.thing("south", 10, -0.65, size=(0.8, 0.5, 1.0)),
    )
    robot = put_robot(build_scene(site), 1, 0)
    result = robot.move_forward(16)
    assert result.reason == "obstacle"
    assert 9 < robot.pose.x < 9.6
    again = robot.move_forward(1)
    assert (again.reason, again.distance) == ("obstacle", pytest.approx(0, abs=0.02))
    assert robot.collisions == ()


def test_a_thing_at_the_end_wall_is_the_end(plans: Any, put_robot: PutRobot) -> None:
    site = plans.site(
        plans.corridor("way", 0, -1, 10, 1),
        plans.thing("bench", 9.7, 0, size=(1.8, 0.5, 0.5)),
    )
    robot = put_robot(build_scene(site), 1, 0)
    assert robot.move_forward(16).reason == "wall"
    assert robot.collisions == ()


def test_drives_under_hanging_signs_and_past_posters(
    plans: Any, put_robot: PutRobot
) -> None:
    site = plans.site(
        plans.corridor("way", 0, -1, 10, 1),
        plans.thing("sign", 5, 0, mount="ceiling", obstacle=False),
        plans.thing("mat", 7, 0, size=(1.0, 1.0, 0.01), obstacle=False),
    )
    robot = put_robot(build_scene(site), 1, 0)
    robot.move_forward(8)
    assert offsets_from(robot, [(0, 0), (10, 0)]).max() < 0.05
    assert robot.collisions == ()


def test_goes_straight_on_through_open_areas(put_robot: PutRobot) -> None:
    robot = put_robot("two_rooms", 1, 3.3)
    result = robot.move_forward(30)
    assert result.reason == "wall"
    assert robot.pose.x == pytest.approx(17.3, abs=0.05)
    in_passage = [
        abs(pose.y - 3) for pose in robot.trajectory().poses if 7 < pose.x < 12
    ]
    assert max(in_passage) < 0.15
    assert robot.collisions == ()


def test_follows_on_into_a_corridor_set_off_to_the_side(
    plans: Any, put_robot: PutRobot
) -> None:
    site = plans.site(
        plans.corridor("first", 0, -1.2, 10, 1.2),
        plans.corridor("second", 10, -0.4, 20, 2.0),
    )
    robot = put_robot(build_scene(site), 1, 0)
    assert robot.move_forward(17).reason == "done"
    assert robot.pose.y == pytest.approx(0.8, abs=0.1)
    assert robot.collisions == ()


def test_does_not_swerve_into_a_slanted_side_corridor(put_robot: PutRobot) -> None:
    robot = put_robot("slanted_crossing", -10, 0)
    robot.move_forward(18)
    assert robot.pose.x == pytest.approx(8, abs=0.05)
    assert abs(robot.pose.y) < 0.05


def bend(plans: Any, degrees: float) -> Any:
    """Two corridors 3 m wide that meet at (10, 0) at an angle."""
    second = rotate(box(8, -1.5, 22, 1.5), degrees, origin=(10, 0))
    point = Polygon([(8, -1.5), (11.5, -1.5), (12, 2), (8, 2)]).intersection(
        box(0, -1.5, 12, 1.5).union(second)
    )
    return plans.site(
        plans.corridor("first", 0, -1.5, 12, 1.5),
        plans.slanted_corridor("second", second),
        plans.turning_point(
            "bend", point.convex_hull, [("first", 180), ("second", degrees)]
        ),
    )


@pytest.mark.parametrize("degrees", [10, 14])
def test_follows_a_slight_bend(
    plans: Any, put_robot: PutRobot, api_says: ApiSays, degrees: float
) -> None:
    api_says("It follows bends of up to 15 degrees; sharper ones are turning points")
    robot = put_robot(build_scene(bend(plans, degrees)), 1, 0)
    assert robot.move_forward(18).reason == "done"
    assert robot.pose.heading == pytest.approx(math.radians(degrees), abs=0.03)
    assert robot.collisions == ()


@pytest.mark.parametrize("degrees", [17, 25])
def test_halts_in_the_turning_point_of_a_real_bend(
    plans: Any, put_robot: PutRobot, api_says: ApiSays, degrees: float
) -> None:
    api_says("in which it halts with `wall` until `turn` is called")
    robot = put_robot(build_scene(bend(plans, degrees)), 1, 0)
    assert robot.move_forward(18).reason == "wall"
    assert robot.move_forward(1).distance < 0.05
    assert robot.detect_turning_point() == ["slight_left"]
    assert robot.turn("slight_left").turned
    assert robot.move_forward(8).reason == "done"
    assert robot.pose.heading == pytest.approx(math.radians(degrees), abs=0.03)
    assert robot.collisions == ()


def test_crosses_a_lobby_into_the_passage_opposite(
    plans: Any, put_robot: PutRobot
) -> None:
    site = plans.site(
        plans.corridor("hall", 0, -1, 8, 1),
        plans.area("lobby", box(8, -5, 18, 5)),
        plans.corridor("passage", 18, 1, 28, 3),
    )
    robot = put_robot(build_scene(site), 1, 0)
    assert robot.move_forward(25).reason == "done"
    assert robot.pose.y == pytest.approx(2, abs=0.1)
    assert robot.collisions == ()


def test_at_the_start_the_way_behind_counts_as_the_way_it_came(
    put_robot: PutRobot,
) -> None:
    robot = put_robot("t_junction", 0, 0, 180)
    assert robot.detect_turning_point() == ["left", "forward"]
