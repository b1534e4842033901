"""How likely what two readers take for the name of a destination is one."""

import math
from collections.abc import Sequence

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading import is_common
from memorymaze.language.reading.marking import destination_chance

WEIGHTS = (-2.11, 0.32, 1.5, 1.96, 1.35, 1.97, 0.88)
"""Of a logistic regression on what tells of a name, and its constant first: fitted on texts of
which no reader learned (`python -m benchmarks.naming`)."""
LEAST_SAID = 0.01
"""Probability to the network that counts at least, as does its complement."""
LEAST_LIKELY, MOST_NAMES = 0.1, 3
"""Names that are less likely are left out, and so are all after so many."""


def likely_names(
    text: str, parsed: RoutePlan, marked: RoutePlan
) -> list[tuple[str, float]]:
    """Return names of the destination and how likely they are, the likeliest first.

    They are those of the grammar's and of the network's plan of a text.
    """
    names = dict.fromkeys((*marked.arrival.destinations, *parsed.arrival.destinations))
    chances: list[tuple[str, float]] = []
    for name in names:
        told = zip(WEIGHTS, what_tells(name, text, parsed, marked), strict=True)
        chance = 1 / (1 + math.exp(-sum(weight * each for weight, each in told)))
        if chance >= LEAST_LIKELY:
            chances.append((name, chance))
    return sorted(chances, key=lambda each: -each[1])[:MOST_NAMES]


def what_tells(
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
        chance = min(max(chance, LEAST_SAID), 1 - LEAST_SAID)
        said = math.log(chance / (1 - chance))
    return (
        1.0,
        said,
        chance is None,
        name in by_network,
        name in by_network and name in by_grammar,
        not by_network and name == by_grammar[0],
        is_common(name),
    )
