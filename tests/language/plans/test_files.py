"""Route plans as JSON: nothing is lost, and what is wrong is named."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import PlanFileError
from memorymaze.language.plans import (
    Mention,
    RoutePlan,
    load_plans,
    parse_plan,
    plan_lines,
    plan_record,
)

READ_PLANS = Path(__file__).parent / "read_plans.jsonl"
"""Plans that a language model read from texts; together they have every key."""


def _without_empties(value: Any) -> Any:
    if isinstance(value, list):
        return [_without_empties(each) for each in value]
    if not isinstance(value, dict):
        return value
    told = {key: _without_empties(each) for key, each in value.items()}
    return {
        key: each for key, each in told.items() if each or key in {"legs", "arrival"}
    }


def test_plans_come_back_from_a_file_as_they_were(tmp_path: Path) -> None:
    plans = load_plans(READ_PLANS)
    copy = tmp_path / "copy.jsonl"
    copy.write_text(plan_lines(plans), encoding="utf-8")
    assert load_plans(copy) == plans


def test_a_record_says_what_the_file_said_but_for_empty_keys() -> None:
    lines = READ_PLANS.read_text(encoding="utf-8").splitlines()
    records = {each["id"]: each["plan"] for each in map(json.loads, lines)}
    written = {name: plan_record(plan) for name, plan in load_plans(READ_PLANS).items()}
    assert _without_empties(written) == _without_empties(records)


@given(data=st.data())
def test_any_plan_comes_back_from_its_record(
    any_plans: st.SearchStrategy[RoutePlan], data: st.DataObject
) -> None:
    plan = data.draw(any_plans)
    record = json.loads(json.dumps(plan_record(plan)))
    assert parse_plan(record, "here") == plan


def test_a_thing_of_which_only_the_name_is_told_is_an_object_along_the_stretch() -> (
    None
):
    plan = parse_plan({"arrival": {"mentions": [{"phrase": "clock"}]}}, "here")
    assert plan.arrival.mentions == (Mention("clock", "object", "along"),)
    [written] = plan_record(plan)["arrival"]["mentions"]
    assert written == {"phrase": "clock", "kind": "object", "place": "along"}


def test_an_empty_plan_has_legs_and_an_arrival() -> None:
    assert plan_record(RoutePlan()) == {"legs": [], "arrival": {}}


@pytest.mark.parametrize(
    ("record", "complaint"),
    [
        pytest.param(
            {"legs": [{"turn": {"way": "lft"}}]},
            r"'legs.0.turn.way': expected it to be 'left', .*, got \"lft\"",
            id="unknown word",
        ),
        pytest.param(
            {"legs": [{"turn": {"way": "left"}, "passing": 1}]},
            "'legs.0.passing': .* did you mean 'passings'",
            id="unknown key",
        ),
        pytest.param({"legs": [{}]}, "'legs.0.turn': expected it", id="missing key"),
        pytest.param(
            {"arrival": {"mentions": [{"place": "along"}]}},
            "'arrival.mentions.0.phrase': expected it, got nothing",
            id="a thing without a name",
        ),
        pytest.param({"arrival": {"nth": 0}}, "'arrival.nth': .* got 0", id="number 0"),
        pytest.param(
            {"arrival": {"doubt": 2}}, "'arrival.doubt': .* got 2", id="doubt above 1"
        ),
        pytest.param(
            {"start": {"facing": " "}}, "'start.facing': ", id="words without words"
        ),
        pytest.param([], "expected it to be an object", id="no record"),
    ],
)
def test_what_is_wrong_in_a_plan_is_named(record: object, complaint: str) -> None:
    with pytest.raises(PlanFileError, match=f"^plans.jsonl:3: .*{complaint}"):
        parse_plan(record, "plans.jsonl:3")


@pytest.mark.parametrize(
    ("lines", "complaint"),
    [
        pytest.param('{"id": "a"}', ":1: expected a record", id="no plan"),
        pytest.param("{", ":1: ", id="no JSON"),
        pytest.param(
            '{"id": "a", "plan": {}}\n\n{"id": "a", "plan": {}}',
            ":3: field 'id': .* no line above has, got 'a'",
            id="an id twice",
        ),
        pytest.param(
            '{"id": "a", "plan": {"legs": 3}}',
            ":1: plan of a: field 'legs'",
            id="no plan language",
        ),
    ],
)
def test_a_bad_line_is_named_by_its_number(
    tmp_path: Path, lines: str, complaint: str
) -> None:
    file = tmp_path / "plans.jsonl"
    file.write_text(lines, encoding="utf-8")
    with pytest.raises(PlanFileError, match=complaint):
        load_plans(file)
