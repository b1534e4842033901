"""What is made of floors, walls and things seen along ways."""

import math

import pytest

from memorymaze.agents.walking.floor_map import FloorMap, Sighting
from memorymaze.agents.walking.outlooks import (
    LegOutlook,
    first_heading_cost,
    outlook_cost,
    walls_cost,
)
from memorymaze.language.reading import ANY_FLOOR, parse_route_description

EAST, NORTH = 0, 1


def _seen(phrase: str, distance: float, bearing_deg: float = 0.0) -> Sighting:
    place = (distance, 0.0)
    bearing = math.radians(bearing_deg)
    return Sighting(
        phrase, phrase, 1.0, place, (0, 0), distance, 1, (0, 0), "ahead", bearing
    )


@pytest.fixture
def floor() -> FloorMap:
    """A start with a blue way to the east, a red one to the north, no others."""
    floor = FloorMap()
    floor.crossings[0].add_exit(math.pi / 2)
    asked = (ANY_FLOOR, "blue floor", "red floor", "easel")
    floor.note_view(0, EAST, asked, [_seen(ANY_FLOOR, 2.1), _seen("blue floor", 2.1)])
    north = [_seen(ANY_FLOOR, 2.1), _seen("red floor", 2.1), _seen("blue floor", 5.1)]
    floor.note_view(0, NORTH, asked, north)
    return floor


def test_a_way_with_the_floor_said_is_the_likelier_one(floor: FloorMap) -> None:
    blue = LegOutlook(ahead=("blue floor",))
    assert outlook_cost(blue, floor, 0, EAST) < 0 < outlook_cost(blue, floor, 0, NORTH)


def test_a_floor_tells_nothing_where_no_floor_can_be_told() -> None:
    floor = FloorMap()
    floor.note_view(0, EAST, (ANY_FLOOR, "blue floor"), [])
    assert outlook_cost(LegOutlook(ahead=("blue floor",)), floor, 0, EAST) == 0.0


def test_a_thing_at_the_side_does_not_lie_along_a_way() -> None:
    floor = FloorMap()
    floor.note_view(0, EAST, ("easel",), [_seen("easel", 3.0, bearing_deg=40.0)])
    assert outlook_cost(LegOutlook(ahead=("easel",)), floor, 0, EAST) > 0


def test_a_thing_not_seen_counts_more_for_one_who_sees_far(floor: FloorMap) -> None:
    easel = LegOutlook(ahead=("easel",))
    near_sighted = outlook_cost(easel, floor, 0, EAST)
    floor.note(_seen("lamp", 12.0))
    assert outlook_cost(easel, floor, 0, EAST) > near_sighted > 0


def test_a_wall_behind_means_no_way_behind() -> None:
    behind = LegOutlook(walls=("behind",))
    corner = [0.0, math.pi / 2]
    assert walls_cost(behind, corner, set(), 0.0) < 0
    assert walls_cost(behind, [0.0, math.pi], set(), 0.0) > 0


def test_the_first_words_tell_which_way_one_faces(floor: FloorMap) -> None:
    plan = parse_route_description("take the red path to the end . turn left . go on")
    north = first_heading_cost(plan, floor, 0, math.pi / 2)
    east = first_heading_cost(plan, floor, 0, 0.0)
    into_a_wall = first_heading_cost(plan, floor, 0, math.pi)
    assert north < min(east, into_a_wall)
