"""Reading by marks: a small network says what each word is, an assembly makes the plan.

Holds the network's weights (`data`), how it runs and what plan its marks make. Does not
hold how it is trained (`benchmarks.marking`) or the grammar that reads beside it.
"""

from functools import lru_cache
from pathlib import Path

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading.marking.marks import Marker
from memorymaze.language.reading.marking.network import Network
from memorymaze.language.reading.marking.plans import plan_of_marks
from memorymaze.language.reading.marking.word_pieces import words_in

__all__ = ["read_by_marks"]

WEIGHTS = Path(__file__).with_name("data") / "marker.npz"


def read_by_marks(text: str) -> RoutePlan:
    """Return the plan that an English route description gives, as the network marks it."""
    words = words_in(text)
    if not words:
        return RoutePlan()
    network, marker = _trained()
    return plan_of_marks(text, marker.marks(words, network.judge(words)))


@lru_cache(maxsize=1)
def _trained() -> tuple[Network, Marker]:
    network = Network(WEIGHTS)
    return network, Marker(network.kinds, network.follows)
