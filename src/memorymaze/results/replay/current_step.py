"""What an agent is at, in one heading and a few lines, while its walk is shown."""

from collections.abc import Sequence
from typing import NamedTuple

from memorymaze.results.report.event_words import Event
from memorymaze.results.report.understanding import Understanding

LINES_ROUND = 1
"""Lines of a program shown before and after the one at work."""


class CurrentStep(NamedTuple):
    """What an agent worked on."""

    heading: str
    """Such as `Step 2 of 6`; empty where the agent says nothing of it."""
    lines: tuple[str, ...]
    current: int | None = None
    """Which of the lines is at work; None for all of them."""


def step_of(
    understanding: Understanding, last: int, events: Sequence[Event]
) -> CurrentStep:
    """Return what an agent works on after an entry of its trace.

    The step of a plan, or the line of a program, or else the agent's latest thought.

    Args:
        understanding: What the agent noted of it.
        last: Number of the last entry that has happened; -1 for none.
        events: What has happened, the last one last.
    """
    marks = understanding.marks
    passed = [number for number in marks if number <= last]
    marked = marks[max(passed)] if passed else ()
    if understanding.programs:
        lines = [line for program in understanding.programs for line in program]
        if not marked or not lines:
            return CurrentStep(f"Program of {len(lines)} lines", tuple(lines[:3]))
        at = min(marked[0], len(lines) - 1)
        first = max(0, at - LINES_ROUND)
        shown = tuple(lines[first : at + LINES_ROUND + 1])
        sure = "" if len(marked) == 1 else " (or another that makes this call)"
        return CurrentStep(f"Program, line {at + 1}{sure}", shown, at - first)
    if understanding.steps:
        count = len(understanding.steps)
        if not marked:
            return CurrentStep(f"Plan of {count} steps", understanding.steps[:3])
        at = min(marked[0], count - 1)
        return CurrentStep(f"Step {at + 1} of {count}", (understanding.steps[at],), 0)
    for event in reversed(events):
        if event.kind in {"note", "model"}:
            return CurrentStep("Thought", (event.text,))
    return CurrentStep("", ())
