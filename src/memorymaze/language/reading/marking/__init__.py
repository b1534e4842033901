"""Reading by marks: a small network says what each word is, an assembly makes the plan.

Holds the network's weights (`data`), how it runs and what plan its marks make. Does not
hold how it is trained (`benchmarks.marking`) or the grammar that reads beside it.
"""

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from memorymaze.language.nouns import singular
from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading.marking.marks import Marker
from memorymaze.language.reading.marking.network import Judged, Network
from memorymaze.language.reading.marking.plans import plan_of_marks
from memorymaze.language.reading.marking.word_pieces import Word, words_in
from memorymaze.language.reading.spelling import spelt

__all__ = ["destination_chance", "likeness", "read_by_marks"]

WEIGHTS = Path(__file__).with_name("data") / "marker.npz"


def read_by_marks(text: str) -> RoutePlan:
    """Return the plan that an English route description gives, as the network marks it."""
    meant, words, judged = _judged(text)
    if not words:
        return RoutePlan()
    _, marker = _trained()
    return plan_of_marks(meant, marker.marks(words, judged))


def destination_chance(text: str, word: str) -> float | None:
    """Return how likely a word in lower case names the destination, to the network.

    Where a text says it several times, the most; None where it does not say it.
    """
    _, words, judged = _judged(text)
    plain = [each.text.casefold() for each in words[: len(judged.labels)]]
    said = [n for n, each in enumerate(plain) if word in {each, singular(each)}]
    if not said:
        return None
    network, _ = _trained()
    begun = 1 + 2 * network.kinds.index("dest")
    chances = np.exp(judged.labels[said, begun : begun + 2]).sum(axis=1)
    return float(chances.max())


def likeness(one: str, other: str) -> float:
    """Return how alike in meaning two names are: the cosine of the means of their words.

    Words are those of MiniLM (Wang et al. 2020), which training leaves as they are.

    >>> likeness("movies", "Cinema") > 0.5 > 0.3 > likeness("movies", "Chapel")
    True
    """
    first, second = _meaning(one), _meaning(other)
    long = float(np.linalg.norm(first) * np.linalg.norm(second))
    return float(first @ second) / long if long else 0.0


@lru_cache(maxsize=4096)
def _meaning(name: str) -> NDArray[np.float32]:
    network, _ = _trained()
    words = network.weights["words"]
    pieces = [
        piece for word in words_in(name) for piece in network.pieces.of(word.text)
    ]
    return (words[pieces] - _mean_word()).sum(axis=0)


@lru_cache(maxsize=1)
def _mean_word() -> NDArray[np.float32]:
    network, _ = _trained()
    return network.weights["words"].mean(axis=0)


@lru_cache(maxsize=4)
def _judged(text: str) -> tuple[str, list[Word], Judged]:
    """Return a text as it was meant, its words, and what the network makes of them."""
    meant = spelt(text)
    words = words_in(meant)
    network, _ = _trained()
    return meant, words, network.judge(words)


@lru_cache(maxsize=1)
def _trained() -> tuple[Network, Marker]:
    network = Network(WEIGHTS)
    return network, Marker(network.kinds, network.follows)
