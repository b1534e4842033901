"""Ways as people tell them whom one asks: from where one stands, in one breath."""

import pytest

from memorymaze.language.plans import Leg, RoutePlan
from memorymaze.language.reading import parse_route_description


def places_of(leg: Leg) -> list[str]:
    """Return the things that tell where a leg ends."""
    at = {"turn", "beside", "opposite", "before_turn", "after_turn"}
    return [each.phrase for each in leg.mentions if each.place in at]


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("Turn left here, and the library is on your right.", "left"),
        ("Sir, go right from where you are. The library is ahead of you.", "right"),
        ("Oh, the library! Go back the way you came, it's on your left.", "around"),
        ("Madam, start off to your left. The library is on your right.", "left"),
        ("Turn round and go back. The library is on your left.", "around"),
        ("Head back behind you. The library is on your left.", "around"),
    ],
)
def test_one_sets_off_by_a_turn_on_the_spot(text: str, way: str) -> None:
    (leg,) = parse_route_description(text).legs
    assert (leg.turn.way, leg.on_the_spot, places_of(leg)) == (way, True, [])


def test_a_turn_here_is_not_on_the_spot_once_one_has_walked() -> None:
    (leg,) = parse_route_description("Walk to the clock. Turn left here.").legs
    assert not leg.on_the_spot


@pytest.mark.parametrize(
    "text",
    [
        "Turn left when you get to the clock, then take your second right turn.",
        "Left once you reach the clock, then right when you come to the second passage.",
        "Go left by the clock and then, like, go right the second time you can.",
        "Thirty metres and to your left at the clock, then right at the second one.",
        "Make a left next to the clock. Then you take the second one right.",
        "Go left as you come to the clock, then to the right, the second one.",
    ],
)
def test_a_place_told_after_its_side_belongs_to_that_turn(text: str) -> None:
    first, second = parse_route_description(text).legs
    assert (first.turn.way, first.turn.ordinal, places_of(first)) == (
        "left",
        None,
        ["clock"],
    )
    assert (second.turn.way, second.turn.ordinal, places_of(second)) == ("right", 2, [])


@pytest.mark.parametrize(
    "text",
    [
        "Turn left when you reach the wall, then right at the crossing.",
        "Left at the bottom of the corridor, right where the two hallways meet.",
        "Go left once you hit the end, then right when another corridor cuts across.",
        "Left when you can't go any further, then right where you can go every way.",
        "Walk the whole corridor and turn left, then go right where the ways cross.",
    ],
)
def test_ends_and_crossings_are_told_in_many_ways(text: str) -> None:
    first, second = parse_route_description(text).legs
    assert (first.turn.way, first.turn.at_end) == ("left", True)
    assert (second.turn.way, second.turn.at_end) == ("right", False)
    assert second.turn.junction == "crossing"


@pytest.mark.parametrize(
    "text",
    [
        "Go right at the end, go right at the crossing.",
        "Take the second right. Take the third right.",
        "Turn right at the clock, turn right when you can't go further.",
        "Take the next right. Go right at the next corner.",
        "Take the first right. Go right at the junction.",
        "Left where it ends. Left at the next opening.",
        "Left at the end, left at the meeting of the corridors.",
        "Go left at the crossing, next you go left at the crossing.",
        "Walk to the end, and there to your left, then left at the crossing.",
    ],
)
def test_equal_turns_at_two_places_are_two(text: str) -> None:
    way = "right" if "right" in text else "left"
    assert [leg.turn.way for leg in parse_route_description(text).legs] == [way] * 2


@pytest.mark.parametrize(
    "text",
    ["Go right at the end, go right there.", "Turn right at the clock, turn right."],
)
def test_a_turn_said_again_without_a_place_of_its_own_is_one(text: str) -> None:
    assert len(parse_route_description(text).legs) == 1


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(
    "ending",
    [
        "it's to your {}.",
        "and there's the library, to your {}.",
        "there it is, to the {}.",
        "to your {} you will see the library.",
        "then it's to your {}.",
        "the library, {}-hand side.",
    ],
)
def test_a_side_said_last_and_alone_is_that_of_the_destination(
    side: str, ending: str
) -> None:
    other = "left" if side == "right" else "right"
    for way in (side, other):
        text = f"Turn {way} at the end, and " + ending.format(side)
        plan = parse_route_description(text)
        assert [(leg.turn.way, leg.turn.ordinal) for leg in plan.legs] == [(way, None)]
        assert plan.arrival.side == side


def test_where_the_destination_is_says_nothing_of_the_last_turn() -> None:
    text = "Left at the second opening, and there you have it, at the far end."
    plan = parse_route_description(text)
    assert [leg.turn.at_end for leg in plan.legs] == [False]
    assert plan.arrival.at_end


@pytest.mark.parametrize(
    ("text", "side"),
    [
        ("The library is straight in front of you.", "ahead"),
        ("The library is directly ahead.", "ahead"),
        ("Go on, and the library is right in front of you.", "ahead"),
        ("Go on. It was straight in front of you.", "ahead"),
        ("Go on, and there is the library, straight ahead.", "ahead"),
        ("The library is to your left.", "left"),
        ("The library is down there on the left.", "left"),
        ("Straight on, and the library, it is to your left.", "left"),
        ("The library is on the left, it's the glass door.", "left"),
    ],
)
def test_one_side_alone_is_that_of_the_destination(text: str, side: str) -> None:
    plan = parse_route_description(text)
    assert (plan.legs, plan.arrival.side) == ((), side)


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("Take the next slight left.", "slight_left"),
        ("Turn diagonally right at the desk.", "slight_right"),
        ("A little to the left at the crossing.", "slight_left"),
    ],
)
def test_a_slanted_opening_is_a_slight_turn(text: str, way: str) -> None:
    assert [leg.turn.way for leg in parse_route_description(text).legs] == [way]


@pytest.mark.parametrize(
    "text",
    [
        "Take a left as soon as you can.",
        "Left the first chance you get.",
        "Turn left as soon as the corridor lets you.",
        "Left where the next corridor comes.",
    ],
)
def test_the_first_chance_to_turn_is_the_next_opening(text: str) -> None:
    (leg,) = parse_route_description(text).legs
    assert (leg.turn.way, leg.turn.at_end, leg.mentions) == ("left", False, ())
    assert leg.turn.ordinal in {None, 1}


def test_right_that_only_opens_an_answer_is_no_turn() -> None:
    legs = parse_route_description("Right, pal, keep straight on, then left.").legs
    assert [leg.turn.way for leg in legs] == ["left"]


@pytest.mark.parametrize(
    "text",
    [
        "I don't know, sorry.",
        "No clue, I'm just here with my class.",
        "The library isn't on my list. Please ask at the front desk.",
        "Sorry, I couldn't say where the library is.",
    ],
)
def test_who_does_not_know_tells_neither_a_way_nor_a_destination(text: str) -> None:
    assert parse_route_description(text) == RoutePlan()


@pytest.mark.parametrize(
    "text",
    [
        "I don't know its name, but turn left.",
        "I'm not sure, the library is on your left.",
    ],
)
def test_who_knows_a_part_is_heard(text: str) -> None:
    assert parse_route_description(text) != RoutePlan()


def test_what_follows_after_that_is_a_turn_to_make() -> None:
    text = "Turn right at the desk, after that go to your left at the second opening."
    first, second = parse_route_description(text).legs
    assert (first.turn.way, second.turn.way) == ("right", "left")
    assert (second.turn.ordinal, second.turn.forced) == (2, False)


def test_a_room_in_a_hall_is_on_the_side_told_of_both() -> None:
    text = "Turn right. Office 2347 in GHI Hall is on your left."
    arrival = parse_route_description(text).arrival
    assert (arrival.destinations[0], arrival.side) == ("door that says 2347", "left")


def test_a_turn_at_this_intersection_is_at_the_one_just_told() -> None:
    text = "Walk to the intersection with the stool. Turn left at this intersection."
    (leg,) = parse_route_description(text).legs
    assert places_of(leg) == ["stool"]
