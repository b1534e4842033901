"""What an episode looked like at any moment of it."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.robot.api.control import Detection
from memorymaze.runs.episodes.trace_entries import CallEntry, NoteEntry
from memorymaze.runs.story.events import Event, news, place_of_note
from memorymaze.runs.story.story import Story
from memorymaze.runs.story.understanding import CurrentStep, step_of

FACING_SPAN = 0.6
"""Seconds of a person's walk that say which way the person faces."""
STANDS = 0.05
"""Metres in that time below which a person keeps the way faced before."""


class StorySighting(NamedTuple):
    """Something that the robot's detector found."""

    time: float
    """Simulated seconds."""
    pose: Pose
    """Where the robot was."""
    label: str
    box: tuple[float, float, float, float]
    """Pixels (left, top, right, bottom) in the robot's 640x480 picture."""
    x: float
    """Where it is, metres."""
    y: float


@dataclass(frozen=True, slots=True, eq=False)
class Moment:
    """What can be shown of one moment."""

    time: float
    """Simulated seconds."""
    pose: Pose
    walked: int
    """How many poses of the walk lie in the past."""
    step: CurrentStep
    """What the agent worked on."""
    events: Sequence[Event]
    """What happened so far, the last one last."""
    people: Mapping[str, Pose]
    """Who walked about, and where they were."""


class Moments:
    """An episode as a function of simulated time."""

    def __init__(self, story: Story) -> None:
        """Read what changes in the course of an episode."""
        self.story = story
        table = np.array(story.walk.poses, dtype=np.float64).T
        self._times, self._xs, self._ys = table[0], table[1], table[2]
        self._headings = np.unwrap(table[3])
        # Collisions and people stand behind the walk in a trace, out of order.
        timed = [
            (each.time, number)
            for number, each in enumerate(story.entries)
            if isinstance(each, CallEntry | NoteEntry)
        ]
        self._entry_times = [time for time, _ in timed]
        self._entry_numbers = [number for _, number in timed]
        self._events = news(story.events)
        self._event_times = [event.time for event in self._events]
        self.things = {
            name: Pose(thing.x, thing.y, thing.heading)
            for name, thing in story.things.items()
        }
        """Where each thing stood that no plan has, by its id."""
        self.sightings = tuple(_sightings(story))
        """Everything detected, in the order of time."""

    @property
    def duration(self) -> float:
        """Simulated seconds of the whole episode."""
        return self.story.walk.duration

    @property
    def points(self) -> NDArray[np.float64]:
        """The whole walk, metres, (N, 2)."""
        return self.story.walk.points

    @property
    def movables(self) -> frozenset[str]:
        """Ids of all things and people that no plan has."""
        return frozenset(self.things) | frozenset(self.story.people)

    def at(self, time: float) -> Moment:
        """Return what there is to see at a moment, simulated seconds."""
        passed = bisect_right(self._entry_times, time + 1e-6)
        last = self._entry_numbers[passed - 1] if passed else -1
        understanding = self.story.understanding
        if understanding.programs:
            # A call stands in the trace once it is over: the one at hand is the next.
            last = min(
                (each for each in understanding.marks if each > last), default=last
            )
        happened = bisect_right(self._event_times, time + 1e-6)
        events = self._events[:happened]
        return Moment(
            time=time,
            pose=Pose(
                float(np.interp(time, self._times, self._xs)),
                float(np.interp(time, self._times, self._ys)),
                wrap_angle(float(np.interp(time, self._times, self._headings))),
            ),
            walked=int(np.searchsorted(self._times, time, side="right")),
            step=step_of(understanding, last, events),
            events=events,
            people={
                name: _on_walk(walk, time) for name, walk in self.story.people.items()
            },
        )


def _sightings(story: Story) -> Iterator[StorySighting]:
    for entry in story.entries:
        if not isinstance(entry, CallEntry):
            continue
        pose = Pose(*entry.pose)
        for each in entry.found(Detection):
            x, y = place_of_note(each, pose)
            yield StorySighting(entry.time, pose, each.label, each.box, x, y)


def _on_walk(walk: NDArray[np.float64], time: float) -> Pose:
    """Return where a person was, facing the way the walk went."""
    times, xs, ys = walk
    x, y = (float(np.interp(time, times, each)) for each in (xs, ys))
    heading = 0.0
    # Who stands faces the way walked last, or the way that is walked next.
    moments = times[times <= time][::-1].tolist()
    for moment in [time, *moments, *times[times > time].tolist()]:
        before, after = moment - FACING_SPAN, moment + FACING_SPAN
        east = float(np.interp(after, times, xs) - np.interp(before, times, xs))
        north = float(np.interp(after, times, ys) - np.interp(before, times, ys))
        if math.hypot(east, north) > STANDS:
            heading = math.atan2(north, east)
            break
    return Pose(x, y, heading)
