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
GAVE_UP = "gave up"
"""Of an agent that stopped by itself and says that it is not there."""
REASONS = {
    "agent": "the agent said “we are there”",
    "budget": "the time or call budget ran out",
    "stuck": "stuck: too many calls in a row changed nothing",
    "crash": "the agent failed",
    "unsafe": "the program was refused as unsafe",
    "model_error": "the language model or detector failed",
}
"""The same where there is room for a sentence."""
SOURCES = {
    "human": "said by a person",
    "llm": "written by a language model",
    "synthetic": "made by a program",
}


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
    if outcome.key == "broken":
        return ENDINGS[result.stopped_by]
    if not result.gave_up:
        return outcome.title
    return f"{GAVE_UP} at the goal" if result.success else GAVE_UP


def outcome_line(result: EpisodeResult) -> str:
    """Say in a line how it ended: `✔ ARRIVED …` or `✘ DID NOT ARRIVE …`."""
    reason = REASONS[result.stopped_by]
    if result.gave_up:
        reason = "the agent gave up and said so"
    verdict = "✔ ARRIVED" if result.success else "✘ DID NOT ARRIVE"
    parts = [
        f"{verdict}: {reason}, {result.spd:.1f} m from the goal",
        f"{result.path_length:.1f} m in {result.duration_s:.0f} s",
        f"CLS {result.cls:.2f}",
        f"SPL {result.spl:.2f}",
    ]
    if not result.success and result.oracle_success:
        parts.append("was near the goal on its way")
    if result.collisions:
        parts.append(f"collisions: {result.collisions}")
    return " · ".join(parts)


def source_line(result: EpisodeResult) -> str:
    """Say who wrote the instruction."""
    return f"Instruction {result.instruction_id}, {SOURCES[result.source]}"
