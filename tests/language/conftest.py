"""A robot for programs to drive that lives nowhere."""

import math
from collections.abc import Callable

import pytest

from memorymaze.errors import CommandError, EpisodeOver
from memorymaze.robot.api import Detection, Direction, MoveResult, SignText, TurnResult


class PaperRobot:
    """Records its calls; from 5 m on it is in a junction, at 20 m is a wall."""

    def __init__(self, call_budget: int = 200) -> None:
        self.calls: list[tuple[str, object]] = []
        self._call_budget = call_budget
        self._distance = 0.0

    @property
    def names(self) -> list[str]:
        return [name for name, _ in self.calls]

    def _record(self, name: str, argument: object = None) -> None:
        if len(self.calls) >= self._call_budget:
            raise EpisodeOver("budget")
        self.calls.append((name, argument))

    def move_forward(self, distance: float) -> MoveResult:
        self._record("move_forward", distance)
        if not (math.isfinite(distance) and distance > 0):
            raise CommandError(f"expected a distance greater than 0, got {distance}")
        moved = min(distance, 20 - self._distance)
        self._distance += moved
        return MoveResult(moved, "done" if moved == distance else "wall")

    def detect_turning_point(self) -> list[Direction]:
        self._record("detect_turning_point")
        return ["left", "forward"] if self._distance >= 5 else []

    def turning_point_id(self) -> int | None:
        self._record("turning_point_id")
        return 1 if self._distance >= 5 else None

    def turn(self, direction: str) -> TurnResult:
        self._record("turn", direction)
        if direction == "left":
            return TurnResult(True, 90.0, "turned left")
        return TurnResult(False, 0.0, f"no way {direction}")

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        self._record("detect_from_RGB_image", object)
        return [
            Detection("door", (0.0, 1.0, 2.0, 3.0), 0.9, 2.0, 10.0, 1),
            Detection("door", (4.0, 1.0, 6.0, 3.0), 0.8, 3.0, -10.0, 2),
        ]

    def read_signs(self) -> list[SignText]:
        self._record("read_signs")
        return [SignText("Library", 3.0, 5.0, 1)]

    def say(self, text: str) -> None:
        self._record("say", text)

    def distance_travelled(self) -> float:
        self._record("distance_travelled")
        return self._distance

    def stop(self) -> None:
        self._record("stop")
        raise EpisodeOver("agent")


@pytest.fixture
def robot() -> PaperRobot:
    """A robot that records its calls."""
    return PaperRobot()


@pytest.fixture
def make_robot() -> Callable[..., PaperRobot]:
    """Makes robots that record their calls."""
    return PaperRobot
