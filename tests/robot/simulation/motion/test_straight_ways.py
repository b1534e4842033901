import math
from typing import Any

import pytest
from shapely import Polygon, box

from memorymaze.robot.simulation.scene import Scene, build_scene


def test_a_corridor_turned_into_is_followed_whatever_its_angle(
    scenes: dict[str, Scene],
) -> None:
    ways = scenes["slanted_crossing"].straight_ways
    chosen = ways.way((0, 0), math.radians(10), towards="slant")
    assert math.degrees(chosen.courses[0]) == pytest.approx(50, abs=0.1)
    other = ways.way((0, 0), math.radians(10))
    assert math.degrees(other.courses[0]) == pytest.approx(0, abs=0.1)


@pytest.mark.parametrize(("fresh", "joins"), [(True, True), (False, False)])
def test_only_after_a_turn_a_corridor_is_joined_at_a_large_angle(
    plans: Any, fresh: bool, joins: bool
) -> None:
    site = plans.site(
        plans.area("hall", box(0, -5, 10, 5)), plans.corridor("way", 10, -2, 30, 2)
    )
    ways = build_scene(site).straight_ways
    way = ways.way((2, 4), math.radians(-25), fresh=fresh)
    assert (way.points[-1] == pytest.approx((30, 0))) is joins


def test_a_pillar_on_the_line_does_not_end_the_way(plans: Any) -> None:
    floor = Polygon(
        box(0, -5, 20, 5).exterior.coords,
        [box(9.7, -0.3, 10.3, 0.3).exterior.coords],
    )
    way = build_scene(plans.site(plans.area("hall", floor))).straight_ways.way(
        (1, 0), 0.0
    )
    assert way.points[-1] == pytest.approx((20, 0))


def test_a_block_on_the_line_ends_the_way(plans: Any) -> None:
    floor = Polygon(
        box(0, -5, 20, 5).exterior.coords, [box(9, -1, 12, 1).exterior.coords]
    )
    way = build_scene(plans.site(plans.area("hall", floor))).straight_ways.way(
        (1, 0), 0.0
    )
    assert way.points[-1] == pytest.approx((9, 0))
