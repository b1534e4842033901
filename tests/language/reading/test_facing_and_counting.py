"""Descriptions by floors, places counted and facing, and repairs of misreadings."""

import pytest

from memorymaze.language.plans import Mention, RoutePlan, Side, Start
from memorymaze.language.reading import floor_phrase, parse_route_description


def _ways(plan: RoutePlan) -> str:
    return " ".join(leg.turn.way for leg in plan.legs)


@pytest.mark.parametrize(
    ("words", "look"),
    [
        ("blue path", "blue floor"),
        ("pink-flowered carpet hall", "flowered floor"),
        ("bare concrete hall", "concrete floor"),
        ("yellow stone flooring", "yellow floor"),
        ("grass", "grass floor"),
        ("glass corridor", None),
        ("vending machine hall", None),
        ("wooden chair", None),
        ("carpet", "carpet floor"),
        ("tiled corridor", "tile floor"),
        ("carpet shop", None),
    ],
)
def test_ways_are_known_by_their_floors(words: str, look: str | None) -> None:
    assert floor_phrase(words) == look


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        ("go forward two segments . turn left", [2, None]),
        ("walk forward once . turn left . walk forward three times", [1, 3]),
        ("move one block and turn right . forward 2 . turn left", [1, 2, None]),
        ("turn left . the goal is one intersection past the clock", [None, 1]),
        ("turn right . move to the second alley", [None, 2]),
        ("I watched the video twice. Turn left.", [None, None]),
        ("You see two blocks of seats. Turn left.", [None, None]),
    ],
)
def test_places_to_turn_are_counted(text: str, counts: list[float | None]) -> None:
    plan = parse_route_description(text)
    lengths = [*(leg.length for leg in plan.legs), plan.arrival.length]
    assert [each.count if each else None for each in lengths] == counts


def test_what_one_faces_at_first_is_said_of_the_start() -> None:
    plan = parse_route_description(
        "face the easel . turn left . go forward one segment"
    )
    assert _ways(plan) == "left"
    assert plan.start == Start(facing="easel")
    assert plan.legs[0].on_the_spot


def test_facing_something_on_the_way_is_a_turn_to_a_side_not_told() -> None:
    plan = parse_route_description("go forward two segments . face the easel . go on")
    assert _ways(plan) == "either"
    assert plan.legs[0].mentions == (
        Mention("easel", "object", "target", side="ahead"),
    )


@pytest.mark.parametrize(
    "text", ["When you face a clock turn left.", "Turn left, towards the clock."]
)
def test_a_thing_that_is_faced_by_the_way_is_no_command(text: str) -> None:
    assert _ways(parse_route_description(text)) == "left"


@pytest.mark.parametrize(
    ("text", "thing"),
    [
        ("with your back to the wall go forward", "wall"),
        ("place your back against the wall of the 't' intersection . go", "wall"),
        ("with your back to the sofa . go forward twice", "sofa"),
    ],
)
def test_what_is_behind_one_tells_how_one_stands(text: str, thing: str) -> None:
    assert parse_route_description(text).start == Start(from_=thing)


@pytest.mark.parametrize(
    ("text", "side"),
    [
        ("turn so that the wall is on your right . walk forward twice", "right"),
        ("turn so the wall is to your left . walk forward", "left"),
    ],
)
def test_a_wall_beside_one_tells_how_one_stands(text: str, side: Side) -> None:
    wall = Mention("wall", "wall", "along", side=side)
    assert parse_route_description(text).arrival.mentions == (wall,)


def test_a_way_is_taken_by_its_floor() -> None:
    plan = parse_route_description(
        "take the blue path to the lamp . turn left into the pink hall . stop at the end"
    )
    assert _ways(plan) == "left"
    assert plan.start == Start(facing="blue floor")
    pink = Mention("pink floor", "floor", "target", side="ahead")
    assert pink in plan.legs[0].mentions


def test_a_crossing_is_known_by_the_floor_of_its_other_way() -> None:
    plan = parse_route_description(
        "go forward to the intersection with the blue-tiled hall . turn right . go on"
    )
    assert plan.legs[0].mentions == (Mention("blue floor", "floor", "turn"),)


def test_it_stands_for_the_thing_named_last() -> None:
    plan = parse_route_description("face the easel . go to it . turn right . go on")
    assert Mention("easel", "object", "turn") in plan.legs[0].mentions


def test_numbered_places_are_where_one_starts_and_ends() -> None:
    plan = parse_route_description(
        "at one face the sofa . turn right . position 7 is at the stool"
    )
    assert plan.arrival.destinations == ("stool",)


@pytest.mark.parametrize(
    ("text", "ways"),
    [
        ("1. Turn left. 2. Turn left. 3. Turn right.", "left left right"),
        ("1. Straight\n2. Left\n3. Left\n4. Left at the desk", "left left left"),
        ("Go right - no, left! Then straight to the desk.", "left"),
        ("Turn around and walk 20 metres. Turn left.", "around left"),
    ],
)
def test_turns_are_neither_lost_nor_doubled(text: str, ways: str) -> None:
    assert _ways(parse_route_description(text)) == ways


def test_the_second_may_do_without_a_noun() -> None:
    turn = parse_route_description("Go on, turn right at the second, then left.").legs[
        0
    ]
    assert (turn.turn.way, turn.turn.ordinal) == ("right", 2)


def test_the_side_of_a_destination_without_a_name_is_kept() -> None:
    plan = parse_route_description("Turn right. Your destination is on the left.")
    assert plan.arrival.side == "left"


@pytest.mark.parametrize(
    ("text", "count", "thing"),
    [
        ("Go straight. One intersection past the chair is the library.", 1, "chair"),
        ("Turn left two junctions after the lift.", 2, "lift"),
    ],
)
def test_junctions_are_counted_from_a_thing(text: str, count: int, thing: str) -> None:
    plan = parse_route_description(text)
    length = plan.legs[0].length if plan.legs else plan.arrival.length
    assert length is not None
    assert (length.unit, length.count, length.after) == ("places", count, thing)


def test_segments_that_lead_past_a_thing_are_counted_from_the_beginning() -> None:
    plan = parse_route_description("Go forward three segments past the stool.")
    assert plan.arrival.length is not None
    assert plan.arrival.length.after is None


def test_a_path_that_one_is_on_already_is_no_turn() -> None:
    told = "Take a left onto the blue path. Take the blue path to the chair and turn right."
    plan = parse_route_description(told)
    assert [leg.turn.way for leg in plan.legs] == ["left", "right"]


@pytest.mark.parametrize(
    "text",
    [
        "Turn left. The end of this hall is 5.",
        "Turn left. Walk past the clock to the end.",
        "With your back to the clock go on, turn left, walk to the end.",
        "Turn left. Go to the corner. Turning left you see a clock.",
    ],
)
def test_what_is_passed_or_only_seen_is_no_destination(text: str) -> None:
    assert parse_route_description(text).arrival.destinations == ()
