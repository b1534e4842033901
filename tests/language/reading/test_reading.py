"""What short route descriptions mean, in wordings of many kinds.

`forms_of_speech.jsonl` has a text for every general form of speech and, checked by hand,
the whole plan that it says; the tests below look at single fields in more wordings.
"""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.language.plans import RoutePlan, parse_plan, plan_record
from memorymaze.language.reading import parse_route_description
from memorymaze.language.reading.marking import read_by_marks

FORMS = [
    json.loads(line)
    for line in (Path(__file__).parent / "forms_of_speech.jsonl")
    .read_text(encoding="utf-8")
    .splitlines()
]


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form["text"][:50])
def test_a_form_of_speech_says_its_whole_plan(form: dict[str, Any]) -> None:
    assert plan_record(parse_route_description(form["text"])) == form["plan"]


class Told(NamedTuple):
    """What a listener would take from a description; None leaves a field open."""

    ways: str
    """Ways of all turns, in order."""
    ordinals: tuple[int | None, ...] | None = None
    at_end: tuple[bool, ...] | None = None
    metres: tuple[float | None, ...] | None = None
    things: tuple[str, ...] = ()
    """Things named on the legs that end with a turn."""


TURNS = {
    "Hang a right.": Told("right"),
    "Go straight and turn right.": Told("right", (None,), (False,), (None,)),
    "left, right, left": Told("left right left"),
    "TURN LEFT THEN TURN RIGHT": Told("left right"),
    "Turn left, then immediately right.": Told("left right"),
    "Turn slightly left.": Told("slight_left"),
    "Hi there! Nice to meet you. Please turn left, thanks!": Told("left"),
    # which of several ways
    "Take the second left.": Told("left", (2,)),
    "take the 3rd right": Told("right", (3,)),
    "Take the last right.": Told("right", (-1,)),
    "Take the first left, then the second right.": Told("left right", (1, 2)),
    "Continue to the second crossing and turn left.": Told("left", (2,)),
    "Walk past two corridors on your right and take the third one.": Told(
        "right", (3,)
    ),
    # ways to leave alone
    "Don't take the first left, take the second.": Told("left", (2,)),
    "Ignore the first corridor on the left and take the second.": Told("left", (2,)),
    "Do not turn left. Turn right.": Told("right"),
    "You should not turn right, turn left instead.": Told("left"),
    # where a corridor ends
    "Go to the end of the corridor and turn left.": Told("left", at_end=(True,)),
    "Walk until the end, then right.": Told("right", at_end=(True,)),
    "Go on until the corridor ends, then turn left.": Told("left", at_end=(True,)),
    "At the end of the hallway hang a left.": Told("left", at_end=(True,)),
    # how far
    "Walk 20 metres and turn right.": Told("right", metres=(20.0,)),
    "Turn right after 12 meters.": Told("right", metres=(12.0,)),
    "Walk straight ahead for 30 m, then go left.": Told("left", metres=(30.0,)),
    "Walk 10 to 20 metres and turn left.": Told("left", metres=(15.0,)),
    "Follow the long corridor and turn left.": Told("left", metres=(25.0,)),
    "There is a long corridor on the left, take it.": Told("left", metres=(None,)),
    "Go 50 feet and make a right.": Told("right", metres=(15.24,)),
    # what one sees
    "Go past the kitchen and turn left.": Told("left", things=("kitchen",)),
    "Walk past the kitchen and the toilets, then turn right.": Told(
        "right", things=("kitchen", "toilets")
    ),
    "Turn left at the printer.": Told("left", things=("printer",)),
    "Go straight until you see a clock, then turn right.": Told(
        "right", things=("clock",)
    ),
    "Go down the hall, pass the printer on your right, and at the plant turn left.": (
        Told("left", things=("printer", "plant"))
    ),
    # second thoughts
    "Turn left, no sorry, right.": Told("right"),
    "Turn left, I mean right.": Told("right"),
    "Turn right. Oh wait, I meant left.": Told("left"),
    "Turn left. No wait, turn right.": Told("right"),
    # lists
    "1. Turn left\n2. Turn right at the red sofa\n3. Stop at the door": Told(
        "left right", things=("red sofa",)
    ),
    "1) Go straight.\n2) Turn left.\n3) Turn right.": Told("left right"),
    # one way said twice
    "Do a quick left-right: left at the clock, then right.": Told("left right"),
    "At the rocket engine go left. At the engine, left.": Told("left"),
    "It is that right, that right only.": Told("right"),
    # ways of speaking
    "Chuck a left at the desk, then peel off right.": Told("left right"),
    "ok so hang a r at the wall w the clock n then its l": Told("right left"),
    "Roon the corner tae the left, then right oot the hall.": Told("left right"),
    "In the finish, to the right side. Next right corridor, please bend.": Told(
        "right right"
    ),
    "Walk until it dies, right, then ninety degrees left.": Told("right left"),
    "Not left but right. The wall forces you left.": Told("right left"),
    "The first left no, the second yes.": Told("left", (2,)),
    "One corridor goes off to the left, leave it. Turn right.": Told("right"),
    "One way left, let it be. Turn right.": Told("right"),
    "First walk to the desk, next comes a right turn.": Told("right", (None,)),
    "The first aid room comes on your left, take right.": Told("right"),
    "The corridor makes a small bend to the left. Turn right.": Told(
        "slight_left right"
    ),
    "Take your first left. There will be a hallway on your right. Go down it.": Told(
        "left right"
    ),
    "Not the first left, the second left.": Told("left", (2,)),
    "Left... no right. Then to the left.": Told("right left"),
    "left right left right": Told("left right left right"),
    # said again
    "At the desk right, right, and on.": Told("right"),
    "Left, because right takes you to the labs.": Told("left"),
    "Right at the shop. Right, okay, by the shop, right.": Told("right"),
    "Turn left, left, then left.": Told("left left"),
    "Rather than going right, go left instead of right.": Told("left"),
    "If you go right you meet the stairs, so go left.": Told("left"),
    "Turn left right after the desk, then turn right right away.": Told("left right"),
    "Make a U-turn and turn left. Turn around 180 degrees.": Told("around left around"),
    "To your left is a long hallway. Walk down this hallway.": Told("left"),
    # counts that go on, and of both sides
    "At the first junction go left. At the second junction go right.": Told(
        "left right", (1, None)
    ),
    "The first opening is on the left, skip it. The second on the right is yours.": Told(
        "right", (None,)
    ),
    "Ninth opening on the left.": Told("left", (9,)),
    "A second way on the left, not that. Then turn right.": Told("right"),
    # sides that are no turns
    "Turn right. The doors further to the left do not matter.": Told("right"),
    "Turn right. After five metres, left: 2347.": Told("right"),
    "Walk on, leaving one opening on your left, and turn right.": Told("right"),
    "Walk to the reception, left hand.": Told("left"),
    # bends whose side is told late
    "There's a bend and you go left with it.": Told("left"),
    "Turn right. The path bends by itself, just follow it.": Told("right either"),
    # said twice, or taken back
    "At the crossing go left, the first left.": Told("left"),
    "And then, um, left.": Told("left"),
    "Left at the stairs. Actually no, scratch that, it's right at the stairs.": Told(
        "right"
    ),
    "It goes off to the right, don't take that. Turn left at the desk.": Told("left"),
    "You're at the lifts, right? So go left.": Told("left"),
    "Most people go right here, but you go left.": Told("left"),
    "You can't go right because there's a wall, so left.": Told("left"),
    "Then go right, not left, right.": Told("right"),
    # openings of which there is one, doors one goes through
    "It's the only turning on the left.": Told("left"),
    "Another turning on the right, and that is it.": Told("right"),
    "The path splits there, ours is the right-hand one.": Told("right"),
    "The glass door is on your right, go out.": Told("right"),
    "Take the first crossing to the right, then left.": Told("right left", (1, None)),
    # a side of the same sentence's second place
    "At the windows left, and the glass doors right. Then straight.": Told(
        "left right"
    ),
    "Left and the room is on the right.": Told("left"),
    "Exit the lifts to the right. Then turn left.": Told("right left"),
    # none at all
    "Walk ten metres, the office is on the left side.": Told(""),
    "Keep going straight, the destination is at the end of the corridor.": Told(""),
}


@pytest.mark.parametrize("text", TURNS)
def test_a_description_gives_its_turns_in_order_with_what_is_said_of_them(
    text: str,
) -> None:
    told = TURNS[text]
    legs = parse_route_description(text).legs
    assert [leg.turn.way for leg in legs] == told.ways.split()
    if told.ordinals is not None:
        assert tuple(leg.turn.ordinal for leg in legs) == told.ordinals
    if told.at_end is not None:
        assert tuple(leg.turn.at_end for leg in legs) == told.at_end
    if told.metres is not None:
        lengths = [leg.length.metres if leg.length else None for leg in legs]
        assert lengths == pytest.approx(list(told.metres))
    named = [mention.phrase for leg in legs for mention in leg.mentions]
    assert set(told.things) <= set(named)


@pytest.mark.parametrize(
    ("text", "shortest", "longest"),
    [
        ("Walk about thirty steps, then turn left.", 15.0, 27.0),
        ("Walk 40 paces, then turn right.", 20.0, 40.0),
        ("Walk for one minute, then turn left.", 30.0, 90.0),
        ("Walk for two minutes and then turn right.", 60.0, 180.0),
    ],
)
def test_steps_and_minutes_become_metres_of_a_human_walk(
    text: str, shortest: float, longest: float
) -> None:
    (leg,) = parse_route_description(text).legs
    assert leg.length is not None
    assert shortest <= leg.length.metres <= longest
    assert leg.length.unit != "metres"


@pytest.mark.parametrize("read", [parse_route_description, read_by_marks])
@pytest.mark.parametrize(
    ("number", "metres"),
    [
        ("two hundred", 200),
        ("a hundred and fifty", 150),
        ("1,000", 1000),
        ("two and a half", 2.5),
    ],
)
def test_large_and_half_numbers_are_read_whole_by_both_readers(
    read: Callable[[str], RoutePlan], number: str, metres: float
) -> None:
    (leg,) = read(f"Walk {number} metres, then turn left.").legs
    assert leg.length is not None
    assert leg.length.metres == metres


def test_a_turn_told_again_beside_a_thing_leaves_the_next_one_to_itself() -> None:
    text = "Turn left. Again, at the lift left, right, and the library is there."
    assert [each.turn.way for each in parse_route_description(text).legs] == [
        "left",
        "right",
    ]


@pytest.mark.parametrize(
    "text",
    [
        "At the T junction turn right.",
        "You come to a T-junction. Go right.",
        "Go straight until the T-junction and turn right.",
    ],
)
def test_a_t_junction_is_told_from_other_places(text: str) -> None:
    (leg,) = parse_route_description(text).legs
    assert (leg.turn.way, leg.turn.junction) == ("right", "t")
    (plain,) = parse_route_description("Go straight and turn right.").legs
    assert plain.turn.junction is None


@pytest.mark.parametrize(
    "text",
    ["Follow the bend to the right.", "The corridor bends to the right. Follow it."],
)
def test_a_bend_is_a_turn_without_a_choice(text: str) -> None:
    (leg,) = parse_route_description(text).legs
    assert leg.turn.way == "right"
    assert leg.turn.forced


@pytest.mark.parametrize(
    "text", ["Maybe turn left, I think.", "You will probably have to go left."]
)
def test_a_hedged_turn_is_still_a_turn_but_doubted(text: str) -> None:
    (hedged,) = parse_route_description(text).legs
    (plain,) = parse_route_description("Turn left.").legs
    assert hedged.turn.way == plain.turn.way == "left"
    assert hedged.turn.doubt > plain.turn.doubt


@pytest.mark.parametrize(
    ("text", "thing"),
    [
        ("Turn left. If you reach the piano you have gone too far.", "piano"),
        ("Make a left. If you see the lockers, you went too far.", "lockers"),
    ],
)
def test_a_warning_names_what_lies_behind_the_turn_and_adds_no_turn(
    text: str, thing: str
) -> None:
    (leg,) = parse_route_description(text).legs
    assert leg.turn.way == "left"
    assert leg.too_far == (thing,)
    assert thing not in [mention.phrase for mention in leg.mentions]


@pytest.mark.parametrize(
    ("text", "destination", "side", "nth"),
    [
        ("Turn left; the library will be on your right.", "library", "right", None),
        ("Walk to the end, the lift is on the left.", "lift", "left", None),
        ("Room 12 is on the right.", "door that says room 12", "right", None),
        ("And six is on the left.", "door that says room 6", "left", None),
        ("Right, then office 2347, left.", "door that says 2347", "left", None),
        ("Stop at the kitchen sign.", "kitchen", None, None),
        ("Turn left and walk under the library sign.", "library", None, None),
        ("Left. Robots dead ahead, cant miss it.", "robot", "ahead", None),
        ("Take the first right and stop at the aquarium.", "aquarium", None, None),
        ("Stop in front of the aquarium.", "aquarium", None, None),
        ("The piano is the destination.", "piano", None, None),
        ("Go to the fourth door on the left.", "door", "left", 4),
        ("Take the last door on the left.", "door", "left", -1),
        ("Left. The sofa is on the right, near a piano.", "sofa", "right", None),
        ("Turn left. A wooden door, and that is the one.", "wooden door", None, None),
        ("Left. The robot is on a stage.", "robot", None, None),
        (
            "Left. Room 5 first, then 6, both on the left.",
            "door that says room 6",
            "left",
            None,
        ),
        ("Left. Door 2347. Reaching 2349? Too far.", "door that says 2347", None, None),
        (
            "Left. The sofa is there, and if you meet a bench, it is too far.",
            "sofa",
            None,
            None,
        ),
    ],
)
def test_the_destination_is_known_with_its_side_and_number(
    text: str, destination: str, side: str | None, nth: int | None
) -> None:
    arrival = parse_route_description(text).arrival
    assert arrival.destinations[0] == destination
    assert (arrival.side, arrival.nth) == (side, nth)


def test_fuller_names_told_elsewhere_name_the_destination_too() -> None:
    text = "To the space station turn left. The station is straight ahead."
    assert set(parse_route_description(text).arrival.destinations) == {
        "station",
        "space station",
    }


def test_what_stands_ahead_before_a_turn_is_where_one_turns() -> None:
    (leg,) = parse_route_description("In front is a clock. Turn left.").legs
    assert [(each.phrase, each.place) for each in leg.mentions] == [("clock", "turn")]


def test_a_length_after_the_last_turn_belongs_to_the_arrival() -> None:
    plan = parse_route_description("Turn right, then walk 15 metres to the lockers.")
    (leg,) = plan.legs
    assert leg.length is None
    assert plan.arrival.length is not None
    assert plan.arrival.length.metres == pytest.approx(15.0)
    assert plan.arrival.destinations[0] == "lockers"


@pytest.mark.parametrize("text", ["", " \n\t", "🙂🙃", "...", "?!", "\x00", "1. 2. 3."])
def test_what_says_nothing_gives_a_plan_without_turns(text: str) -> None:
    plan = parse_route_description(text)
    assert plan.legs == ()
    assert plan.arrival.destinations == ()


@pytest.mark.parametrize(
    "text",
    [
        "supercalifragilistic" * 500,
        "left" * 1000,
        "9" * 400,
        "Turn left after " + "9" * 400 + " metres.",
        " ".join(f"word{number}" for number in range(10_000)),
    ],
    ids=["long word", "long way", "long number", "long length", "ten thousand words"],
)
def test_texts_of_any_size_are_read(text: str) -> None:
    plan = parse_route_description(text)
    assert parse_plan(plan_record(plan), "what was read") == plan


@given(st.text())
def test_any_text_is_read_and_always_in_the_same_way(text: str) -> None:
    plan = parse_route_description(text)
    assert isinstance(plan, RoutePlan)
    assert parse_route_description(text) == plan


WORDS = """
left right turn go walk take the a first second last next one and then until end of
corridor past kitchen door on your into , . ; : ( ) ! ? 1. 2) don't not no sorry wait
if you reach too far 10 twenty 0 -1 99999999999999999999 1/2 metres steps feet minutes
maybe pass openings in all turnings T-junction crossing bend follow destination is there room skip again either before
after opposite around straight slightly see both there's stop 🙂
"""


@given(st.lists(st.sampled_from([*WORDS.split(), "\n"]), max_size=25).map(" ".join))
def test_words_of_routes_in_any_order_are_read_and_always_in_the_same_way(
    text: str,
) -> None:
    plan = parse_route_description(text)
    assert parse_route_description(text) == plan
    assert parse_plan(plan_record(plan), "what was read") == plan


WAYS = st.lists(st.sampled_from(["left", "right"]), min_size=1, max_size=8)


@given(WAYS)
def test_equal_turns_in_a_list_or_joined_by_then_are_different_turns(
    ways: list[str],
) -> None:
    listed = [f"{number}) Turn {way}" for number, way in enumerate(ways, 1)]
    for text in ("\n".join(listed), f"Turn {', then turn '.join(ways)}."):
        assert [leg.turn.way for leg in parse_route_description(text).legs] == ways
