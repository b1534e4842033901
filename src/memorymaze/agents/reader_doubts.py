"""How likely what two readers take for a turn, or for the name of a destination, is one.

Both are logistic regressions on what tells of it, fitted on texts of which no reader learned
(`python -m benchmarks.reader_doubts`).
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading import is_common
from memorymaze.language.reading.marking import destination_chance

NAME_WEIGHTS = (-2.11, 0.32, 1.5, 1.96, 1.35, 1.97, 0.88)
"""Of what tells of a name, the constant first."""
TURN_WEIGHTS = (1.55, 0.46, 0.34, -0.69)
"""Of what tells of a turn, the constant first."""
LEAST_SAID, LEAST_MARKED = 0.01, 0.001
"""Probability of a name, and of a turn, to the network that counts at least, as does its
complement."""
LEAST_LIKELY, MOST_NAMES = 0.1, 3
"""Names that are less likely are left out, and so are all after so many."""


def likely_names(
    text: str, parsed: RoutePlan, marked: RoutePlan
) -> list[tuple[str, float]]:
    """Return names of the destination and how likely they are, the likeliest first.

    They are those of the grammar's and of the network's plan of a text.
    """
    chances: list[tuple[str, float]] = []
    for name in names_read(parsed, marked):
        chance = _chance(NAME_WEIGHTS, what_tells_of_name(name, text, parsed, marked))
        if chance >= LEAST_LIKELY:
            chances.append((name, chance))
    return sorted(chances, key=lambda each: -each[1])[:MOST_NAMES]


def names_read(parsed: RoutePlan, marked: RoutePlan) -> tuple[str, ...]:
    """Return what either takes for a name of the destination, the network's first."""
    both = *marked.arrival.destinations, *parsed.arrival.destinations
    return tuple(dict.fromkeys(both))


def what_tells_of_name(
    name: str, text: str, parsed: RoutePlan, marked: RoutePlan
) -> Sequence[float]:
    """Return 1, and what tells whether a name is that of the destination.

    It is the log odds of its last word to the network, or whether the text has no such word;
    whether the network marks it, whether both have it, whether the network has none and it is
    the grammar's first, and whether it is of a kind that is everywhere.
    """
    by_network, by_grammar = marked.arrival.destinations, parsed.arrival.destinations
    chance = destination_chance(text, name.split()[-1].casefold())
    said = 0.0
    if chance is not None:
        said = _log_odds(chance, LEAST_SAID)
    return (
        1.0,
        said,
        chance is None,
        name in by_network,
        name in by_network and name in by_grammar,
        not by_network and name == by_grammar[0],
        is_common(name),
    )


def with_doubted_turns(
    parsed: RoutePlan, marked: RoutePlan
) -> tuple[RoutePlan, RoutePlan]:
    """Return the grammar's and the network's plan with how likely each leg has no turn.

    It is how likely that is if the plan is the better of the two: which one is, is another
    question, and the guide's.
    """
    plans: list[RoutePlan] = []
    for plan, told in zip(
        (parsed, marked), what_tells_of_turns(parsed, marked), strict=True
    ):
        doubts = (round(1 - _chance(TURN_WEIGHTS, each), 3) for each in told)
        legs = [
            replace(leg, unclear=doubt)
            for leg, doubt in zip(plan.legs, doubts, strict=True)
        ]
        plans.append(replace(plan, legs=tuple(legs)))
    return plans[0], plans[1]


def what_tells_of_turns(
    parsed: RoutePlan, marked: RoutePlan
) -> tuple[list[Sequence[float]], list[Sequence[float]]]:
    """Return 1, and what tells whether a turn is meant, of each of the grammar's and the network's.

    It is the log odds that it is one to the network, whether only the grammar has it, and the
    logarithm of 1 and how many turns only one of them has.
    """
    both = dict(aligned_turns(parsed, marked))
    alone = len(parsed.legs) + len(marked.legs) - 2 * len(both)
    odds = [_log_odds(1 - leg.unclear, LEAST_MARKED) for leg in marked.legs]
    grammar = [
        (1.0, odds[both[n]] if n in both else 0.0, n not in both, math.log1p(alone))
        for n in range(len(parsed.legs))
    ]
    return [*grammar], [(1.0, each, 0.0, math.log1p(alone)) for each in odds]


def aligned_turns(reference: RoutePlan, read: RoutePlan) -> list[tuple[int, int]]:
    """Return which legs correspond: a longest common sequence of turns to one side."""
    one = [leg.turn.way for leg in reference.legs]
    two = [leg.turn.way for leg in read.legs]
    longest = [[0] * (len(two) + 1) for _ in range(len(one) + 1)]
    for i in reversed(range(len(one))):
        for j in reversed(range(len(two))):
            skipped = max(longest[i + 1][j], longest[i][j + 1])
            taken = longest[i + 1][j + 1] + 1 if one[i] == two[j] else 0
            longest[i][j] = max(skipped, taken)
    pairs: list[tuple[int, int]] = []
    i = j = 0
    while i < len(one) and j < len(two):
        if one[i] == two[j] and longest[i][j] == longest[i + 1][j + 1] + 1:
            pairs.append((i, j))
            i, j = i + 1, j + 1
        elif longest[i + 1][j] >= longest[i][j + 1]:
            i += 1
        else:
            j += 1
    return pairs


def _chance(weights: Sequence[float], told: Sequence[float]) -> float:
    total = sum(weight * each for weight, each in zip(weights, told, strict=True))
    return 1 / (1 + math.exp(-total))


def _log_odds(chance: float, least: float) -> float:
    chance = min(max(chance, least), 1 - least)
    return math.log(chance / (1 - chance))
