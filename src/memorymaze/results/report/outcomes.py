"""How episodes ended, in words and in marks that need no colour."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.evaluation.results import EpisodeResult

Key = Literal["arrived", "elsewhere", "broken"]

ENDINGS = {
    "agent": "stopped by itself",
    "budget": "budget spent",
    "stuck": "stuck",
    "crash": "crashed",
    "unsafe": "program refused as unsafe",
    "model_error": "no usable reply of a model",
}
"""By `EpisodeResult.stopped_by`."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """A kind of ending; pictures draw it in a colour, a dash and an end mark."""

    key: Key
    title: str
    drawn: str
    """How it is drawn, in words."""


OUTCOMES: dict[Key, Outcome] = {
    "arrived": Outcome("arrived", "arrived", "solid line, ends in a disc"),
    "elsewhere": Outcome(
        "elsewhere", "stopped elsewhere", "dashed line, ends in a cross"
    ),
    "broken": Outcome(
        "broken", "did not stop by itself", "dotted line, ends in a square"
    ),
}


def outcome_of(result: EpisodeResult) -> Outcome:
    """Return how an episode ended."""
    if result.success:
        return OUTCOMES["arrived"]
    return OUTCOMES["elsewhere" if result.stopped_by == "agent" else "broken"]


def ending_words(result: EpisodeResult) -> str:
    """Say how an episode ended: `arrived`, `stopped elsewhere`, `budget spent`."""
    outcome = outcome_of(result)
    return ENDINGS[result.stopped_by] if outcome.key == "broken" else outcome.title
