"""What plan the marks of a text make."""

import pytest

from memorymaze.language.plans import (
    Arrival,
    Leg,
    Length,
    Mention,
    Passing,
    RoutePlan,
    Totals,
    Turn,
)
from memorymaze.language.reading.marking.marks import Mark
from memorymaze.language.reading.marking.plans import plan_of_marks


def _plan(text: str, *marks: tuple[str, str, int], sure: float = 1.0) -> RoutePlan:
    """Read a text by marks: words, label and leg of each, in the order of the text."""
    found: list[Mark] = []
    end = 0
    for words, label, leg in marks:
        start = text.index(words, end)
        end = start + len(words)
        found.append(Mark(start, end, label, leg, sure))
    return plan_of_marks(text, found)


def test_what_is_said_of_a_turn_stands_with_it_in_whatever_order() -> None:
    plan = _plan(
        "At the end, by the clock, it's the second left, I think.",
        ("At the end", "end", 0),
        ("clock", "thing:turn", 0),
        ("second", "ordinal", 0),
        ("left", "turn:left", 0),
        ("I think", "doubt", 0),
    )
    (leg,) = plan.legs
    assert leg.turn == Turn("left", ordinal=2, at_end=True, doubt=0.4)
    assert leg.mentions == (Mention("clock", "object", "turn"),)


@pytest.mark.parametrize(
    ("text", "length", "after"),
    [
        ("Right, and it's ten metres after the chair.", "ten metres", "chair"),
        ("Right, and one intersection past the chair.", "one intersection", "chair"),
        ("Right, and go ten metres past the chair.", "ten metres", None),
        ("Right, and go ten metres to the chair.", "ten metres", None),
    ],
)
def test_a_length_is_told_from_the_thing_that_it_is_said_to_follow(
    text: str, length: str, after: str | None
) -> None:
    plan = _plan(
        text, ("Right", "turn:right", 0), (length, "length", 1), ("chair", "thing:passed", 1)
    )  # fmt: skip
    assert plan.arrival.length is not None
    assert plan.arrival.length.after == after


def test_what_is_told_after_the_last_turn_is_of_the_arrival() -> None:
    plan = _plan(
        "Right, then twenty metres past the piano, and the library is the third door on the left.",
        ("Right", "turn:right", 0),
        ("twenty metres", "length", 1),
        ("piano", "thing:passed", 1),
        ("library", "dest", 1),
        ("third", "nth", 1),
        ("left", "side:left", 1),
    )
    assert plan.legs == (Leg(Turn("right"), on_the_spot=True),)
    assert plan.arrival == Arrival(
        ("library",),
        side="left",
        nth=3,
        length=Length(20.0, "metres"),
        mentions=(Mention("piano", "object", "passed"),),
    )


def test_a_leg_that_has_no_turn_belongs_to_the_next_that_has_one() -> None:
    plan = _plan(
        "Past the sofa, past the bin, left.",
        ("sofa", "thing:passed", 0),
        ("bin", "thing:passed", 1),
        ("left", "turn:left", 2),
    )
    (leg,) = plan.legs
    assert [each.phrase for each in leg.mentions] == ["sofa", "bin"]


def test_what_was_taken_back_repeated_or_only_remarked_is_not_in_the_plan() -> None:
    plan = _plan(
        "Right, no, left. If you turn right you are in the kitchen. So left.",
        ("Right", "undone", 0),
        ("left", "turn:left", 0),
        ("right", "aside", 0),
        ("kitchen", "aside", 0),
        ("left", "again", 0),
    )
    assert plan == RoutePlan(legs=(Leg(Turn("left"), on_the_spot=True),))


def test_openings_left_alone_are_counted_from_their_words() -> None:
    said = {
        "two openings on the left": Passing(2, "left"),
        "the second right": Passing(1, "right"),
        "straight over the crossing": Passing(1, None, "crossing"),
        "don't turn": Passing(None),
    }
    for words, passing in said.items():
        plan = _plan(
            f"{words}, then left.", (words, "pass", 0), ("left", "turn:left", 0)
        )
        assert plan.legs[0].passings == (passing,), words


def test_a_bend_is_as_slight_as_the_words_around_it_say() -> None:
    for text, way in {
        "The corridor bends slightly left.": "slight_left",
        "Follow it round to the left.": "left",
    }.items():
        (leg,) = _plan(text, ("left", "bend:left", 0)).legs
        assert leg.turn == Turn(way, forced=True)  # type: ignore[arg-type]


def test_warnings_totals_and_the_start_have_places_of_their_own() -> None:
    plan = _plan(
        "Six turns in all. From the lifts left; the toilets are too far.",
        ("Six turns", "total", 0),
        ("lifts", "start:from", 0),
        ("left", "turn:left", 0),
        ("toilets", "too_far", 0),
    )
    assert plan.totals == Totals(turns=6)
    assert plan.start.from_ == "lifts"
    assert plan.legs[0].too_far == ("toilets",)


def test_a_turn_that_is_not_certain_says_how_unclear_it_is() -> None:
    (leg,) = _plan("Left.", ("Left", "turn:left", 0), sure=0.6).legs
    assert leg.unclear == 0.4


def test_a_room_told_by_a_number_is_asked_for_by_its_door() -> None:
    for words in ("room six", "6", "number six", "door 6"):
        plan = _plan(f"It is {words}.", (words, "dest", 0))
        assert plan.arrival.destinations[0] == "door that says 6", words


def test_a_common_thing_is_found_by_the_name_beside_it() -> None:
    plan = _plan(
        "Glass doors of the library, a door.",
        ("Glass doors of the library", "dest", 0),
        ("door", "dest", 0),
    )
    assert plan.arrival.destinations[:2] == ("glass door of library", "library")


def test_a_side_is_that_of_the_thing_in_the_same_breath() -> None:
    plan = _plan(
        "Past the plant on the left, a sofa on the right, then turn left.",
        ("plant", "thing:passed", 0),
        ("left", "side:left", 0),
        ("sofa", "thing:passed", 0),
        ("right", "side:right", 0),
        ("left", "turn:left", 0),
    )
    assert [each.side for each in plan.legs[0].mentions] == ["left", "right"]


def test_a_side_of_what_has_no_name_is_not_given_to_its_neighbour() -> None:
    plan = _plan(
        "Past the blue thing on the left, then a clock, and right.",
        ("blue thing", "thing:passed", 0),
        ("left", "side:left", 0),
        ("clock", "thing:turn", 0),
        ("right", "turn:right", 0),
    )
    assert plan.legs[0].mentions == (Mention("clock", "object", "turn"),)


def test_the_side_of_a_name_said_again_is_that_of_the_destination() -> None:
    plan = _plan(
        "To the library. Left at the piano. Then the library, on the right.",
        ("library", "dest", 0),
        ("Left", "turn:left", 0),
        ("piano", "thing:turn", 0),
        ("library", "again", 0),
        ("right", "side:right", 1),
    )
    assert plan.arrival == Arrival(("library",), side="right")
    assert plan.legs[0].mentions == (Mention("piano", "object", "turn"),)


def test_a_last_side_beside_no_name_is_that_of_the_destination() -> None:
    plan = _plan(
        "Past the kitchen turn right, and it's on your left.",
        ("kitchen", "thing:passed", 0),
        ("right", "turn:right", 0),
        ("left", "side:left", 1),
    )
    assert plan.arrival == Arrival(side="left")
    assert [each.side for each in plan.legs[0].mentions] == [None]


@pytest.mark.parametrize(
    ("said", "sides"),
    [
        ("the sofa, a bin and the clock on the left", ("left", "left", "left")),
        ("on the left the sofa and a bin, behind it the clock", ("left", "left", None)),
        ("the sofa is on the left and a bin near the clock", ("left", None, None)),
        ("a hall on the left. A sofa, a bin, a clock", (None, None, None)),
    ],
)
def test_a_side_is_that_of_all_things_of_its_list_and_of_none_told_later(
    said: str, sides: tuple[str | None, ...]
) -> None:
    marks = [(each, "thing:passed", 0) for each in ("sofa", "bin", "clock")]
    marks.append(("left", "side:left", 0))
    marks.sort(key=lambda each: said.lower().index(each[0]))
    plan = _plan(f"Past {said}, then right.", *marks, ("right", "turn:right", 0))
    assert tuple(each.side for each in plan.legs[0].mentions) == sides


def test_a_doubt_is_about_what_stands_beside_it() -> None:
    plan = _plan(
        "Past the sofa, maybe twenty metres, left.",
        ("sofa", "thing:passed", 0),
        ("maybe", "doubt", 0),
        ("twenty metres", "length", 0),
        ("left", "turn:left", 0),
    )
    (leg,) = plan.legs
    assert leg.length == Length(20.0, "metres", doubt=0.4)
    assert (leg.mentions[0].doubt, leg.turn.doubt) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("text", "on_the_spot"),
    [
        ("Out of the lifts, turn left.", True),
        ("It is a long way. Out of the lifts, turn left.", True),
        ("Go straight on and turn left.", False),
        ("At the clock, turn left.", False),
    ],
)
def test_a_first_turn_is_on_the_spot_unless_one_walks_to_it(
    text: str, on_the_spot: bool
) -> None:
    clock = [("clock", "thing:turn", 0)] if "clock" in text else []
    (leg,) = _plan(text, *clock, ("left", "turn:left", 0)).legs
    assert leg.on_the_spot == on_the_spot


def test_the_second_or_third_is_kept_as_two_ways_to_count() -> None:
    plan = _plan(
        "The second or third left.",
        ("second", "ordinal", 0),
        ("third", "ordinal", 0),
        ("left", "turn:left", 0),
    )
    assert plan.legs[0].turn == Turn("left", ordinal=2, or_ordinal=3)


def test_where_no_destination_is_named_nothing_passed_becomes_one() -> None:
    plan = _plan(
        "At the Exit sign turn left.",
        ("Exit sign", "thing:turn", 0),
        ("left", "turn:left", 0),
    )
    assert plan.arrival.destinations == ()
    plan = _plan(
        "Past the fire door, left. There is the door.",
        ("fire door", "thing:passed", 0),
        ("left", "turn:left", 0),
        ("door", "dest", 1),
    )
    assert plan.arrival.destinations == ("door",)


def test_a_floor_that_is_walked_on_is_faced_at_the_start_and_led_to_by_a_turn() -> None:
    plan = _plan(
        "Take the yellow path to the stool, then left. Walk along the blue carpet.",
        ("yellow path", "thing:along", 0),
        ("stool", "thing:turn", 0),
        ("left", "turn:left", 0),
        ("blue carpet", "thing:along", 1),
    )
    assert plan.start.facing == "yellow floor"
    (leg,) = plan.legs
    assert leg.mentions == (
        Mention("stool", "object", "turn"),
        Mention("blue floor", "floor", "target", side="ahead"),
    )
    assert plan.arrival.mentions == ()


def test_what_is_walked_towards_first_is_faced_and_still_on_the_way() -> None:
    plan = _plan(
        "Go towards the lamp. At the end go right.",
        ("lamp", "thing:along", 0),
        ("end", "end", 0),
        ("right", "turn:right", 0),
    )
    assert plan.start.facing == "lamp"
    assert plan.legs[0].mentions == (Mention("lamp", "object", "along"),)


def test_nobody_arrives_at_a_floor_nor_learns_from_one_how_many_ways_meet() -> None:
    plan = _plan(
        "Left at the intersection with the pink path, on to where the red brick begins.",
        ("Left", "turn:left", 0),
        ("intersection", "junction:crossing", 0),
        ("pink path", "thing:turn", 0),
        ("red brick", "dest", 1),
    )
    assert plan.legs[0].turn == Turn("left")
    assert plan.arrival.destinations == ()
    assert plan.arrival.mentions == (Mention("brick floor", "floor", "turn"),)
