"""Choose how a speaker tells a route: by which cues, and which corners without a word."""

from dataclasses import replace

import numpy as np

from memorymaze.writing.reading import RouteReading
from memorymaze.writing.steps import Cue, StepPlan, Turn
from memorymaze.writing.voices import Voice
from memorymaze.writing.walking import is_right

THING_WEIGHT, ORDINAL_WEIGHTS, END_WEIGHT = 1.2, (1.2, 0.9, 0.3), 1.3
RARE = 0.02
"""Weight of a cue that nobody would choose who has another."""
FEW_THINGS = 2
"""Things at one place that a speaker chooses from."""


def chosen_plan(
    reading: RouteReading, voice: Voice, rng: np.random.Generator
) -> StepPlan:
    """Return a right plan as one speaker would tell it; it arrives when walked."""
    plan = reading.plan
    turns: list[Turn] = []
    for turn, cues in zip(plan.turns, reading.cues, strict=True):
        # One thing marks one turn.
        used = {each.cue.words for each in turns if each.cue.words}
        fresh = tuple(cue for cue in cues if cue.words not in used)
        turns.append(replace(turn, cue=_cue(turn, fresh, rng)))
    plan = replace(plan, turns=tuple(turns))
    if not is_right(reading.floor, reading.route, plan):
        plan = reading.plan
    for turn in plan.turns:
        corner = turn.cue.kind == "forced" and len(plan.turns) > 1
        if rng.random() < voice.surface.skipped_corner and corner:
            shorter = plan.with_turn(turn.key, told=False)
            if any(each.told for each in shorter.turns) and is_right(
                reading.floor, reading.route, shorter
            ):
                plan = shorter
    return plan


def _cue(turn: Turn, cues: tuple[Cue, ...], rng: np.random.Generator) -> Cue:
    things = [cue for cue in cues if cue.kind == "thing"]
    if things:
        # Two of the same words can stand at one place.
        distinct = list({cue.words: cue for cue in things}.values())
        drawn = rng.permutation(len(distinct))[:FEW_THINGS]
        things = [distinct[number] for number in drawn]
    others = [cue for cue in cues if cue.kind != "thing"]
    pool = [*others, *things]
    weights = np.array([_weight(cue, turn) for cue in pool])
    return pool[int(rng.choice(len(pool), p=weights / weights.sum()))]


def _weight(cue: Cue, turn: Turn) -> float:
    if cue.kind == "thing":
        return THING_WEIGHT if turn.leg.length > 2 else RARE
    if cue.kind == "ordinal":
        return ORDINAL_WEIGHTS[cue.ordinal - 1] if cue.ordinal <= 3 else RARE
    return END_WEIGHT
