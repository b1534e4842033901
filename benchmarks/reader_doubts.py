"""How likely what two readers take for a turn, or a destination's name, is one.

`python -m benchmarks.reader_doubts` fits the weights of `memorymaze.agents.reader_doubts` on the
invented texts that no reader learned from (`examples/marked_texts/not_learned.jsonl`), and
shows how well they tell on the writers left out of each fit (docs/lab/learned_reader.md).
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from benchmarks.marking.marked_texts import load_kept_back, plan_as_marked
from benchmarks.reading import names_of
from memorymaze.agents.reader_doubts import (
    aligned_turns,
    names_read,
    what_tells_of_name,
    what_tells_of_turns,
)
from memorymaze.basics.tables import Column, Table
from memorymaze.language.plans import Arrival, RoutePlan
from memorymaze.language.reading import parse_route_description
from memorymaze.language.reading.marking import read_by_marks
from memorymaze.language.reading.marking.word_pieces import words_in

RIDGE = 1.0
"""How strongly weights are drawn to nothing; the constant is not."""
STEPS = 50
SHARES = 0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 1.0

Values = NDArray[np.float64]


@dataclass
class Told:
    """What tells of each name or turn, and whether it is right."""

    rows: list[tuple[float, ...]] = field(default_factory=list[tuple[float, ...]])
    right: list[bool] = field(default_factory=list[bool])
    counts: list[float] = field(default_factory=list[float])
    """How much each counts."""
    writers: list[str] = field(default_factory=list[str])
    texts: list[str] = field(default_factory=list[str])

    def add(self, text: str, told: Iterable[float], right: bool, count: float) -> None:
        """Add one; the id of its text names the writer."""
        self.rows.append(tuple(map(float, told)))
        self.right.append(right)
        self.counts.append(count)
        self.writers.append(text.split("-")[1])
        self.texts.append(text)

    def fit(self) -> tuple[Values, Values]:
        """Return the weights, and the chances by weights of the other writers."""
        rows, right = np.array(self.rows), np.array(self.right)
        counts, by = np.array(self.counts), np.array(self.writers)
        chances = np.zeros(len(rows))
        for writer in sorted(set(self.writers)):
            out = by == writer
            weights = _fit(rows[~out], right[~out], counts[~out])
            chances[out] = _chance(rows[out], weights)
        return _fit(rows, right, counts), chances


def main() -> None:
    """Fit, and print the weights and what they are worth."""
    names, turns = Told(), Told()
    for marked, text in load_kept_back():
        told = plan_as_marked(text, words_in(text), marked.words)
        parsed, marks = parse_route_description(text), read_by_marks(text)
        _add_names(names, marked.id, text, told, parsed, marks)
        _add_turns(turns, marked.id, told, parsed, marks)
    chances = _print_fit("names", names)
    right, of_text = np.array(names.right), np.array(names.texts)
    best = [np.flatnonzero(of_text == each) for each in dict.fromkeys(names.texts)]
    first = sum(right[each[np.argmax(chances[each])]] for each in best)
    print(
        f"the likeliest is right in {first} of {len(best)} texts of which a name is read;"
    )
    print("the network's first, or else the grammar's, in", end=" ")
    print(sum(right[each[0]] for each in best))
    _print_fit("turns", turns)


def _add_names(
    names: Told,
    id: str,
    text: str,
    told: RoutePlan,
    parsed: RoutePlan,
    marks: RoutePlan,
) -> None:
    meant = names_of(told.arrival)
    for name in names_read(parsed, marks):
        tells = what_tells_of_name(name, text, parsed, marks)
        names.add(id, tells, bool(names_of(Arrival((name,))) & meant), 1.0)


def _add_turns(
    turns: Told, id: str, told: RoutePlan, parsed: RoutePlan, marks: RoutePlan
) -> None:
    """Add the turns of the better plan; where both are as good, of each by half."""
    plans, right = (parsed, marks), list[set[int]]()
    for plan in plans:
        right.append({two for _, two in aligned_turns(told, plan)})
    off = [
        len(plan.legs) - 2 * len(found)
        for plan, found in zip(plans, right, strict=True)
    ]
    tells = what_tells_of_turns(parsed, marks)
    for one, other in ((0, 1), (1, 0)):
        count = 0.5 * ((off[one] < off[other]) + (off[one] <= off[other]))
        for number, each in enumerate(tells[one]):
            turns.add(id, each, number in right[one], count)


def _print_fit(what: str, told: Told) -> Values:
    """Print the weights and how often what is said to be likely is right."""
    weights, chances = told.fit()
    right, counts = np.array(told.right), np.array(told.counts)
    loss = np.average(-np.log(np.where(right, chances, 1 - chances)), weights=counts)
    print(what, np.round(weights, 2).tolist())
    print(f"{np.sum(counts):.0f} {what}, log loss {loss:.3f}")
    print(_table(what, chances, right, counts).text())
    return chances


def _fit(rows: Values, right: NDArray[np.bool_], counts: Values) -> Values:
    """Return the weights of a logistic regression, by Newton's method."""
    weights = np.zeros(rows.shape[1])
    drawn = np.diag([0.0, *[RIDGE] * (rows.shape[1] - 1)])
    for _ in range(STEPS):
        chance = _chance(rows, weights)
        slope = rows.T @ (counts * (chance - right)) + drawn @ weights
        curve = (rows * (counts * chance * (1 - chance))[:, None]).T @ rows + drawn
        weights -= np.linalg.solve(curve, slope)
    return weights


def _chance(rows: Values, weights: Values) -> Values:
    return 1 / (1 + np.exp(-rows @ weights))


def _table(
    what: str, chances: Values, right: NDArray[np.bool_], counts: Values
) -> Table:
    rows: list[dict[str, object]] = []
    for low, high in pairwise(SHARES):
        inside = (chances >= low) & (chances < high) & (counts > 0)
        if inside.any():
            share = f"{low:g} to {high:g}"
            often = float(np.average(right[inside], weights=counts[inside]))
            rows.append({"said": share, "all": counts[inside].sum(), "right": often})
    columns = [
        Column("said", "said to be likely", "label"),
        Column("all", what, digits=0),
        Column("right", "right", digits=2),
    ]
    return Table(f"How often {what} are right", tuple(columns), tuple(rows))


if __name__ == "__main__":
    main()
