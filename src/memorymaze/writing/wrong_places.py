"""Errors in places: the wrong destination, and things that are not there.

These are proposals; `mistakes.py` walks them.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from memorymaze.writing.reading import RouteReading
from memorymaze.writing.steps import (
    Arrival,
    Cue,
    Leg,
    Mistake,
    StepPlan,
    Turn,
)
from memorymaze.writing.things import Thing, with_article
from memorymaze.writing.walks import side_of
from memorymaze.writing.wrong_turns import plain_side, turns_with_choice

NOT_THERE = (
    "red telephone box",
    "grand piano",
    "big fish tank",
    "water fountain with the lion",
    "spiral staircase",
    "flower stall",
    "wooden clock tower",
    "row of lockers",
    "photo booth",
    "yellow ticket machine",
    "stuffed bear",
    "cash machine",
    "model train",
    "big stone globe",
)
"""Things that people may remember from somewhere else."""
GOING_ON = 4.0
"""Metres between a destination and a place that is taken for it."""


def wrong_destinations(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield ends at other things, on the last stretch or one or two turns before."""
    del rng
    goal = reading.route.goal_landmark
    last = plan.arrival
    for passing in last.leg.passing:
        off = math.dist(passing.thing.position, last.place)
        if off > GOING_ON and passing.thing.id != goal:
            yield _ends_at(plan, passing.thing, passing.side, last, last.leg)
    turns = [turn for turn in plan.turns if turn.told]
    for cut in (1, 2):
        if len(turns) < cut:
            return
        gone = turns[-cut:]
        if any(turn.extra for turn in gone):
            return
        shorter = replace(plan, turns=plan.turns[: plan.turns.index(gone[0])])
        for passing in gone[0].leg.passing[-4:]:
            if passing.thing.id != goal:
                yield _ends_at(shorter, passing.thing, passing.side, last, gone[0].leg)


def _ends_at(
    plan: StepPlan, thing: Thing, side: str, right: Arrival, leg: Leg
) -> Mistake:
    claimed = with_article(thing, definite=True)
    arrival = Arrival(right.goal, thing.position, leg, side, thing, claimed)
    return Mistake(
        "wrong_destination",
        "arrival",
        "step",
        thing.id,
        f"ends at {claimed} and takes it for {right.goal}",
        replace(plan, arrival=arrival),
    )


def things_not_there(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield turns that hang on a thing the floor does not have."""
    here = {thing.words for thing in reading.floor.things}
    words = [
        each
        for each in NOT_THERE
        if not any(each.split()[-1] in known for known in here)
    ]
    for turn in turns_with_choice(reading, plan):
        thing = str(rng.choice(words))
        yield Mistake(
            "inaccurate_environment",
            turn.key,
            "cue",
            turn.at,
            f"makes the turn {plain_side(turn.side)} hang on a {thing}; there is none",
            plan.with_turn(turn.key, cue=Cue("thing", words=thing)),
        )
    if not plan.turns:
        for passing in plan.arrival.leg.passing[:1]:
            thing = str(rng.choice(words))
            turn = Turn(
                "extra_thing",
                side_of(1.0 if passing.side == "left" else -1.0),
                Cue("thing", words=thing),
                Leg(0.0),
                "the way",
                extra=True,
            )
            yield Mistake(
                "inaccurate_environment",
                turn.key,
                "step",
                "the way",
                f"tells of a {thing} and a turn there; there is neither",
                replace(plan, turns=(turn,)),
            )
