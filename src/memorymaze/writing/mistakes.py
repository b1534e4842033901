"""Make a right plan wrong in one known way: a wrong turn, place or destination.

Every proposal is walked: only those that no longer arrive are errors.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from memorymaze.writing.following import follow, is_wrong
from memorymaze.writing.phrases import phrases
from memorymaze.writing.route_facts import RouteFacts
from memorymaze.writing.steps import (
    Beside,
    Cue,
    Ending,
    Mistake,
    Step,
    StepPlan,
    Stretch,
)
from memorymaze.writing.things import with_article
from memorymaze.writing.turning_point_graph import Side

OPPOSITE: Mapping[Side, Side] = {
    "left": "right",
    "right": "left",
    "slight_left": "slight_right",
    "slight_right": "slight_left",
}
SIDES: tuple[Side, ...] = ("left", "right")


def plain_side(side: Side) -> str:
    """Return a side in plain words."""
    return side.replace("_", " ")


def turns_with_choice(facts: RouteFacts, plan: StepPlan) -> list[Step]:
    """Return the told turns where one could go wrong; all of them where none is such.

    Whoever comes to a corner without a choice turns there, whatever is said.
    """
    told = [turn for turn in plan.turns if turn.told and not turn.extra]
    free = [turn for turn in told if _has_choice(facts, turn)]
    return free or told


def _has_choice(facts: RouteFacts, turn: Step) -> bool:
    heading = facts.headings.get(turn.at)
    return heading is not None and facts.graph.only_way(turn.at, heading) is None


def wrong_sides(
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield told turns with the other side."""
    del rng
    for turn in turns_with_choice(facts, plan):
        yield _flipped(plan, turn)


def _flipped(plan: StepPlan, turn: Step) -> Mistake:
    said = OPPOSITE[turn.side]
    return Mistake(
        "wrong_direction",
        turn.key,
        "side",
        turn.at,
        f"says {plain_side(said)}; the way goes {plain_side(turn.side)}",
        plan.with_turn(turn.key, side=said),
    )


def wrong_starts(
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
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
    if first is not None and first.stretch.length < 15 and not first.extra:
        yield _flipped(plan, first)


def missing_turns(
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
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
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield turns where the route goes straight on, or, without openings, anywhere."""
    found = [
        mistake
        for mistake in _extra_openings(facts, plan)
        if is_wrong(facts.graph, facts.route, mistake.plan)
    ]
    yield from found or _extra_nowhere(facts, plan, rng)


def _extra_openings(facts: RouteFacts, plan: StepPlan) -> Iterator[Mistake]:
    """Yield turns at openings that the way goes past."""
    route_turns = {turn.at: n for n, turn in enumerate(facts.route.turns)}
    keys = [turn.key for turn in plan.turns]
    for n, points in enumerate(facts.between):
        later = [
            t for t in plan.turns if not t.extra and route_turns.get(t.at, -1) >= n
        ]
        place = keys.index(later[0].key) if later else len(keys)
        for point in points:
            heading = facts.headings.get(point)
            for side in ("left", "right"):
                if heading is None or point in route_turns:
                    continue
                if facts.graph.leaving(point, heading, side) is None:
                    continue
                yield from _extra_at(facts, plan, place, point, side)


def _extra_at(
    facts: RouteFacts, plan: StepPlan, place: int, point: str, side: Side
) -> Iterator[Mistake]:
    """Yield a turn that can be made there, with a cue that leads there."""
    key = f"extra_{point}_{side}"
    cues = [Cue("ordinal", n) for n in (1, 2, 3)]
    cues += [
        Cue("thing", words=each.words)
        for each in facts.graph.things
        if each.words in facts.graph.marks[point]
        and math.dist(
            each.position, facts.graph.points[point].polygon.centroid.coords[0]
        )
        < 6
    ][:3]
    for cue in cues:
        turn = Step(key, side, cue, Stretch(0.0), point, extra=True)
        turns = (*plan.turns[:place], turn, *plan.turns[place:])
        wrong = replace(plan, turns=turns)
        made = follow(facts.graph, facts.route, wrong).turned
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
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield a turn where no way lies, for routes that pass no opening."""
    for place in range(len(plan.turns) + 1):
        side = SIDES[int(rng.choice(2))]
        at = "start" if place == 0 else f"after {plan.turns[place - 1].at}"
        turn = Step(
            f"extra_{place}", side, Cue("ordinal"), Stretch(0.0), at, extra=True
        )
        yield Mistake(
            "extra_turn",
            turn.key,
            "step",
            at,
            f"adds a turn {side} that the way does not have",
            replace(plan, turns=(*plan.turns[:place], turn, *plan.turns[place:])),
        )


def wrong_points(
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield turns at another opening on the same side than the right one."""
    del rng
    right = follow(facts.graph, facts.route, plan).turned
    told = [turn for turn in plan.turns if turn.told]
    for n, turn in enumerate(told):
        slight = turn.side.startswith("slight")
        if turn.extra or slight or not _has_choice(facts, turn):
            continue
        for ordinal in (1, 2, 3):
            cue = Cue("ordinal", ordinal)
            wrong = plan.with_turn(turn.key, cue=cue)
            made = follow(facts.graph, facts.route, wrong).turned
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


GOING_ON = 4.0
"""Metres between a destination and a place that is taken for it."""


def wrong_destinations(
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield ends at other things, on the last stretch or one or two turns before."""
    del rng
    goal = facts.route.goal_landmark
    last = plan.ending
    for each in last.stretch.beside:
        off = math.dist(each.thing.position, last.place)
        if off > GOING_ON and each.thing.id != goal:
            yield _ends_at(plan, each, last, last.stretch)
    turns = [turn for turn in plan.turns if turn.told]
    for cut in (1, 2):
        if len(turns) < cut:
            return
        gone = turns[-cut:]
        if any(turn.extra for turn in gone):
            return
        shorter = replace(plan, turns=plan.turns[: plan.turns.index(gone[0])])
        for each in gone[0].stretch.beside[-4:]:
            if each.thing.id != goal:
                yield _ends_at(shorter, each, last, gone[0].stretch)


def _ends_at(
    plan: StepPlan, beside: Beside, right: Ending, stretch: Stretch
) -> Mistake:
    thing = beside.thing
    claimed = with_article(thing, definite=True)
    ending = Ending(right.goal, thing.position, stretch, beside.side, thing, claimed)
    return Mistake(
        "wrong_destination",
        "arrival",
        "step",
        thing.id,
        f"ends at {claimed} and takes it for {right.goal}",
        replace(plan, ending=ending),
    )


def things_not_there(
    facts: RouteFacts, plan: StepPlan, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield turns that hang on a thing the floor does not have."""
    here = {thing.words for thing in facts.graph.things}
    words = [
        each
        for each in phrases("not_there")
        if not any(each.split()[-1] in known for known in here)
    ]
    for turn in turns_with_choice(facts, plan):
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
        for each in plan.ending.stretch.beside[:1]:
            thing = str(rng.choice(words))
            turn = Step(
                "extra_thing",
                each.side,
                Cue("thing", words=thing),
                Stretch(0.0),
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


TRIES = 40
"""Proposals that are walked, at most."""

Maker = Callable[[RouteFacts, StepPlan, np.random.Generator], Iterator[Mistake]]


def possible_mistakes(
    facts: RouteFacts,
    plan: StepPlan,
    kind: str,
    rng: np.random.Generator,
) -> Iterator[Mistake]:
    """Yield the errors of a kind that a plan can have, in random order.

    Args:
        facts: The route.
        plan: A plan for it; right, or wrong in other steps.
        kind: A name from `ERROR_KINDS`.
        rng: Source of chance.
    """
    proposals = list(MAKERS[kind](facts, plan, rng))
    for number in rng.permutation(len(proposals))[:TRIES]:
        proposal = proposals[number]
        if is_wrong(facts.graph, facts.route, proposal.plan):
            yield replace(proposal, kind=kind)


def made_wrong(
    facts: RouteFacts,
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
        for mistake in possible_mistakes(facts, plan, kind, rng):
            if mistake.key not in taken:
                if done and not _alone(facts, mistake, kind):
                    continue
                done.append(mistake)
                plan = mistake.plan
                break
    return tuple(done)


def _alone(facts: RouteFacts, mistake: Mistake, kind: str) -> bool:
    """Tell whether an error would be one without those made before it."""
    again = MAKERS[kind](facts, facts.plan, np.random.default_rng(0))
    return any(
        each.key == mistake.key and is_wrong(facts.graph, facts.route, each.plan)
        for each in again
    )


MAKERS: Mapping[str, Maker] = {
    "wrong_direction": wrong_sides,
    "wrong_turning_point": wrong_points,
    "extra_turn": extra_turns,
    "incorrect_direction": wrong_starts,
    "wrong_destination": wrong_destinations,
    "missing_turn": missing_turns,
    "wrong_direction_at_turn": wrong_sides,
    "inaccurate_environment": things_not_there,
}
