"""Plans in plain words, one line for each leg and one for the arrival."""

from memorymaze.language.plans import (
    Arrival,
    Leg,
    Length,
    Mention,
    Passing,
    RoutePlan,
    Start,
    Turn,
    describe,
)


def test_every_part_of_a_leg_is_told_in_its_line() -> None:
    leg = Leg(
        Turn("right", ordinal=2, counted_after="clock", at_end=True, doubt=0.7),
        length=Length(16.0, "places", 2.0),
        mentions=(Mention("clock", "object", "before_turn", side="left"),),
        passings=(Passing(1, "left", "opening"),),
        too_far=("piano",),
        wrong_way=("stairs",),
    )
    first, _ = describe(RoutePlan(legs=(leg,)))
    assert first == (
        "1. turn right (second after clock; at the end; perhaps; after 2 places; "
        "pass 1 opening on the left; after clock left; too far: piano; "
        "wrong way: stairs)"
    )


def test_the_start_is_told_with_the_first_line() -> None:
    legs = (Leg(Turn("left"), on_the_spot=True), Leg(Turn("right")))
    lines = describe(RoutePlan(start=Start("clock", "lifts"), legs=legs))
    assert lines[0] == "1. turn left (facing clock; from lifts; where one stands)"
    assert len(lines) == 3


def test_a_goal_without_a_name_is_said_to_have_none() -> None:
    (line,) = describe(RoutePlan(arrival=Arrival(side="left")))
    assert line == "1. arrive at a place not named (on the left)"
