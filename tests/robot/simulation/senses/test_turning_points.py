import math
from typing import Any

import pytest
from shapely import box

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.senses.turning_points import (
    AnnotatedTurningPoints,
    _Visit,
)
from memorymaze.world.sites import Site


def test_of_overlapping_turning_points_the_nearest_centre_counts(plans: Any) -> None:
    ways = [("way", 0), ("way", 180)]
    site = plans.site(
        plans.corridor("way", 0, -1, 20, 1),
        plans.turning_point("west", box(4, -1, 8, 1), ways),
        plans.turning_point("east", box(6, -1, 10, 1), ways),
    )
    visits = AnnotatedTurningPoints(build_scene(site))
    seen: list[str | None] = []
    for x in (3, 5, 6.5, 7.5, 9, 11):
        visits.update(Pose(x, 0, 0), 0.0, 0.0)
        seen.append(None if visits.current is None else visits.current.point.id)
    assert seen == [None, "west", "west", "east", "east", None]
    assert visits.number is None
    visits.update(Pose(5, 0, 0), math.pi, 0.0)
    assert visits.number == 1


def test_the_way_it_came_is_taken_at_the_edge_not_at_the_end(t_site: Site) -> None:
    visits = AnnotatedTurningPoints(build_scene(t_site))
    visits.update(Pose(0, -2, 0), math.pi / 2, 0.0)
    visits.update(Pose(0, -0.9, 0), math.pi / 2, 0.0)
    visits.update(Pose(0.3, 0, 0), 0.0, 0.0)
    assert visits.current is not None
    assert [each.to for each in visits.current.onward()] == ["bar", "bar"]
    # Out to the east, and back in from there.
    visits.update(Pose(3, 0, 0), 0.0, 0.0)
    visits.update(Pose(0.9, 0, 0), math.pi, 0.0)
    assert {round(math.degrees(each.heading)) for each in visits.current.onward()} == {
        -90,
        180,
    }


def test_an_exit_into_an_area_is_taken_through_the_centre(two_rooms: Site) -> None:
    point = next(each for each in two_rooms.turning_points if each.id == "tp_west")
    hall = next(each for each in point.exits if each.to == "west_hall")
    visit = _Visit(point, build_scene(two_rooms))
    place = visit.meeting_point(hall, (5, 2.5), math.pi / 2)
    assert place == pytest.approx((5, 3), abs=0.01)
