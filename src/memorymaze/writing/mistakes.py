"""Make a right plan wrong in one known way.

Every proposal is walked: only those that no longer arrive are errors.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from memorymaze.writing.reading import RouteReading
from memorymaze.writing.steps import Mistake, StepPlan
from memorymaze.writing.walking import is_wrong
from memorymaze.writing.wrong_places import (
    things_not_there,
    wrong_destinations,
)
from memorymaze.writing.wrong_turns import (
    extra_turns,
    missing_turns,
    wrong_points,
    wrong_sides,
    wrong_starts,
)

TRIES = 40
"""Proposals that are walked, at most."""


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
    """
    proposals = list(MAKERS[kind](reading, plan, rng))
    for number in rng.permutation(len(proposals))[:TRIES]:
        proposal = proposals[number]
        if is_wrong(reading.floor, reading.route, proposal.plan):
            yield _named(proposal, kind)


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
                if done and not _alone(reading, mistake, kind):
                    continue
                done.append(mistake)
                plan = mistake.plan
                break
    return tuple(done)


def _alone(reading: RouteReading, mistake: Mistake, kind: str) -> bool:
    """Tell whether an error would be one without those made before it."""
    again = MAKERS[kind](reading, reading.plan, np.random.default_rng(0))
    return any(
        each.key == mistake.key and is_wrong(reading.floor, reading.route, each.plan)
        for each in again
    )


def _named(mistake: Mistake, kind: str) -> Mistake:
    """Return a mistake under the name that it has in a study."""
    return replace(mistake, kind=kind)


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
