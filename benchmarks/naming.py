"""How likely what two readers take for a destination's name is one, fitted and measured.

`python -m benchmarks.naming` fits the weights of `memorymaze.agents.destination_names` on the
invented texts that no reader learned from (`examples/marked_texts/not_learned.jsonl`), and
shows how well they tell on the writers left out of each fit (docs/lab/learned_reader.md).
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from benchmarks.marking.marked_texts import load_kept_back, plan_as_marked
from benchmarks.reading import names_of
from memorymaze.agents.destination_names import what_tells
from memorymaze.basics.tables import Column, Table
from memorymaze.language.plans import Arrival
from memorymaze.language.reading import parse_route_description
from memorymaze.language.reading.marking import read_by_marks
from memorymaze.language.reading.marking.word_pieces import words_in

RIDGE = 1.0
"""How strongly weights are drawn to nothing; the constant is not."""
STEPS = 50
SHARES = 0.0, 0.2, 0.4, 0.6, 0.8, 1.0

Values = NDArray[np.float64]


def main() -> None:
    """Fit, and print the weights and what they are worth."""
    told: list[tuple[float, ...]] = []
    right: list[bool] = []
    writers: list[str] = []
    texts: list[int] = []
    for number, (marked, text) in enumerate(load_kept_back()):
        meant = names_of(plan_as_marked(text, words_in(text), marked.words).arrival)
        parsed, marks = parse_route_description(text), read_by_marks(text)
        names = dict.fromkeys((
            *marks.arrival.destinations,
            *parsed.arrival.destinations,
        ))
        for name in names:
            told.append(tuple(map(float, what_tells(name, text, parsed, marks))))
            right.append(bool(names_of(Arrival((name,))) & meant))
            writers.append(marked.id.split("-")[1])
            texts.append(number)
    rows, is_right, by = np.array(told), np.array(right), np.array(writers)
    chances = np.zeros(len(rows))
    for writer in sorted(set(writers)):
        out = by == writer
        chances[out] = _chance(rows[out], _fit(rows[~out], is_right[~out]))
    of_text = np.array(texts)
    best = [np.flatnonzero(of_text == n) for n in sorted(set(texts))]
    first = sum(is_right[each[np.argmax(chances[each])]] for each in best)
    print("weights", np.round(_fit(rows, is_right), 2).tolist())
    loss = -np.mean(np.log(np.where(is_right, chances, 1 - chances)))
    print(f"names {len(rows)}, log loss {loss:.3f}; the likeliest is right in {first}")
    print(f"of {len(best)} texts of which a name is read; the network's first, or else")
    print(f"the grammar's, in {sum(is_right[each[0]] for each in best)}")
    print(_table(chances, is_right).text())


def _fit(rows: Values, right: NDArray[np.bool_]) -> Values:
    """Return the weights of a logistic regression, by Newton's method."""
    weights = np.zeros(rows.shape[1])
    drawn = np.diag([0.0, *[RIDGE] * (rows.shape[1] - 1)])
    for _ in range(STEPS):
        chance = _chance(rows, weights)
        slope = rows.T @ (chance - right) + drawn @ weights
        curve = (rows * (chance * (1 - chance))[:, None]).T @ rows + drawn
        weights -= np.linalg.solve(curve, slope)
    return weights


def _chance(rows: Values, weights: Values) -> Values:
    return 1 / (1 + np.exp(-rows @ weights))


def _table(chances: Values, right: NDArray[np.bool_]) -> Table:
    rows: list[dict[str, object]] = []
    for low, high in pairwise(SHARES):
        inside = (chances >= low) & (chances < high)
        if inside.any():
            share = f"{low:.1f} to {high:.1f}"
            told = {"names": int(inside.sum()), "right": float(right[inside].mean())}
            rows.append({"said": share, **told})
    columns = [
        Column("said", "said to be likely", "label"),
        Column("names", "names"),
        Column("right", "right", digits=2),
    ]
    return Table("How often names are right", tuple(columns), tuple(rows))


if __name__ == "__main__":
    main()
