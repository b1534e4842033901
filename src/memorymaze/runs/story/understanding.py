"""What an agent understood: its steps or program, and which of it is at work when."""

import ast
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from memorymaze.agents.notes import ArrivalNote, PlanNote, ProgramNote, StepsNote
from memorymaze.basics.wording import printable
from memorymaze.runs.episodes.trace_entries import CallEntry, NoteEntry, TraceEntry
from memorymaze.runs.story.events import Event

LONGEST_PROGRAM = 20_000
"""Characters that are shown of a program."""
LONGEST_STEP = 1_000
"""Characters that are shown of a step."""
LINES_ROUND = 1
"""Lines of a program shown before and after the one at work."""


@dataclass(frozen=True, slots=True)
class Understanding:
    """What can be shown of how an agent read the instruction."""

    steps: tuple[str, ...]
    """In the order in which they are to be done; none where the agent notes none."""
    programs: tuple[tuple[str, ...], ...]
    """The lines of each program that was run; the last one replaced those before."""
    marks: dict[int, tuple[int, ...]]
    """What is worked on from an entry of the trace on, by the entry's number: numbers
    of a step, from 0; where there are programs, of all their lines, counted through, that
    make the call at hand."""


class CurrentStep(NamedTuple):
    """What an agent worked on."""

    heading: str
    """Such as `Step 2 of 6`; empty where the agent says nothing of it."""
    lines: tuple[str, ...]
    current: int | None = None
    """Which of the lines is at work; None for all of them."""


def understood(entries: Sequence[TraceEntry]) -> Understanding:
    """Read what an agent noted of its understanding from a trace.

    Steps stand in notes about `plan` or `steps`, programs in notes about `program`; a
    step counts as worked on when a note of any kind says how many are done (`legs_done`).
    """
    steps: tuple[str, ...] = ()
    programs: list[tuple[str, ...]] = []
    at_steps: dict[int, tuple[int, ...]] = {}
    at_lines: dict[int, tuple[int, ...]] = {}
    calls: dict[str, list[_CallInProgram]] = {}
    for number, entry in enumerate(entries):
        if isinstance(entry, CallEntry) and programs:
            told = list(entry.arguments.values())
            fitting = [each for each in calls.get(entry.call, ()) if each.fits(told)]
            at_lines[number] = tuple(sorted({each.line for each in fitting}))
        if not isinstance(entry, NoteEntry):
            continue
        match entry.note:
            case PlanNote(steps=told) | StepsNote(steps=told):
                steps = tuple(
                    printable(step)[:LONGEST_STEP].removeprefix(f"{place}. ")
                    for place, step in enumerate(told, start=1)
                )
            case ProgramNote(program=program):
                shown = printable(program)[:LONGEST_PROGRAM]
                calls = _calls_in(shown, sum(map(len, programs)))
                programs.append(tuple(shown.rstrip().splitlines()))
            case ArrivalNote() if steps:
                at_steps[number] = (len(steps) - 1,)
            case _:
                done = entry.details.get("legs_done")
                if steps and isinstance(done, int):
                    at_steps[number] = (min(max(done, 0), len(steps) - 1),)
    if steps and at_steps:
        at_steps.setdefault(0, (0,))
    marks = at_lines if programs else at_steps
    return Understanding(steps, tuple(programs), marks)


def step_of(
    understanding: Understanding, last: int, events: Sequence[Event]
) -> CurrentStep:
    """Return what an agent works on after an entry of its trace.

    The step of a plan, or the line of a program, or else the agent's latest thought:
    `last` is the number of the last entry that has happened, -1 for none, and `events`
    what has happened, the last one last.
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


@dataclass(frozen=True, slots=True)
class _CallInProgram:
    line: int
    """From 0, counted through all programs."""
    told: tuple[object, ...] | None
    """Its arguments, where they stand there as plain values."""

    def fits(self, told: Sequence[object]) -> bool:
        return self.told is None or list(self.told) == list(told)


def _calls_in(program: str, first_line: int) -> dict[str, list[_CallInProgram]]:
    """Return the calls of functions in a program by name; none where it is broken."""
    try:
        tree = ast.parse(program)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return {}
    calls: dict[str, list[_CallInProgram]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            values = [*node.args, *(keyword.value for keyword in node.keywords)]
            plain = [each.value for each in values if isinstance(each, ast.Constant)]
            told = tuple(plain) if len(plain) == len(values) else None
            line = first_line + node.lineno - 1
            calls.setdefault(node.func.id, []).append(_CallInProgram(line, told))
    return calls
