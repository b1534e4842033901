"""Make a right plan wrong in one known way.

Every proposal is walked: only those that no longer arrive are errors.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from memorymaze.instructions.generation.reading import RouteReading
from memorymaze.instructions.generation.steps import Arrival, Cue, Leg, StepPlan, Turn
from memorymaze.instructions.generation.things import Thing, with_article
from memorymaze.instructions.generation.walking import walk
from memorymaze.instructions.generation.walks import Side, side_of

__all__ = ["Mistake", "made_wrong", "possible_mistakes"]

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
OPPOSITE = {"left": "right", "right": "left"}
GOING_ON = 4.0
"""Metres between a destination and a place that is taken for it."""
TRIES = 40


@dataclass(frozen=True, slots=True)
class Mistake:
    """One significant error in a plan."""

    kind: str
    key: str
    """The step it is in: a turn's key, `start` or `arrival`."""
    part: str
    """What of the step is wrong: `side`, `cue`, `step`, or `gone` for a step that is
    missing."""
    where: str
    """Turning point id or place."""
    detail: str
    plan: StepPlan
    """The plan with this error."""


Maker = Callable[[RouteReading, StepPlan, np.random.Generator], Iterator[Mistake]]


def possible_mistakes(
    reading: RouteReading,
    plan: StepPlan,
    kind: str,
    rng: np.random.Generator,
) -> Iterator[Mistake]:
    """Yield the errors of a kind that a plan can have, in random order.

    Args:
        reading: The route.
        plan: A plan for it; right, or wrong in other steps.
        kind: A name from `ERROR_KINDS`.
        rng: Source of chance.

    Yields:
        Errors with which the plan does not arrive.
    """
    proposals = list(MAKERS[kind](reading, plan, rng))
    for number in rng.permutation(len(proposals))[:TRIES]:
        proposal = proposals[number]
        found = walk(reading.floor, reading.route, replace_kind(proposal, kind).plan)
        if not found.arrived:
            yield replace_kind(proposal, kind)


def made_wrong(
    reading: RouteReading,
    plan: StepPlan,
    kinds: tuple[str, ...],
    rng: np.random.Generator,
) -> tuple[Mistake, ...]:
    """Put errors of several kinds into a plan, each into a step of its own.

    Returns:
        The errors in order of making; the last one's plan has all of them. A kind for
        which the plan has no room is left out.
    """
    done: list[Mistake] = []
    for kind in kinds:
        taken = {mistake.key for mistake in done}
        for mistake in possible_mistakes(reading, plan, kind, rng):
            if mistake.key not in taken:
                alone = done and _alone(reading, mistake, kind)
                if done and not alone:
                    continue
                done.append(mistake)
                plan = mistake.plan
                break
    return tuple(done)


def _alone(reading: RouteReading, mistake: Mistake, kind: str) -> bool:
    """Tell whether an error would be one without those made before it."""
    again = MAKERS[kind](reading, reading.plan, np.random.default_rng(0))
    return any(
        each.key == mistake.key
        and not walk(reading.floor, reading.route, each.plan).arrived
        for each in again
    )


def replace_kind(mistake: Mistake, kind: str) -> Mistake:
    """Return a mistake under the name that it has in a study."""
    return replace(mistake, kind=kind)


def _opposite(side: Side) -> Side:
    head, _, tail = side.rpartition("_")
    other = OPPOSITE[tail]
    return f"{head}_{other}" if head else other


def _plain(side: Side) -> str:
    return side.replace("_", " ")


def _wrong_side(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    del rng
    for turn in plan.turns:
        if turn.told and not turn.extra:
            yield _flipped(plan, turn)


def _flipped(plan: StepPlan, turn: Turn) -> Mistake:
    said = _opposite(turn.side)
    return Mistake(
        "wrong_direction",
        turn.key,
        "side",
        turn.at,
        f"says {_plain(said)}; the way goes {_plain(turn.side)}",
        plan.with_turn(turn.key, side=said),
    )


def _wrong_start(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    del rng
    if not plan.around:
        yield Mistake(
            "incorrect_direction",
            "start",
            "step",
            "start",
            "tells to turn around first; the way goes ahead",
            replace(plan, around=True),
        )
    first = next((turn for turn in plan.turns if turn.told), None)
    if first is not None and first.leg.length < 15 and not first.extra:
        yield _flipped(plan, first)


def _missing(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    del rng
    for turn in plan.turns:
        if turn.told and turn.cue.kind != "forced" and not turn.extra:
            yield Mistake(
                "missing_turn",
                turn.key,
                "gone",
                turn.at,
                f"leaves out the turn {_plain(turn.side)}",
                plan.without(turn.key),
            )


def _extra(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    found = [
        mistake
        for mistake in _extra_openings(reading, plan)
        if not walk(reading.floor, reading.route, mistake.plan).arrived
    ]
    yield from found or _extra_nowhere(reading, plan, rng)


def _extra_openings(reading: RouteReading, plan: StepPlan) -> Iterator[Mistake]:
    """Yield turns at openings that the way goes past."""
    route_turns = {turn.at: n for n, turn in enumerate(reading.route.turns)}
    keys = [turn.key for turn in plan.turns]
    for n, points in enumerate(reading.between):
        later = [
            t for t in plan.turns if not t.extra and route_turns.get(t.at, -1) >= n
        ]
        place = keys.index(later[0].key) if later else len(keys)
        for point in points:
            heading = reading.headings.get(point)
            for side in ("left", "right"):
                if heading is None or point in route_turns:
                    continue
                if reading.floor.leaving(point, heading, side) is None:
                    continue
                yield from _extra_at(reading, plan, place, point, side)


def _extra_at(
    reading: RouteReading, plan: StepPlan, place: int, point: str, side: str
) -> Iterator[Mistake]:
    """Yield a turn that can be made there, with a cue that leads there."""
    key = f"extra_{point}_{side}"
    cues = [Cue("ordinal", n) for n in (1, 2, 3)]
    cues += [
        Cue("thing", words=each.words, proper=each.proper)
        for each in reading.floor.things
        if each.words in reading.floor.marks[point]
        and math.dist(
            each.position, reading.floor.points[point].polygon.centroid.coords[0]
        )
        < 6
    ][:3]
    for cue in cues:
        turn = Turn(key, side, cue, Leg(0.0), point, extra=True)
        turns = (*plan.turns[:place], turn, *plan.turns[place:])
        wrong = replace(plan, turns=turns)
        made = walk(reading.floor, reading.route, wrong).turned
        told = [each for each in turns[:place] if each.told]
        if len(made) > len(told) and made[len(told)] == point:
            yield Mistake(
                "extra_turn",
                key,
                "step",
                point,
                f"adds a turn {side}; the way goes straight on there",
                wrong,
            )


def _extra_nowhere(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield a turn where no way lies, for routes that pass no opening."""
    for place in range(len(plan.turns) + 1):
        side = str(rng.choice(["left", "right"]))
        at = "start" if place == 0 else f"after {plan.turns[place - 1].at}"
        turn = Turn(f"extra_{place}", side, Cue("ordinal"), Leg(0.0), at, extra=True)
        yield Mistake(
            "extra_turn",
            turn.key,
            "step",
            at,
            f"adds a turn {side} that the way does not have",
            replace(plan, turns=(*plan.turns[:place], turn, *plan.turns[place:])),
        )


def _wrong_point(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    del rng
    right = walk(reading.floor, reading.route, plan).turned
    told = [turn for turn in plan.turns if turn.told]
    for n, turn in enumerate(told):
        if turn.extra or turn.side.startswith("slight"):
            continue
        for ordinal in (1, 2, 3):
            cue = Cue("ordinal", ordinal)
            wrong = plan.with_turn(turn.key, cue=cue)
            made = walk(reading.floor, reading.route, wrong).turned
            if cue == turn.cue or len(made) <= n or made[: n + 1] == right[: n + 1]:
                continue
            yield Mistake(
                "wrong_turning_point",
                turn.key,
                "cue",
                turn.at,
                f"says to turn {turn.side} at {made[n]}; the way turns at {turn.at}",
                wrong,
            )


def _wrong_end(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
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


def _not_there(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    here = {thing.words for thing in reading.floor.things}
    words = [
        each
        for each in NOT_THERE
        if not any(each.split()[-1] in known for known in here)
    ]
    for turn in plan.turns:
        if not turn.told or turn.extra:
            continue
        thing = str(rng.choice(words))
        yield Mistake(
            "inaccurate_environment",
            turn.key,
            "cue",
            turn.at,
            f"makes the turn {_plain(turn.side)} hang on a {thing}; there is none",
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


MAKERS: Mapping[str, Maker] = {
    "wrong_direction": _wrong_side,
    "wrong_turning_point": _wrong_point,
    "extra_turn": _extra,
    "incorrect_direction": _wrong_start,
    "wrong_destination": _wrong_end,
    "missing_turn": _missing,
    "wrong_direction_at_turn": _wrong_side,
    "inaccurate_environment": _not_there,
}
