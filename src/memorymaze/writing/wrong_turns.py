"""Errors in turns: the wrong side, the wrong place, one too many, one too few.

These are proposals; `mistakes.py` walks them.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from memorymaze.writing.reading import RouteReading
from memorymaze.writing.steps import Cue, Leg, Mistake, StepPlan, Turn
from memorymaze.writing.walking import is_wrong, walk
from memorymaze.writing.walks import Side

OPPOSITE = {"left": "right", "right": "left"}


def _opposite(side: Side) -> Side:
    head, _, tail = side.rpartition("_")
    other = OPPOSITE[tail]
    return f"{head}_{other}" if head else other


def plain_side(side: Side) -> str:
    """Return a side in plain words."""
    return side.replace("_", " ")


def turns_with_choice(reading: RouteReading, plan: StepPlan) -> list[Turn]:
    """Return the told turns where one could go wrong; all of them where none is such.

    Whoever comes to a corner without a choice turns there, whatever is said.
    """
    told = [turn for turn in plan.turns if turn.told and not turn.extra]
    free = [turn for turn in told if _has_choice(reading, turn)]
    return free or told


def _has_choice(reading: RouteReading, turn: Turn) -> bool:
    heading = reading.headings.get(turn.at)
    return heading is not None and reading.floor.only_way(turn.at, heading) is None


def wrong_sides(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield told turns with the other side."""
    del rng
    for turn in turns_with_choice(reading, plan):
        yield _flipped(plan, turn)


def _flipped(plan: StepPlan, turn: Turn) -> Mistake:
    said = _opposite(turn.side)
    return Mistake(
        "wrong_direction",
        turn.key,
        "side",
        turn.at,
        f"says {plain_side(said)}; the way goes {plain_side(turn.side)}",
        plan.with_turn(turn.key, side=said),
    )


def wrong_starts(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield what sends the listener off the wrong way."""
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


def missing_turns(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield every told turn left out, apart from corners without a choice."""
    del rng
    for turn in plan.turns:
        if turn.told and turn.cue.kind != "forced" and not turn.extra:
            yield Mistake(
                "missing_turn",
                turn.key,
                "gone",
                turn.at,
                f"leaves out the turn {plain_side(turn.side)}",
                plan.without(turn.key),
            )


def extra_turns(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield turns where the route goes straight on, or, without openings, anywhere."""
    found = [
        mistake
        for mistake in _extra_openings(reading, plan)
        if is_wrong(reading.floor, reading.route, mistake.plan)
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


def wrong_points(
    reading: RouteReading, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield turns at another opening on the same side than the right one."""
    del rng
    right = walk(reading.floor, reading.route, plan).turned
    told = [turn for turn in plan.turns if turn.told]
    for n, turn in enumerate(told):
        slight = turn.side.startswith("slight")
        if turn.extra or slight or not _has_choice(reading, turn):
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
