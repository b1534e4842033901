from pathlib import Path

from benchmarks.reading import (
    Score,
    legs_as_told,
    made_table,
    recorded_plans,
)

from memorymaze.language.plans import Arrival, Leg, Length, Mention, RoutePlan, Turn

CLOCK = Mention("clock", "object", "turn")
TOLD = RoutePlan(
    legs=(
        Leg(Turn("left", ordinal=2), length=Length(10, "metres"), mentions=(CLOCK,)),
        Leg(Turn("right")),
        Leg(Turn("left")),
    ),
    arrival=Arrival(("sign that says Library",)),
)


def parts(reference: RoutePlan, read: RoutePlan) -> dict[str, float | None]:
    score = Score()
    score.add(reference, read)
    return {name: part.f1 for name, part in score.parts.items()}


def test_a_plan_agrees_with_itself_in_every_part() -> None:
    score = Score()
    for plan in recorded_plans("plans_second_reading").values():
        score.add(plan, plan)
    assert {part.f1 for part in score.parts.values()} == {1.0}


def test_a_lost_turn_costs_order_and_recall_and_no_other_part() -> None:
    found = parts(TOLD, RoutePlan(legs=TOLD.legs[:2], arrival=TOLD.arrival))
    assert (found["turns"], found["turn"]) == (0.0, 0.8)
    assert [found[each] for each in ("ordinal", "length", "landmark")] == [1.0] * 3


def test_counts_lengths_and_things_are_compared_at_their_turns() -> None:
    first = Leg(
        Turn("left", ordinal=1),
        length=Length(9, "metres"),
        mentions=(
            Mention("clock", "object", "passed"),
            Mention("bench", "object", "turn"),
        ),
    )
    found = parts(TOLD, RoutePlan(legs=(first, *TOLD.legs[1:])))
    assert found["turns"] == 1.0
    assert found["ordinal"] == 0.0
    assert found["length"] == 1.0  # within a fifth
    assert found["landmark"] == 2 / 3  # one of one, and one of two
    assert found["placed"] == 0.0


def test_a_destination_is_the_same_by_its_sign_or_its_name() -> None:
    assert parts(TOLD, RoutePlan(arrival=Arrival(("library",))))["destination"] == 1.0
    assert parts(TOLD, RoutePlan(arrival=Arrival(("cafe",))))["destination"] == 0.0
    assert parts(RoutePlan(), RoutePlan())["destination"] is None


def test_a_leg_is_read_as_told_where_its_turn_count_and_thing_are() -> None:
    def at(thing: str, ordinal: int | None = None) -> Leg:
        return Leg(
            Turn("left", ordinal=ordinal), mentions=(Mention(thing, "door", "turn"),)
        )

    told = RoutePlan(legs=(at("room 2103", 1), at("door that says Café", 2)))
    same = RoutePlan(legs=(at("door that says 2103"), at("sign that says Café", 2)))
    assert legs_as_told(told, same) == 2
    assert legs_as_told(told, RoutePlan(legs=(at("room 2103"), at("bench", 2)))) == 1
    assert legs_as_told(told, RoutePlan(legs=(at("room 2103"), at("Café", 3)))) == 1
    assert legs_as_told(told, RoutePlan()) == 0


def test_a_made_text_has_a_row_for_its_kind_and_one_for_all(tmp_path: Path) -> None:
    rows = {row["kind"]: row for row in made_table(1, 3, tmp_path, ("office",)).rows}
    assert list(rows) == ["office", "all"]
    assert rows["office"]["texts"] == rows["all"]["texts"] > 0
    assert 0 < rows["all"]["legs"] <= 1
