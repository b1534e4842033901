"""How an agent's belief over its plan went along its walk, as a picture and in words."""

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from memorymaze.agents.notes import (
    ArrivalNote,
    BeliefNote,
    DoubtNote,
    GaveUpNote,
    RepairNote,
)
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.runs.episodes.trace_entries import NoteEntry
from memorymaze.runs.story.story import Story

SAID = 0.5
"""Doubt from which on it counts as said."""
STEP = 0.05
"""Metres by which a place differs from the one before."""
SHADES = 5
LEAST = 0.02
"""Probability below which nothing is drawn."""

LEFT, WIDTH, ROW, ENDING = 80.0, 600.0, 15.0, 14.0
"""Of the picture: where rows begin, the whole width, height of a row, width of the end."""
GAP = 3.0
"""Before the end."""
TOP, STRIP = 36.0, 30.0
"""Room for marks above the rows, and for the doubt below them."""

_READ = BeliefNote | DoubtNote | RepairNote | ArrivalNote | GaveUpNote
_ABOUT = frozenset(each.about for each in get_args(_READ))


class MindChange(NamedTuple):
    """That an agent doubted what was told, or went back for another explanation."""

    time: float
    """Simulated seconds."""
    note: DoubtNote | RepairNote

    @property
    def words(self) -> str:
        """Say what it is about."""
        leg = "" if self.note.leg is None else f" leg {self.note.leg}"
        if isinstance(self.note, DoubtNote):
            return f"doubts{leg} ({self.note.score:.2f})"
        return f"repairs{leg}{': ' if self.note.reason else ''}{self.note.reason}"


class BelievedPlace(NamedTuple):
    """What was believed from a place on, until the next."""

    metres: float
    """Walked up to there."""
    until: float
    note: BeliefNote
    changes: tuple[MindChange, ...]
    """Before the next place."""


@dataclass(frozen=True, slots=True)
class BeliefTimeline:
    """The belief over a plan along a walk; at least one place."""

    places: tuple[BelievedPlace, ...]
    marks: tuple[tuple[float, MindChange], ...]
    """Changes of mind, with the metres walked."""
    legs: int
    """Of the plan."""
    length: float
    """Metres of the walk."""
    end: ArrivalNote | GaveUpNote | None
    unread: int
    """Notes of these kinds that are not as docs/runs.md says."""

    @property
    def end_words(self) -> str:
        """Say how the walk ended."""
        said = "ended without a word"
        if self.end is not None:
            arrived = isinstance(self.end, ArrivalNote)
            said = "said that it arrived" if arrived else "gave up"
            if self.end.confidence is not None:
                said += f", confidence {self.end.confidence:.2f}"
        return f"After {self.length:.0f} m it {said}."

    # -- the picture

    @property
    def bottom(self) -> float:
        """Lower edge of the rows."""
        return TOP + (self.legs + 2) * ROW

    @property
    def doubt_bottom(self) -> float:
        """Where a doubt of 0 lies."""
        return self.bottom + ROW / 2 + STRIP

    def row(self, row: int) -> float:
        """Return the upper edge of a row: legs done, and above them `there`."""
        return self.bottom - (row + 1) * ROW

    def x(self, metres: float) -> float:
        """Return where metres walked lie."""
        return LEFT + (WIDTH - LEFT - ENDING - GAP) * metres / max(self.length, STEP)

    @property
    def cells(self) -> Iterator[tuple[float, float, float, int]]:
        """Yield x, y, width and shade of what is likely enough."""
        for place in self.places:
            begin, end = self.x(place.metres), self.x(place.until)
            for row, probability in enumerate(place.note.legs):
                if probability >= LEAST:
                    yield begin, self.row(row), end - begin, _shade(probability)
        confidence = None if self.end is None else self.end.confidence
        if confidence is not None and confidence >= LEAST:
            yield WIDTH - ENDING, self.row(self.legs + 1), ENDING, _shade(confidence)

    @property
    def likeliest_line(self) -> str:
        """Return the path through the number of legs most likely done."""
        return self._steps([
            self.row(each.note.likeliest) + ROW / 2 for each in self.places
        ])

    @property
    def doubt_line(self) -> str:
        """Return the path of the doubt."""
        heights = [self.doubt_bottom - STRIP * each.note.doubt for each in self.places]
        return self._steps(heights)

    def _steps(self, heights: Sequence[float]) -> str:
        first = f"M{LEFT:g} {heights[0]:g}"
        steps = zip(self.places, heights, strict=True)
        return first + "".join(
            f"V{y:.1f}H{self.x(each.until):.1f}" for each, y in steps
        )


def belief_timeline(story: Story) -> BeliefTimeline | None:
    """Return how the belief went; None where the agent notes none."""
    beliefs: list[BeliefNote] = []
    times: list[float] = []
    changes: list[MindChange] = []
    end, unread = None, 0
    for entry in story.entries:
        if not isinstance(entry, NoteEntry) or entry.about not in _ABOUT:
            continue
        match entry.note:
            case ArrivalNote() | GaveUpNote() as end:
                pass
            case DoubtNote(score=score) if score < SAID:
                pass
            case DoubtNote() | RepairNote() as note:
                changes.append(MindChange(entry.time, note))
            case BeliefNote() as note if not beliefs or len(note.legs) == len(
                beliefs[0].legs
            ):
                beliefs.append(note)
                times.append(entry.time)
            case _:
                unread += 1
    if not beliefs:
        return None
    away = _metres_walked(story.walk)
    walked = away(times)
    # Of several notes at a place the last one counts.
    last = [*np.flatnonzero(np.diff(walked) >= STEP).tolist(), len(beliefs) - 1]
    begins = [0.0, *walked[last[1:]].tolist()]
    marks = tuple(
        zip(away([each.time for each in changes]).tolist(), changes, strict=True)
    )
    changed: list[list[MindChange]] = [[] for _ in last]
    for metres, change in marks:
        changed[bisect_right(begins, metres + STEP) - 1].append(change)
    spans = pairwise([*begins, story.walk.length])
    places = tuple(
        BelievedPlace(*span, beliefs[note], tuple(own))
        for note, span, own in zip(last, spans, changed, strict=True)
    )
    legs = len(beliefs[0].legs) - 1
    return BeliefTimeline(places, marks, legs, story.walk.length, end, unread)


def _metres_walked(
    walk: Trajectory,
) -> Callable[[Sequence[float]], NDArray[np.float64]]:
    """Return what tells the metres walked at some times."""
    times = [pose.time for pose in walk.poses]
    metres = np.append(0.0, np.cumsum(np.hypot(*np.diff(walk.points, axis=0).T)))
    return lambda moments: np.interp(moments, times, metres)


def _shade(probability: float) -> int:
    return max(1, math.ceil(probability * SHADES))
