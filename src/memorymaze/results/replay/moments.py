"""What an episode looked like at any moment of it, read from its trace."""

import math
from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from memorymaze.geometry.pose import Pose, wrap_angle
from memorymaze.results.replay.current_step import CurrentStep, step_of
from memorymaze.results.report.event_words import Event
from memorymaze.results.report.story import Story

FACING_SPAN = 0.6
"""Seconds of a person's walk that say which way the person faces."""
STANDS = 0.05
"""Metres in that time below which a person keeps the way faced before."""


class Sighting(NamedTuple):
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
    """Where it is, metres."""


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

    def __init__(self, entries: Sequence[Mapping[str, Any]], story: Story) -> None:
        """Read what changes in the course of an episode."""
        self._story = story
        table = np.array(story.walk.poses, dtype=np.float64).T
        self._times, self._xs, self._ys = table[0], table[1], table[2]
        self._headings = np.unwrap(table[3])
        # Collisions and people stand behind the walk in a trace, out of order.
        timed = [
            (float(each["time"]), number)
            for number, each in enumerate(entries)
            if each["kind"] in {"call", "note"}
        ]
        self._entry_times = [time for time, _ in timed]
        self._entry_numbers = [number for _, number in timed]
        self._events = news(story.events)
        self._event_times = [event.time for event in self._events]
        self.walks_of_people = _walks(entries)
        """By person: times, x and y, (3, N)."""
        self.things = _things(entries)
        """Where each thing stood that no plan has, by its id."""
        self.sightings = _sightings(entries)
        """Everything detected, in the order of time."""

    @property
    def duration(self) -> float:
        """Simulated seconds of the whole episode."""
        return self._story.walk.duration

    @property
    def points(self) -> NDArray[np.float64]:
        """The whole walk, metres, (N, 2)."""
        return self._story.walk.points

    @property
    def movables(self) -> frozenset[str]:
        """Ids of all things and people that no plan has."""
        return frozenset(self.things) | frozenset(self.walks_of_people)

    def at(self, time: float) -> Moment:
        """Return what there is to see at a moment, simulated seconds."""
        passed = bisect_right(self._entry_times, time + 1e-6)
        last = self._entry_numbers[passed - 1] if passed else -1
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
            step=step_of(self._story.understanding, last, events),
            events=events,
            people={
                name: _on_walk(walk, time)
                for name, walk in self.walks_of_people.items()
            },
        )


def news(events: Iterable[Event], told: dict[str, str] | None = None) -> list[Event]:
    """Return events in the order of time, without answers that are as before.

    Agents ask the same at every step; what stays the same is told once.

    Args:
        events: What happened.
        told: The last text told of each kind, which is brought up to date; None where
            nothing was told before.
    """
    told = {} if told is None else told
    kept: list[Event] = []
    for event in sorted(events, key=lambda each: each.time):
        if event.kind in {"ask", "look"} and told.get(event.kind) == event.text:
            continue
        told[event.kind] = event.text
        kept.append(event)
    return kept


def _walks(entries: Sequence[Mapping[str, Any]]) -> dict[str, NDArray[np.float64]]:
    for entry in entries:
        if entry["kind"] == "people":
            return {
                name: np.array(walk, dtype=np.float64).T
                for name, walk in entry["walks"].items()
            }
    return {}


def _things(entries: Sequence[Mapping[str, Any]]) -> dict[str, Pose]:
    return {
        thing["object_id"]: Pose(*thing["pose"])
        for entry in entries
        if entry["kind"] == "things"
        for thing in entry["things"]
    }


def _sightings(entries: Sequence[Mapping[str, Any]]) -> tuple[Sighting, ...]:
    found: list[Sighting] = []
    for entry in entries:
        if entry["kind"] != "call" or entry["call"] != "detect_from_RGB_image":
            continue
        if not isinstance(entry["result"], list):
            continue
        pose = Pose(*entry["pose"])
        for each in entry["result"]:
            way = pose.heading + math.radians(each["bearing_deg"])
            far = each["distance"]
            found.append(
                Sighting(
                    entry["time"],
                    pose,
                    str(each["label"]),
                    tuple(each["box"]),
                    pose.x + far * math.cos(way),
                    pose.y + far * math.sin(way),
                )
            )
    return tuple(found)


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
