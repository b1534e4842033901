"""A model that is held to the grammar of plans writes plans."""

import json
import random

import pytest
from tests.said_by_grammar import Sentences

from memorymaze.language.plans.files import parse_plan, plan_record
from memorymaze.language.plans.grammar import plan_grammar
from memorymaze.language.plans.records import Leg, Mention, Turn


@pytest.mark.parametrize("seed", range(25))
def test_every_reply_of_the_grammar_is_a_plan(seed: int) -> None:
    reply = Sentences(plan_grammar(), random.Random(seed)).say()
    plan = parse_plan(json.loads(reply), "reply")
    assert len(plan.legs) <= 12


def test_the_grammar_knows_every_field_of_legs_and_things() -> None:
    replies = [
        Sentences(plan_grammar(), random.Random(seed)).say() for seed in range(80)
    ]
    plans = [parse_plan(json.loads(reply), "reply") for reply in replies]
    legs = [leg for plan in plans for leg in plan.legs]
    things = [thing for leg in legs for thing in leg.mentions]
    for kind, records in (
        (Leg, legs),
        (Turn, [e.turn for e in legs]),
        (Mention, things),
    ):
        written = {key for each in records for key in plan_record(each)}
        assert written == set(kind.__dataclass_fields__)
