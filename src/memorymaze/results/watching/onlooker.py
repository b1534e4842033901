"""Follows an episode while it goes on, at a pace one can look at, and shows it."""

import math
import time
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from memorymaze.errors import SettingsError
from memorymaze.geometry.pose import Pose
from memorymaze.results.watching.present import (
    Present,
    Reporter,
    present_step,
)
from memorymaze.simulation import SimulatedRobot

DEFAULT_PACE = 10.0
"""Simulated seconds per second: a walk of minutes is over before one looks away."""
PACES = (0.1, 1000.0)
LAGGING = 0.25
"""Seconds behind its pace after which a walk does not catch up, as after a model's
long thought."""
SPACING = 0.25
"""Metres between the places kept of the path."""


class View(Protocol):
    """Shows an episode to somebody."""

    @property
    def period(self) -> float:
        """Seconds from one picture to the next, at least."""
        ...

    def show(self, present: Present) -> None:
        """Show how things stand."""
        ...

    def finish(self, words: str) -> None:
        """Show how the episode ended."""
        ...


def check_pace(pace: float) -> float:
    """Refuse a pace without meaning.

    Raises:
        SettingsError: It is out of range.
    """
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
        pace: float | None = DEFAULT_PACE,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        """Look on.

        Args:
            view: What shows it.
            pace: Simulated seconds per second; None for as fast as it goes.
            clock: Seconds, growing.
            sleep: Waits some seconds.

        Raises:
            SettingsError: The pace is out of range.
        """
        self._view = view
        self._pace = None if pace is None else check_pace(pace)
        self._clock, self._sleep = clock, sleep
        self._trace: Sequence[dict[str, Any]] = ()
        self._robot: SimulatedRobot | None = None
        self._path: list[tuple[float, float]] = []
        self._distance = 0.0
        self._reporter = Reporter()
        self._last: tuple[float, Pose] | None = None
        self._due = self._shown = -math.inf
        self.trouble: Exception | None = None
        """What kept it from showing the rest of the episode."""

    def begin(self, robot: SimulatedRobot, trace: Sequence[dict[str, Any]]) -> None:
        """See an episode begin."""
        self._robot, self._trace = robot, trace
        self._path, self._distance = [(robot.pose.x, robot.pose.y)], 0.0
        self._last = (robot.time, robot.pose)
        self._reporter = Reporter()
        self._due = self._clock()
        robot.watch(self._moved)
        self._show(robot.time, robot.pose)

    def told(self) -> None:
        """Take note that the trace has grown."""
        if self._robot is None or not self._trace:
            return
        # A new thought may last for a moment only.
        thought = self._trace[-1]["kind"] == "note"
        if thought or self._clock() - self._shown >= self._view.period:
            self._show(self._robot.time, self._robot.pose)

    def end(self, words: str) -> None:
        """Show how things stand at the end, and how the episode ended."""
        if self._robot is None:
            return
        self._show(self._robot.time, self._robot.pose)
        if self.trouble is None:
            self._view.finish(words)

    def _moved(self, now: float, pose: Pose) -> None:
        before, last = self._last or (now, pose)
        self._last = (now, pose)
        self._distance += math.dist(last[:2], pose[:2])
        if math.dist(self._path[-1], pose[:2]) >= SPACING:
            self._path.append((pose.x, pose.y))
        if self.trouble is not None:
            return
        if self._pace is not None:
            self._keep_pace((now - before) / self._pace)
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
            # A closed terminal must not become a failure of the agent.
            self.trouble = problem

    def _present(self, now: float, pose: Pose) -> Present:
        fresh = self._reporter.catch_up(self._trace)
        around = None if self._robot is None else self._robot.surroundings
        crowd = None if around is None else around.crowd
        people = () if crowd is None else crowd.people
        return Present(
            time=now,
            pose=pose,
            path=self._path,
            distance=self._distance,
            step=present_step(self._trace, self._reporter.latest),
            events=self._reporter.latest,
            fresh=fresh,
            people={
                each.record.id: Pose(each.x, each.y, each.heading) for each in people
            },
            things={each.record.id: each.pose for each in around.things}
            if around
            else {},
        )
