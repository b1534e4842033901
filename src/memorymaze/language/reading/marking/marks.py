"""Marks: pieces of a text that say one thing, with the leg that they speak of."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from memorymaze.language.reading.marking.network import Judged
from memorymaze.language.reading.marking.word_pieces import Word

WEIGHT = 0.4
"""Of what labels follow each other, beside what the network says of each word."""
SAYS_NOTHING = frozenset({"again", "aside", "undone"})
STEPS = (0, 1, -1)
"""Legs on from mark to mark: the same, the next, another, which is mostly the one before."""
OF_NO_LEG = SAYS_NOTHING | {"total", "doubt", "dest", "start:from", "start:facing"}


@dataclass(frozen=True, slots=True)
class Mark:
    """Words that say one thing."""

    start: int
    """Characters of the text."""
    end: int
    label: str
    """As in the data that the network learned from."""
    leg: int
    """From 0; of the destination the number of turns."""
    probability: float
    """Of the label at its first word; of a turn, that it is one, to whatever side."""

    @property
    def is_turn(self) -> bool:
        """Whether a leg ends with it."""
        return ends_leg(self.label)


def ends_leg(label: str) -> bool:
    """Tell whether a label is that of a turn, or of a bend that is followed."""
    return label.startswith(("turn:", "bend:"))


class Marker:
    """Finds the likeliest sequence of marks (Viterbi)."""

    def __init__(self, labels: Sequence[str], follows: NDArray[np.float64]) -> None:
        """Take the labels, and how likely one follows another: nothing, then two a label.

        The first of the two is for its first word, the second for those after it.
        """
        self._labels, self._follows = labels, WEIGHT * follows
        kinds = ["turn" if ends_leg(each) else each for each in labels]
        self._alike = [
            [
                state
                for n, other in enumerate(kinds)
                if other == kind
                for state in (2 * n + 1, 2 * n + 2)
            ]
            for kind in kinds
        ]
        """States that say the same as each label."""

    def marks(self, words: Sequence[Word], judged: Judged) -> list[Mark]:
        """Return the marks of a text in order."""
        found: list[tuple[int, int, str, float]] = []
        before = 0
        for at, state in enumerate(self._likeliest(judged.labels)):
            kind = (state - 1) // 2
            if state and (state % 2 or state not in {before, before + 1}):
                chance = float(np.exp(judged.labels[at, self._alike[kind]]).sum())
                found.append((at, at, self._labels[kind], chance))
            elif state:
                found[-1] = (found[-1][0], at, *found[-1][2:])
            before = state
        return self._on_legs(words, judged, found)

    def _likeliest(self, judged: NDArray[np.float64]) -> list[int]:
        score = judged[0] + self._follows[0]
        came: list[NDArray[np.intp]] = []
        for each in judged[1:]:
            ways = score[:, None] + self._follows
            came.append(ways.argmax(axis=0))
            score = ways.max(axis=0) + each
        states = [int(score.argmax())]
        for back in reversed(came):
            states.append(int(back[states[-1]]))
        return states[::-1]

    def _on_legs(
        self,
        words: Sequence[Word],
        judged: Judged,
        found: Sequence[tuple[int, int, str, float]],
    ) -> list[Mark]:
        marks: list[Mark] = []
        leg, turned = 0, set[int]()
        for first, last, label, chance in found:
            mark = Mark(words[first].start, words[last].end, label, leg, chance)
            if label not in OF_NO_LEG:
                leg = max(leg + STEPS[int(judged.steps[first].argmax())], 0)
                while mark.is_turn and leg in turned:
                    leg += 1
                if mark.is_turn:
                    turned.add(leg)
                mark = replace(mark, leg=leg)
            marks.append(mark)
        return marks
