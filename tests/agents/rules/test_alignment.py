"""Which way is taken at a fork, by what was said and what was met."""

import math
from collections.abc import Sequence

import pytest

from memorymaze.agents.rules.alignment import Aligner
from memorymaze.agents.rules.evidence import Standing
from memorymaze.agents.walking.floor_map import Crossing, FloorMap, Sighting, _View
from memorymaze.understanding import ANY_FLOOR, parse_route_description

FORK = 7
AHEAD, LEFT, RIGHT, BACK = 0.0, math.pi / 2, -math.pi / 2, math.pi
WORDS = {AHEAD: "ahead", LEFT: "left", RIGHT: "right", BACK: "back"}
ASKED = frozenset({"clock", "red sofa"})


def _floor(exits: Sequence[float] = (AHEAD, LEFT, RIGHT, BACK)) -> FloorMap:
    """Return a map of a way of 10 m from the start to a fork."""
    floor = FloorMap()
    floor.crossings[FORK] = Crossing(FORK, (10.0, 0.0), list(exits))
    return floor


def _standing(walked: float = 10.0, *, left: int = 0) -> Standing:
    return Standing(
        FORK,
        AHEAD,
        0,
        walked=walked,
        left=left,
        crossings=left,
        line=((10.0 - walked, 0.0), (10.0, 0.0)),
        asked=ASKED,
    )


def _best(text: str, floor: FloorMap, standing: Standing) -> Standing:
    aligner = Aligner(parse_route_description(text), floor)
    return min(aligner.branches(standing), key=lambda each: aligner.outlook(each))


def _taken(text: str, floor: FloorMap, standing: Standing) -> str:
    return WORDS[floor.crossings[FORK].exits[_best(text, floor, standing).exit]]


def _see(floor: FloorMap, phrase: str, x: float, y: float) -> None:
    """Note a thing as seen from the fork."""
    off = math.dist((10.0, 0.0), (x, y))
    floor.note(
        Sighting(phrase, phrase, 1.0, (x, y), (10.0, 0.0), off, 1, (0, 0), "ahead")
    )


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("Turn left.", "left"),
        ("Turn right.", "right"),
        ("Go straight on. The clock is ahead.", "ahead"),
        ("Take the first left.", "left"),
        ("Take the second left.", "ahead"),
        ("Go to the end and turn left.", "ahead"),
        ("Walk 10 metres and turn left.", "left"),
        ("Walk 80 metres and turn left.", "ahead"),
    ],
)
def test_the_way_taken_at_a_fork_is_the_one_that_was_said(text: str, way: str) -> None:
    assert _taken(text, _floor(), _standing()) == way


def test_an_opening_that_was_passed_counts() -> None:
    text = "Take the second left."
    assert _taken(text, _floor(), _standing(left=0)) == "ahead"
    assert _taken(text, _floor(), _standing(left=1)) == "left"


def test_the_end_is_where_no_way_goes_on() -> None:
    text = "Go to the end and turn left."
    assert _taken(text, _floor([LEFT, RIGHT, BACK]), _standing()) == "left"


@pytest.mark.parametrize(
    ("place", "way"), [((10.5, 1.5), "left"), ((21.0, 0.0), "ahead")]
)
def test_a_turn_at_a_thing_is_made_where_the_thing_is(
    place: tuple[float, float], way: str
) -> None:
    floor = _floor()
    floor.crossings[FORK + 1] = Crossing(FORK + 1, (21.0, 0.0), [LEFT, BACK])
    _see(floor, "clock", *place)
    assert _taken("Go straight and turn left at the clock.", floor, _standing()) == way


def test_what_lies_beyond_the_turn_tells_that_it_was_missed() -> None:
    text = "Turn left. If you see the red sofa you have gone too far."
    floor, standing = _floor(), _standing()
    assert _taken(text, floor, standing) == "left"
    _see(floor, "red sofa", 2.0, 1.0)
    assert _taken(text, floor, standing) != "left"


@pytest.mark.parametrize(("blue", "way"), [(LEFT, "left"), (RIGHT, "right")])
def test_a_way_named_by_its_floor_is_the_one_that_has_it(blue: float, way: str) -> None:
    floor = _floor([LEFT, RIGHT, BACK])
    phrase = "blue floor"
    for number, heading in enumerate(floor.crossings[FORK].exits):
        seen = {ANY_FLOOR: 1.0} | ({phrase: 1.0} if heading == blue else {})
        floor.views[FORK, number] = _View({ANY_FLOOR, phrase}, seen)
    text = "Go forward. Take the blue path."
    assert _taken(text, floor, _standing()) == way


def test_a_decision_says_which_leg_it_took_for_done_and_what_speaks_against_it() -> (
    None
):
    best = _best("Turn left.", _floor(), _standing())
    assert best.leg == 1
    (told,) = best.story
    assert told.startswith(f"leg 1 left at {FORK} (+")
    assert best.cost == pytest.approx(float(told.rpartition("+")[2][:-1]), abs=0.06)


def test_a_corner_without_a_choice_is_followed_though_nobody_told_of_it() -> None:
    floor = _floor([RIGHT, BACK])
    best = _best("Take the third left.", floor, _standing())
    assert best.leg == 0
    assert best.story[-1].startswith("follow the only way")


def test_a_closed_way_is_not_taken() -> None:
    floor = _floor()
    floor.crossings[FORK].closed.add(1)
    assert _taken("Turn left.", floor, _standing()) != "left"
