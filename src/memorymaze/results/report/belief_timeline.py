"""How an agent's belief over its plan went along its walk, as a picture and in words."""

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, Field, TypeAdapter, ValidationError

from memorymaze.geometry.trajectory import Trajectory
from memorymaze.results.story.story import Story

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

Probability = Annotated[float, Field(ge=0, le=1)]


class BeliefNote(BaseModel):
    """What an agent believed at a place."""

    about: Literal["belief"]
    time: float
    at: int
    """The crossing, as the agent counts them."""
    legs: Annotated[list[Probability], Field(min_length=1)]
    """Of each number of legs done, from none to all."""
    doubt: Probability
    """That something told is wrong."""


class ChangeNote(BaseModel):
    """That an agent doubts what was told, or goes back for another explanation."""

    about: Literal["doubt", "repair"]
    time: float
    score: Probability = 1.0
    leg: int | None = None
    """From 1; one more than there are for the arrival."""
    reason: Annotated[str, Field(max_length=200)] = ""

    @property
    def words(self) -> str:
        """Say what it is about."""
        leg = "" if self.leg is None else f" leg {self.leg}"
        if self.about == "doubt":
            return f"doubts{leg} ({self.score:.2f})"
        return f"repairs{leg}{': ' if self.reason else ''}{self.reason}"


class EndNote(BaseModel):
    """What an agent said at the end."""

    about: Literal["arrival", "gave_up"]
    time: float
    confidence: Probability | None = None


_NOTE: TypeAdapter[BeliefNote | ChangeNote | EndNote] = TypeAdapter(
    Annotated[BeliefNote | ChangeNote | EndNote, Field(discriminator="about")]
)


_ABOUT = frozenset({"belief", "doubt", "repair", "arrival", "gave_up"})


class BelievedPlace(NamedTuple):
    """What was believed from a place on, until the next."""

    metres: float
    """Walked up to there."""
    until: float
    note: BeliefNote
    changes: tuple[ChangeNote, ...]
    """Of mind, before the next place."""

    @property
    def likeliest(self) -> int:
        """The number of legs most likely done."""
        return int(np.argmax(self.note.legs))


@dataclass(frozen=True, slots=True)
class BeliefTimeline:
    """The belief over a plan along a walk; at least one place."""

    places: tuple[BelievedPlace, ...]
    marks: tuple[tuple[float, ChangeNote], ...]
    """Changes of mind, with the metres walked."""
    legs: int
    """Of the plan."""
    length: float
    """Metres of the walk."""
    end: EndNote | None
    unread: int
    """Notes of these kinds that are not as docs/report.md says."""

    @property
    def end_words(self) -> str:
        """Say how the walk ended."""
        said = "ended without a word"
        if self.end is not None:
            said = "said that it arrived" if self.end.about == "arrival" else "gave up"
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
        return self._steps([self.row(each.likeliest) + ROW / 2 for each in self.places])

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
    changes: list[ChangeNote] = []
    end, unread = None, 0
    for entry in story.entries:
        if entry["kind"] != "note" or entry.get("about") not in _ABOUT:
            continue
        try:
            note = _NOTE.validate_python(entry, strict=True)
        except ValidationError:
            unread += 1
            continue
        if isinstance(note, EndNote):
            end = note
        elif isinstance(note, ChangeNote):
            changes += [note] if note.score >= SAID else []
        elif beliefs and len(note.legs) != len(beliefs[0].legs):
            unread += 1
        else:
            beliefs.append(note)
    if not beliefs:
        return None
    away = _metres_walked(story.walk)
    walked = away(beliefs)
    # Of several notes at a place the last one counts.
    last = [*np.flatnonzero(np.diff(walked) >= STEP).tolist(), len(beliefs) - 1]
    begins = [0.0, *walked[last[1:]].tolist()]
    marks = tuple(zip(away(changes).tolist(), changes, strict=True))
    changed: list[list[ChangeNote]] = [[] for _ in last]
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
) -> Callable[[Sequence[BeliefNote | ChangeNote]], NDArray[np.float64]]:
    """Return what tells the metres walked when notes were made."""
    times = [pose.time for pose in walk.poses]
    metres = np.append(0.0, np.cumsum(np.hypot(*np.diff(walk.points, axis=0).T)))
    return lambda notes: np.interp([each.time for each in notes], times, metres)


def _shade(probability: float) -> int:
    return max(1, math.ceil(probability * SHADES))
