"""What a log says of a walk."""

import math

import pytest

from memorymaze.agents.closed_loop.walk_log import WalkLog
from memorymaze.agents.walking.floor_map import FloorMap, Point, Sighting, Stretch


def seen(
    label: str, place: Point, track: int, phrase: str = "", score: float = 1.0
) -> Sighting:
    """A thing seen from 2 m along the first way of place 1."""
    return Sighting(
        phrase or label, label, score, place, (0, 0), 2.0, track, (1, 0), "left"
    )


@pytest.fixture
def floor() -> FloorMap:
    """Ways ahead, left and slightly left of place 1, which was come to from the start."""
    floor = FloorMap()
    first = floor.crossings[1] = type(floor.crossings[0])(1, (10.0, 0.0))
    floor.add_stretch(Stretch(0, 0, 1, 0.0, 9.0, frozenset()))
    for degrees in (0, 90, 45):
        first.add_exit(math.radians(degrees))
    first.exits = [first.exits[1], first.exits[2], first.exits[3], first.exits[0]]
    floor.stretches = {
        (0, 0): Stretch(0, 0, 1, 0.0, 9.0, frozenset()),
        (1, 3): Stretch(1, 3, 0, math.pi, 9.0, frozenset()),
    }
    return floor


@pytest.fixture
def log(floor: FloorMap) -> WalkLog:
    log = WalkLog(floor)
    log.arrive(0, 0.0)
    log.arrive(1, 0.0)
    return log


def test_each_place_is_a_line_with_its_ways_from_left_to_right(log: WalkLog) -> None:
    assert log.places.splitlines() == [
        "Place 0 (the start): A ahead, leads to place 1, 10 m.",
        "Place 1 (turning point): B left, not tried; C slight left, not tried; A ahead, "
        "not tried; D back, leads to place 0, 10 m.",
    ]


def test_things_stand_at_the_way_they_were_seen_along_with_side_and_metres(
    floor: FloorMap, log: WalkLog
) -> None:
    for track, place in enumerate([(13, 1.5), (17.6, 1.5), (15, -1.4)]):
        floor.note(seen("door", place, track))
    floor.note_text(seen("Library", (17.6, 1.4), 1))
    seen_ahead = 'left door 3, 8 m, "Library" 8 m | right door 5 m;'
    assert f"A ahead, not tried: {seen_ahead}" in log.places


def test_a_thing_tells_what_it_was_asked_for_as_and_how_well_it_fits(
    floor: FloorMap, log: WalkLog
) -> None:
    floor.note(seen("sofa", (12, 0.2), 1, "red couch", 0.6))
    floor.note(seen("sofa", (12, 0.2), 1, "seat", 0.9))
    assert "A ahead, not tried: ahead sofa [red couch? 0.6; seat] 2 m;" in log.places


def test_ways_are_told_from_the_heading_of_the_last_visit(log: WalkLog) -> None:
    log.arrive(1, math.pi / 2)
    assert log.way_words(1, 0) == "A right"
    assert log.way_words(1, 1) == "B ahead"


def test_ways_in_one_direction_are_told_apart_by_degrees(
    floor: FloorMap, log: WalkLog
) -> None:
    floor.crossings[1].exits[2] = math.radians(117)
    assert log.way_words(1, 2) == "C left +117°"
    assert log.way_words(1, 1) == "B left +90°"


def test_a_way_that_turned_out_to_be_none_is_told_as_such(
    floor: FloorMap, log: WalkLog
) -> None:
    floor.crossings[1].closed.add(1)
    assert "B left, no way through;" in log.places


def test_steps_have_numbers_and_what_came_of_them(log: WalkLog) -> None:
    assert log.steps == "(none yet)"
    log.add_step("On\nto the clock.")
    log.add_outcome("Came to place 1")
    assert log.steps == "1. On to the clock. Came to place 1."


def test_a_start_without_a_known_heading_is_told_as_such(floor: FloorMap) -> None:
    log = WalkLog(floor, any_heading=True)
    log.arrive(0, 0.0)
    assert log.places.startswith("Place 0 (the start, facing any way): A ahead")
