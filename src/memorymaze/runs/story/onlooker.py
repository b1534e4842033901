"""Follows an episode while it goes on, at a pace one can look at, and shows it."""

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, TextIO

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.trace_entries import NoteEntry, TraceEntry
from memorymaze.runs.story.events import Event, events_of, news
from memorymaze.runs.story.understanding import CurrentStep, step_of, understood

PACES = (0.1, 1000.0)
LAGGING = 0.25
"""Seconds behind its pace after which a walk does not catch up, as after a model's
long thought."""
SPACING = 0.25
"""Metres between the places kept of the path."""


@dataclass(frozen=True, slots=True, eq=False)
class Present:
    """An episode at this moment."""

    time: float
    """Simulated seconds."""
    pose: Pose
    path: Sequence[tuple[float, float]]
    """Where the robot has been, metres; it grows."""
    distance: float
    """Metres driven."""
    step: CurrentStep
    """What the agent works on."""
    fresh: Sequence[Event]
    """What happened since it was shown last."""
    people: Mapping[str, Pose]
    things: Mapping[str, Pose]


class View(Protocol):
    """Shows an episode to somebody."""

    @property
    def period(self) -> float:
        """Seconds from one picture to the next, at least."""
        ...

    def show(self, present: Present) -> None:
        """Show how things stand."""
        ...


def check_pace(pace: float) -> float:
    """Refuse a pace without meaning."""
    if not PACES[0] <= pace <= PACES[1]:
        raise SettingsError(
            f"--pace: expected simulated seconds per second from {PACES[0]:g} to "
            f"{PACES[1]:g}, got {pace!r}"
        )
    return pace


class Onlooker:
    """A `Watcher` that holds an episode to a pace and shows it in a view.

    Nothing it does has a part in the episode: where showing fails, the episode goes on
    unseen, and `trouble` says why.
    """

    def __init__(
        self,
        view: View,
        pace: float | None = None,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        """Look on; a pace of None is as fast as it goes."""
        self._view = view
        self.pace = None if pace is None else check_pace(pace)
        """Simulated seconds per second; may be changed while the episode goes on."""
        self._clock, self._sleep = clock, sleep
        self._trace: Sequence[TraceEntry] = ()
        self._robot: SimulatedRobot | None = None
        self._path: list[tuple[float, float]] = []
        self._distance = 0.0
        self._seen = 0
        self._told: dict[str, str] = {}
        self._thoughts: Sequence[Event] = ()
        """The latest one, if there was one."""
        self._last: tuple[float, Pose] | None = None
        self._due = self._shown = -math.inf
        self.trouble: Exception | None = None
        """What kept it from showing the rest of the episode."""

    def begin(self, robot: SimulatedRobot, trace: Sequence[TraceEntry]) -> None:
        """See an episode begin."""
        self._robot, self._trace = robot, trace
        self._path, self._distance = [(robot.pose.x, robot.pose.y)], 0.0
        self._last = (robot.time, robot.pose)
        self._seen = 0
        self._told.clear()
        self._thoughts = ()
        self._due = self._clock()
        robot.watch(self._moved)
        self._show(robot.time, robot.pose)

    def told(self) -> None:
        """Take note that the trace has grown."""
        if self._robot is None or not self._trace:
            return
        # A new thought may last for a moment only.
        thought = isinstance(self._trace[-1], NoteEntry)
        if thought or self._clock() - self._shown >= self._view.period:
            self._show(self._robot.time, self._robot.pose)

    def end(self) -> None:
        """Show how things stand at the end."""
        if self._robot is not None:
            self._show(self._robot.time, self._robot.pose)

    def _moved(self, now: float, pose: Pose) -> None:
        before, last = self._last or (now, pose)
        self._last = (now, pose)
        self._distance += math.dist(last[:2], pose[:2])
        if math.dist(self._path[-1], pose[:2]) >= SPACING:
            self._path.append((pose.x, pose.y))
        if self.trouble is not None:
            return
        if self.pace is not None:
            self._keep_pace((now - before) / self.pace)
        if self._clock() - self._shown >= self._view.period:
            self._show(now, pose)

    def _keep_pace(self, seconds: float) -> None:
        self._due += seconds
        left = self._due - self._clock()
        if left < -LAGGING:
            self._due = self._clock()
        elif left > 0.005:
            self._sleep(min(left, 1.0))

    def _show(self, now: float, pose: Pose) -> None:
        if self.trouble is not None:
            return
        self._shown = self._clock()
        try:
            self._view.show(self._present(now, pose))
        except Exception as problem:
            # A closed pipe must not become a failure of the agent.
            self.trouble = problem

    def _present(self, now: float, pose: Pose) -> Present:
        fresh = news(events_of(self._trace[self._seen :]), self._told)
        self._seen = len(self._trace)
        thoughts = [each for each in fresh if each.kind in {"note", "model"}]
        self._thoughts = thoughts[-1:] or self._thoughts
        around = None if self._robot is None else self._robot.surroundings
        crowd = None if around is None else around.crowd
        people = () if crowd is None else crowd.people
        return Present(
            time=now,
            pose=pose,
            path=self._path,
            distance=self._distance,
            step=step_of(understood(self._trace), self._seen - 1, self._thoughts),
            fresh=fresh,
            people={
                each.record.id: Pose(each.x, each.y, each.heading) for each in people
            },
            things={each.record.id: each.pose for each in around.things}
            if around
            else {},
        )


class PlainView:
    """Prints every event once, and every new step."""

    period = 0.2

    def __init__(self, stream: TextIO) -> None:
        """Print to a stream."""
        self._stream = stream
        self._step: CurrentStep | None = None

    def show(self, present: Present) -> None:
        """Print what is new."""
        for event in present.fresh:
            self._say(f"{event.time:7.1f} s  {event.text}")
        if present.step != self._step and present.step.heading:
            self._step = step = present.step
            line = step.lines[step.current or 0] if step.lines else ""
            self._say(f"{present.time:7.1f} s  {step.heading}: {line}")

    def _say(self, text: str) -> None:
        print(" ".join(text.splitlines()), file=self._stream, flush=True)
