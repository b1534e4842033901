"""How one leaves from where one stands, and what is said before the way begins."""

import pytest

from memorymaze.language.reading import parse_route_description


@pytest.mark.parametrize(
    "text",
    [
        "Straight ahead, take right, the next one. Then the library is on your left.",
        "Sir, go in the direction you're facing, then turn right at the end.",
        "Keep on along here, then right where you can't do anything else.",
        "The way you're going, and at the intersection, you go to the right.",
        "On along here, right before you've gone much further.",
        "Straight on, and to the right where they cross.",
        "Straight on; the moment it opens up take right.",
        "Right, pal, go straight on, and turn right at the clock.",
    ],
)
def test_who_goes_on_first_does_not_turn_on_the_spot(text: str) -> None:
    (leg,) = parse_route_description(text).legs
    assert (leg.turn.way, leg.on_the_spot) == ("right", False)


@pytest.mark.parametrize(
    "text",
    [
        "Wait. The other way, then right at the second junction.",
        "So you continue the other way, then right at the second junction.",
        "I went the other way, and then right at the second junction.",
        "Back down the way you came first, right at the second junction.",
        "Turn around completely, to the right at the second junction.",
        "Turn back, then right at the second junction.",
        "It's back that way, a few steps, and right at the second junction.",
        "You want the other way, and then right at the second junction.",
    ],
)
def test_one_can_be_sent_back(text: str) -> None:
    first, second = parse_route_description(text).legs
    assert (first.turn.way, first.on_the_spot) == ("around", True)
    assert (second.turn.way, second.turn.ordinal) == ("right", 2)


@pytest.mark.parametrize(
    "before",
    [
        "I clean that corridor at six.",
        "According to my little map,",
        "By God, it is far.",
        "It's a long way, my cart and I know it.",
        "With pleasure.",
        "My sister works there, for my part I prefer the cinema.",
    ],
)
def test_what_is_said_of_the_speaker_is_no_part_of_the_way(before: str) -> None:
    plan = parse_route_description(f"{before} To your left, then right at the clock.")
    first, second = plan.legs
    assert (first.turn.way, first.on_the_spot) == ("left", True)
    assert (first.length, first.mentions) == (None, ())
    assert [each.phrase for each in second.mentions] == ["clock"]


def test_a_way_told_by_the_speaker_is_read() -> None:
    text = "I see a clock on the left, I walk on and I turn right at the desk."
    (leg,) = parse_route_description(text).legs
    assert [each.phrase for each in leg.mentions] == ["clock", "desk"]


def test_a_thing_stays_where_the_speaker_only_adds_a_word() -> None:
    (leg,) = parse_route_description(
        "At First Aid, uh, this I forgot, turn right."
    ).legs
    assert [each.phrase for each in leg.mentions] == ["first aid"]


@pytest.mark.parametrize(
    "start",
    [
        "The library is off to the left",
        "The library, it is left from here, my friend",
        "It's to your left, twenty metres",
        "Och, it's over to your left",
        "Down there on the left, a good five metres",
        "Ah, the library: to your left, no turns",
        "To get to the library, you go to your left",
        "No corners, nothing. Off to the left and straight on",
        "If I were you I'd head off to your left",
    ],
)
@pytest.mark.parametrize(
    ("end", "side", "at_end"),
    [
        ("and you'll find it ahead of you.", "ahead", False),
        ("and you find it on the right-hand side.", "right", False),
        ("you will find it at the far end.", None, True),
    ],
)
def test_of_two_sides_the_first_says_how_one_leaves(
    start: str, end: str, side: str | None, at_end: bool
) -> None:
    plan = parse_route_description(f"{start}, {end}")
    (leg,) = plan.legs
    assert (leg.turn.way, leg.on_the_spot, leg.length) == ("left", True, None)
    assert (plan.arrival.side, plan.arrival.at_end) == (side, at_end)


@pytest.mark.parametrize(
    "text",
    [
        "You go to your left, and to your left where the gold model is.",
        "To your left. Left at the gold model.",
        "Down there on the left for forty yards, to your left at the gold model.",
        "Ok. You turn left at the gold model, having first chosen to head off to your left.",
        "What you want to do is take the corridor on your left here, left at the gold model.",
        "The gold room. You go to your left, and then left at the gold model.",
    ],
)
def test_how_one_leaves_is_not_the_first_turn(text: str) -> None:
    first, second = parse_route_description(text).legs
    assert (first.turn.way, first.on_the_spot, first.mentions) == ("left", True, ())
    assert second.turn.way == "left"
    assert [each.phrase for each in second.mentions] == ["gold model"]


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("If you go left here, you will find the library on your right.", "left"),
        ("If you go left you meet the stairs, so go right.", "right"),
    ],
)
def test_an_if_that_promises_the_destination_is_to_be_done(text: str, way: str) -> None:
    assert [leg.turn.way for leg in parse_route_description(text).legs] == [way]


def test_a_minute_ago_is_no_length_and_a_question_names_nothing() -> None:
    text = "Is that a dog? I passed it a minute ago! Go back the way you came."
    (leg,) = parse_route_description(text).legs
    assert (leg.turn.way, leg.length, leg.mentions) == ("around", None, ())


def test_a_destination_asked_for_is_no_place_to_turn() -> None:
    (leg,) = parse_route_description("The library? Turn left, then it's ahead.").legs
    assert (leg.mentions, leg.on_the_spot) == ((), True)


@pytest.mark.parametrize(
    "text",
    [
        "It's down there on the left, and then to the left. No, what am I saying, right, "
        "over by Room 3.",
        "It's off to the left, then to the left, oh listen to me, it's to the right, I "
        "always get those muddled, to your right once you reach Room 3.",
    ],
)
def test_a_corrected_turn_keeps_how_one_leaves(text: str) -> None:
    first, second = parse_route_description(text).legs
    assert (first.turn.way, first.on_the_spot) == ("left", True)
    assert second.turn.way == "right"
    assert [each.phrase for each in second.mentions] == ["room 3"]


def test_a_place_down_there_on_a_side_at_the_end_is_that_way() -> None:
    text = "You'll find the library down there on the left, at the far end."
    plan = parse_route_description(text)
    assert [(leg.turn.way, leg.on_the_spot) for leg in plan.legs] == [("left", True)]
    assert (plan.arrival.destinations, plan.arrival.at_end) == (("library",), True)
