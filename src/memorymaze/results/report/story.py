"""An episode's trace, made short: poses, what was called and seen, what was understood.

What agents and models wrote is kept as text and never trusted.
"""

import json
import math
import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from shapely import LineString, get_coordinates

from memorymaze.errors import RunFolderError
from memorymaze.geometry.trajectory import TimedPose, Trajectory
from memorymaze.results.report.event_words import (
    KINDS,
    Event,
    asked_events,
    call_event,
    met_event,
    note_events,
)
from memorymaze.results.report.understanding import Understanding, understood

OFF_LINE = 0.06
"""Metres by which a pose may be off the straight way between those that are kept."""
OFF_HEADING = 0.15
"""Radians by which a heading may be off the even turn between those that are kept."""

PIECES = re.compile(r"(?<=; )|(?= \(looked for )")
"""Where the texts of events are taken apart."""
NEARBY = 10.0
"""Metres from the robot within which people are shown."""

ASKING = frozenset({
    "turning_point_id",
    "detect_turning_point",
    "distance_travelled",
    "detect_from_RGB_image",
    "read_signs",
})
"""Calls that move nothing; those at the same moment are told in one line."""


class Thing(NamedTuple):
    """Something left in the way; metres and radians."""

    x: float
    y: float
    heading: float
    length: float
    """Across its front."""
    depth: float


@dataclass(frozen=True, slots=True)
class Story:
    """What a reader sees of an episode of one run."""

    walk: Trajectory
    events: tuple[Event, ...]
    """In the order of time."""
    understanding: Understanding
    instruction: str | None
    """The text as the trace has it."""
    things: tuple[Thing, ...] = ()
    """Left in the way; only in runs with obstacles."""
    people: tuple[tuple[float, float, float], ...] = ()
    """Time, x and y of people near the robot, about once a second."""


def story_of(entries: Iterable[Mapping[str, Any]], place: str) -> Story:
    """Make the entries of a trace short.

    Raises:
        RunFolderError: The entries are none that an episode leaves.
    """
    listed = list(entries)
    try:
        poses = next(each["poses"] for each in listed if each["kind"] == "trajectory")
        walk = Trajectory([TimedPose(*map(float, pose)) for pose in poses])
        understanding = understood(listed)
        events = tuple(_events(listed))
        opening = listed[0].get("instruction")
        things = tuple(_things(listed))
        people = tuple(_people(listed, walk))
    except StopIteration:
        raise RunFolderError(f"{place}: expected a trajectory, got none") from None
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise RunFolderError(
            f"{place}: expected entries as memorymaze writes them, got others "
            f"({type(error).__name__}: {error})"
        ) from None
    text = opening if isinstance(opening, str) else None
    return Story(walk, events, understanding, text, things, people)


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
        "things": [number for thing in story.things for number in map(_short, thing)],
        "people": [number for each in story.people for number in map(_short, each)],
    }
    # ASCII only, and no character that could end a script or begin a tag.
    text = json.dumps(record, ensure_ascii=True, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def _events(entries: Sequence[Mapping[str, Any]]) -> Iterator[Event]:
    asked: list[Mapping[str, Any]] = []
    for number, entry in enumerate(entries):
        kind = entry["kind"]
        asks = kind == "call" and entry.get("call") in ASKING
        if asked and not (asks and entry["time"] == asked[0]["time"]):
            yield from asked_events(asked, number)
            asked = []
        if asks:
            asked.append(entry)
        elif kind == "call":
            yield call_event(entry, number)
        elif kind == "note":
            yield from note_events(entry, number)
        elif kind in {"collision", "near_miss"}:
            yield met_event(entry, number)
    if asked:
        yield from asked_events(asked, len(entries))


def _things(entries: Sequence[Mapping[str, Any]]) -> Iterator[Thing]:
    for entry in entries:
        if entry["kind"] == "things":
            for thing in entry["things"]:
                x, y, heading = map(float, thing["pose"])
                yield Thing(x, y, heading, *map(float, thing["size"][:2]))


def _people(
    entries: Sequence[Mapping[str, Any]], walk: Trajectory
) -> Iterator[tuple[float, float, float]]:
    """Return where people were that were near the robot."""
    times = [pose.time for pose in walk.poses]
    for entry in entries:
        if entry["kind"] == "people":
            for place in chain.from_iterable(entry["walks"].values()):
                time, x, y = map(float, place)
                robot = walk.poses[max(0, bisect_right(times, time) - 1)]
                if math.hypot(x - robot.x, y - robot.y) <= NEARBY:
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
