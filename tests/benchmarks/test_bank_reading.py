from dataclasses import replace

from benchmarks.bank_reading import Told, compare, is_unread, tell

from memorymaze.passers_by.bank import load_bank
from memorymaze.passers_by.bank_records import Answer, TurnFact, WayFacts
from memorymaze.routes import Arrival, Leg, Mention, RoutePlan, Turn

FACTS = WayFacts(
    "left",
    (
        TurnFact("right", "thing", 1, "the red sofas", 9.0),
        TurnFact("half left", "ordinal", 2, "", 5.0),
    ),
    "end",
    "the library",
    8.0,
)
TOLD = Told(
    "",
    Answer("2", "{set_off}, {where}, {destination}", "llm", "a", "way_to", "guard"),
    FACTS,
)
SOFA = Mention("red sofa", "object", "beside")
MEANT = RoutePlan(
    legs=(
        Leg(Turn("left"), on_the_spot=True),
        Leg(Turn("right"), mentions=(SOFA,)),
        Leg(Turn("slight_left", ordinal=2)),
    ),
    arrival=Arrival(("library",), at_end=True),
)


def shares(plan: RoutePlan) -> dict[str, float]:
    return {part: hits / of for part, (hits, of) in compare(TOLD, plan).items()}


def test_a_plan_that_says_what_was_meant_is_right_in_every_part() -> None:
    assert set(shares(MEANT).values()) == {1.0}


def test_a_thing_at_another_turn_costs_the_cues_of_both() -> None:
    start, sofa, second = MEANT.legs
    legs = (start, replace(sofa, mentions=()), replace(second, mentions=(SOFA,)))
    found = shares(replace(MEANT, legs=legs))
    assert (found["sides"], found["cue"], found["whole"]) == (1.0, 0.0, 0.0)


def test_a_lost_turn_costs_the_sides_and_all_cues() -> None:
    found = shares(replace(MEANT, legs=MEANT.legs[:2]))
    assert (found["sides"], found["cue"], found["start"]) == (0.0, 0.0, 1.0)


def test_who_does_not_know_is_to_be_read_as_no_plan() -> None:
    unknown = replace(TOLD, facts=None)
    assert compare(unknown, RoutePlan()) == {"nothing": (True, 1)}
    assert compare(unknown, MEANT) == {"nothing": (False, 1)}


def test_each_half_has_voices_of_its_own() -> None:
    halves = [
        {
            told.answer.manner
            for told in tell(load_bank(), unread=half, texts=30, seed=1)
        }
        for half in (True, False)
    ]
    assert not halves[0] & halves[1]
    assert all(map(is_unread, halves[0]))
