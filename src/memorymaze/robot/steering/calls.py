"""The calls of an episode: what the trace tells of each, and which may still be made."""

from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

from memorymaze.basics.errors import CommandError, EpisodeOver, SettingsError
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.robot.steering.settings import RobotSettings

_Result = TypeVar("_Result")

STILL_DISTANCE = 0.01
"""Metres driven below which a call brought no motion."""
STILL_ANGLE = 0.02
"""Radians turned below which a call brought no motion."""
LOOKS = (
    "detect_turning_point",
    "turning_point_id",
    "detect_from_RGB_image",
    "read_signs",
    "camera_picture",
)
"""Calls that bring something new when they are the first of their kind at a place."""


@dataclass(frozen=True, slots=True)
class TraceEvent:
    """One call of the control API, when it was over."""

    time: float
    """Seconds since the start of the episode."""
    pose: Pose
    """Where the robot was when the call returned."""
    call: str
    """Name of the function, such as `move_forward`."""
    arguments: Mapping[str, object]
    """By parameter name; values as JSON knows them."""
    result: object
    """What it returned: a record of the control API, a list of such, or what JSON knows;
    `{"error": ...}` when it raised."""


class CallEnd(NamedTuple):
    """When and where a call ended."""

    time: float
    """Seconds."""
    pose: Pose
    distance: float
    """Metres driven so far."""


@dataclass(slots=True)
class Call:
    """A call while it is made, with what the trace tells of it."""

    arguments: dict[str, object]
    result: object = None

    def returns(self, result: _Result) -> _Result:
        """Take note of what it returns."""
        # The list itself goes to the agent, which may change it.
        self.result = list(result) if isinstance(result, list) else result
        return result


class CallLog:
    """Counts the calls of one episode, reports each, and says when it is over."""

    def __init__(
        self,
        settings: RobotSettings,
        on_event: Callable[[TraceEvent], None] | None,
    ) -> None:
        """Begin an episode."""
        self.stopped_by: str | None = None
        """Why the episode is over: `agent`, `budget` or `stuck`; None while it runs."""
        self._settings = settings
        self._on_event = on_event
        self._calls = 0
        self._futile = 0
        self._seen: set[tuple[str, str]] = set()
        self._distance = 0.0
        self._heading: float | None = None

    @property
    def calls(self) -> int:
        """Calls made so far."""
        return self._calls

    def begin(self) -> None:
        """Take note that a call begins, unless the episode is over or out of calls."""
        if self.stopped_by is None and self._calls >= self._settings.call_budget:
            self.stopped_by = "budget"
        if self.stopped_by is not None:
            raise EpisodeOver(self.stopped_by)
        self._calls += 1

    @contextmanager
    def call(
        self, name: str, arguments: dict[str, object], moment: Callable[[], CallEnd]
    ) -> Generator[Call]:
        """Begin a call, and report it when it is over, where the robot is then.

        Arguments without meaning are told as they were written.
        """
        self.begin()
        made = Call(arguments)
        try:
            yield made
        except (CommandError, SettingsError) as error:
            written = {name: repr(value)[:80] for name, value in arguments.items()}
            self.end(name, written, {"error": str(error)}, moment())
            raise
        self.end(name, made.arguments, made.result, moment())

    def end(
        self, call: str, arguments: Mapping[str, object], result: object, now: CallEnd
    ) -> None:
        """Report a call; too many in a row that changed nothing end the episode."""
        time, pose, distance = now
        if self._on_event is not None:
            self._on_event(TraceEvent(time, pose, call, arguments, result))
        moved = (
            self._heading is None
            or distance - self._distance > STILL_DISTANCE
            or abs(turn_between(self._heading, pose.heading)) > STILL_ANGLE
        )
        if moved:
            self._distance, self._heading = distance, pose.heading
            self._seen.clear()
            self._futile = 0
        question = (call, repr(arguments))
        if call in LOOKS and question not in self._seen:
            self._seen.add(question)
            self._futile = 0
        elif not moved:
            self._futile += 1
            if self._futile >= self._settings.stuck_limit and self.stopped_by is None:
                self.stopped_by = "stuck"
                raise EpisodeOver("stuck")
