"""What an episode's page shows: the instruction, and every run's walk to be replayed."""

import json
import math
import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

import numpy as np
from shapely import LineString, get_coordinates

from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory
from memorymaze.basics.wording import counted
from memorymaze.runs.episodes.in_words import Outcome, ending_words, outcome_of
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.report.belief_timeline import BeliefTimeline
from memorymaze.runs.report.pages import safe_name
from memorymaze.runs.report.sources import ReportRun
from memorymaze.runs.story.events import KINDS
from memorymaze.runs.story.following import Following, followed_along
from memorymaze.runs.story.story import Story
from memorymaze.texts.corpus.records import WRITTEN_BY, Instruction
from memorymaze.world.drawing.svg import path_data, simplified
from memorymaze.world.sites import Route

OFF_LINE = 0.06
"""Metres by which a pose may be off the straight way between those that are kept."""
OFF_HEADING = 0.15
"""Radians by which a heading may be off the even turn between those that are kept."""
PIECES = re.compile(r"(?<=; )|(?= \(looked for )")
"""Where the texts of events are taken apart."""
NEARBY = 10.0
"""Metres from the robot within which people are shown."""


@dataclass(frozen=True, slots=True)
class WalkOfRun:
    """A walk as pages draw it, and where it left the way described."""

    result: EpisodeResult
    line: np.ndarray
    """Places, simplified, metres, shape (N, 2)."""
    following: Following

    @property
    def outcome(self) -> Outcome:
        """Return how it ended."""
        return outcome_of(self.result)

    @property
    def data(self) -> str:
        """Return the `d` of an SVG path."""
        return path_data(self.line.tolist())

    @property
    def end(self) -> tuple[float, float]:
        """Return where it ends, in the coordinates of the SVG."""
        return float(self.line[-1][0]), -float(self.line[-1][1])


@dataclass(frozen=True, slots=True)
class RunInEpisode:
    """An episode of one run."""

    run: ReportRun
    number: int
    """Of the run in the report, from 0."""
    result: EpisodeResult
    story: Story | None
    """None where the trace cannot be read."""
    problem: str | None
    """Why it cannot."""
    walk: WalkOfRun | None
    """None with the story."""
    belief: BeliefTimeline | None
    """None where the agent notes none."""

    @property
    def numbers(self) -> str:
        """Say in words and numbers what the picture of the walk shows."""
        result = self.result
        return (
            f"Walk of {self.run.title}: {result.path_length:.1f} m in "
            f"{result.duration_s:.0f} s, {ending_words(result)}, "
            f"{result.spd:.1f} m walk from the goal; {result.turns_in_order:.0%} of the "
            f"turns in order, {counted(result.collisions, 'collision')}."
        )

    @property
    def data_file(self) -> str:
        """Return the script that holds the story, from the site's root."""
        return f"data/{self.number}/{safe_name(self.result.episode_id)}.js"


@dataclass(frozen=True, slots=True)
class EpisodeView:
    """An episode, in all runs that have it."""

    episode_id: str
    first: EpisodeResult
    """Of any run; what belongs to the instruction is the same in all."""
    instruction: Instruction
    runs: tuple[RunInEpisode, ...]

    @property
    def written_by(self) -> str:
        """Say who wrote the instruction."""
        return WRITTEN_BY[self.first.source]

    @property
    def longest(self) -> float:
        """Return the duration of the longest walk, simulated seconds."""
        return max(each.result.duration_s for each in self.runs)


@dataclass(frozen=True, slots=True)
class EpisodeRow:
    """An episode in a list."""

    episode_id: str
    first: EpisodeResult
    failures: tuple[str, ...]
    """Kinds of errors in the instruction."""
    results: tuple[EpisodeResult | None, ...]
    """One per run of the report."""


def walk_of(result: EpisodeResult, story: Story, way: Route, near: float) -> WalkOfRun:
    """Return the walk of a story, which follows a way within some metres."""
    points = story.walk.points
    following = followed_along(list(way.line.coords), points, near)
    return WalkOfRun(result, simplified(points), following)


def story_record(story: Story) -> str:
    """Return a story as JSON that is also a JavaScript expression, short and safe.

    `poses` is flat: time, x, y, heading, and so on; metres, seconds and radians.
    `words` has every piece of text once; `events` is flat: time, kind, index of the text
    or list of those of its pieces, and steps that are worked on then, as index of `sets`. `kinds` names the kinds; `program`
    says that steps are lines of a program, which belong to a call while it is made, and
    not to the time after the event. `seen`
    is flat: time, x, y, index of the label. `things` and `people` are flat too: x, y,
    heading, length, depth; and time, x, y.
    """
    words: dict[str, int] = {}
    sets: dict[tuple[int, ...], int] = {}
    events: list[float | list[int]] = []
    seen: list[float] = []
    marks = sorted(story.understanding.marks.items())
    current: tuple[int, ...] = ()
    passed = 0
    for event in story.events:
        while passed < len(marks) and marks[passed][0] <= event.last:
            current = marks[passed][1]
            passed += 1
        events += [
            _short(event.time),
            KINDS.index(event.kind),
            _pieces(event.text, words),
            sets.setdefault(current, len(sets)),
        ]
        for x, y, label in event.seen:
            seen += [_short(event.time), _short(x), _short(y)]
            seen.append(words.setdefault(label, len(words)))
    record = {
        "poses": [number for pose in _kept(story.walk) for number in map(_short, pose)],
        "program": bool(story.understanding.programs),
        "kinds": KINDS,
        "words": list(words),
        "sets": list(sets),
        "events": events,
        "seen": seen,
        "things": [
            _short(number) for thing in story.things.values() for number in thing[1:]
        ],
        "people": [_short(number) for each in _near(story) for number in each],
    }
    # ASCII only, and no character that could end a script or begin a tag.
    text = json.dumps(record, ensure_ascii=True, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def _near(story: Story) -> Iterator[tuple[float, float, float]]:
    """Return time and place of people who were near the robot."""
    poses = story.walk.poses
    times = [pose.time for pose in poses]
    for time, x, y in chain.from_iterable(w.T.tolist() for w in story.people.values()):
        robot = poses[max(0, bisect_right(times, time) - 1)]
        if math.dist((x, y), (robot.x, robot.y)) <= NEARBY:
            yield time, x, y


def _kept(walk: Trajectory) -> list[TimedPose]:
    """Return the poses between which the others lie evenly.

    Each coordinate over time is simplified by itself, so that speed is kept too.
    """
    table = np.array(walk.poses)
    times = table[:, 0]
    headings = np.unwrap(table[:, 3]) * (OFF_LINE / OFF_HEADING)
    kept = np.zeros(len(times), dtype=bool)
    kept[[0, -1]] = True
    if len(times) > 2:
        for values in (table[:, 1], table[:, 2], headings):
            curve = LineString(np.column_stack([times, values]))
            line = curve.simplify(OFF_LINE, preserve_topology=False)
            kept |= np.isin(times, get_coordinates(line)[:, 0])
    return [pose for pose, is_kept in zip(walk.poses, kept, strict=True) if is_kept]


def _pieces(text: str, words: dict[str, int]) -> int | list[int]:
    """Return the numbers of a text's pieces, most of which come again and again."""
    numbers = [words.setdefault(each, len(words)) for each in PIECES.split(text)]
    return numbers if len(numbers) > 1 else numbers[0]


def _short(value: float) -> float:
    number = round(value, 2)
    return int(number) if number == int(number) else number
