"""What the sketch map tells of crossings, and of what one can see beside a way."""

import math
from dataclasses import replace

import pytest

from memorymaze.agents.walking.floor_map import (
    Crossing,
    FloorMap,
    Sighting,
    is_on_a_pointer,
)


@pytest.mark.parametrize(
    ("metres", "rim", "sure"), [(2.5, 1.0, 1.0), (4.5, 3.0, 1.0), (4.5, 1.0, 0.4)]
)
def test_what_stands_by_the_rim_of_a_crossing_is_at_it_however_wide_that_is(
    metres: float, rim: float, sure: float
) -> None:
    floor = FloorMap()
    assert floor.nearness((metres, 0.0), (0.0, 0.0), rim) == pytest.approx(sure)


def test_a_thing_is_at_the_nearest_crossing_only() -> None:
    floor = FloorMap()
    floor.crossings[1] = Crossing(1, (4.0, 0.0))
    assert floor.nearness((3.0, 0.0), (4.0, 0.0), 1.0) == 1.0
    assert floor.nearness((3.0, 0.0), (0.0, 0.0), 1.0) == 0.0


def test_crossings_not_yet_measured_are_as_wide_as_those_of_the_building() -> None:
    floor = FloorMap()
    for number, rim in ((1, 2.0), (2, 3.0), (3, None)):
        floor.crossings[number] = Crossing(number, (20.0 * number, 0.0), rim=rim)
    assert floor.rim_of(2) == 3.0
    assert floor.rim_of(3) == 2.5


@pytest.mark.parametrize(("aside", "share"), [(1.0, 1.0), (2.3, 0.53), (2.8, 0.25)])
def test_the_wider_a_way_is_the_less_a_camera_sees_that_looks_ahead(
    aside: float, share: float
) -> None:
    floor = FloorMap()
    assert floor.seen_beside == 1.0
    for track in range(6):
        place, seen_from = (track + 3.0, aside), (float(track), 0.0)
        distance, bearing = math.hypot(3.0, aside), math.atan2(aside, 3.0)
        floor.note(
            Sighting(
                "door",
                "door",
                1.0,
                place,
                seen_from,
                distance,
                track,
                (0, 0),
                "left",
                bearing,
            )
        )
    assert floor.seen_beside == pytest.approx(share, abs=0.02)


def _sighting(phrase: str, x: float, track: int) -> Sighting:
    return Sighting(phrase, "sign", 1.0, (x, 0), (0, 0), x, track, (0, 0), "ahead")


def test_words_are_the_thing_only_where_the_thing_itself_is_not_seen() -> None:
    floor = FloorMap()
    assert floor.note_written(_sighting("Café", 5.0, -1))
    assert floor.note_written(_sighting("Café", 9.0, -2))
    door = _sighting("Café", 5.5, 1)
    floor.note(door)
    assert floor.seen("Café") == [_sighting("Café", 9.0, -2), door]
    assert not floor.note_written(_sighting("Café", 5.0, -1))
    assert floor.farthest == 5.5


def test_a_sign_with_an_arrow_points_on() -> None:
    texts = [_sighting("Café \u2192", 5.0, 1), _sighting("Café", 8.0, 2)]
    assert is_on_a_pointer(_sighting("Café", 5.2, 1), texts)
    half_in_view = replace(_sighting("Café", 5.75, 1), label="hanging sign")
    assert is_on_a_pointer(half_in_view, texts)
    assert not is_on_a_pointer(replace(half_in_view, label="door"), texts)
    assert not is_on_a_pointer(_sighting("Café", 8.0, 2), texts)
