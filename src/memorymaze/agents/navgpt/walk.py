"""One episode of NavGPT: observe, ask, go, and what happens when that fails."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from memorymaze.agents.agent import Journal
from memorymaze.agents.navgpt.directions import compass_degrees
from memorymaze.agents.navgpt.observation import (
    Place,
    history_line,
    observation_text,
    summary_text,
    ways_text,
)
from memorymaze.agents.navgpt.parsing import (
    Finish,
    Unreadable,
    read_reply,
    thought_of,
)
from memorymaze.agents.navgpt.scratchpad import Scratchpad
from memorymaze.agents.navgpt.settings import LoopLimits
from memorymaze.errors import EpisodeOver
from memorymaze.robot.viewpoints import Journey, ViewpointRobot

Ask = Callable[[str, str, Sequence[str]], str]
"""Returns the model's reply, given what is told of the start, the steps so far, and the
ids of the viewpoints listed."""


@dataclass
class Counts:
    """What happened in an episode."""

    requests: int = 0
    moves: int = 0
    blocked_moves: int = 0
    refused_unknown: int = 0
    refused_not_adjacent: int = 0
    parse_failures: dict[str, int] = field(default_factory=dict[str, int])


class Walk:
    """One episode: asks and goes, and keeps what the model is shown."""

    def __init__(
        self,
        ask: Ask,
        robot: ViewpointRobot,
        journal: Journal,
        limits: LoopLimits,
        *,
        faithful: bool = False,
    ) -> None:
        """Begin where the robot is."""
        self.counts = Counts()
        """What happened so far."""
        self._ask = ask
        self._robot = robot
        self._journal = journal
        self._limits = limits
        self._faithful = faithful
        self._pad = Scratchpad(limits.scratchpad, whole_steps=not self._faithful)
        self._failures = 0

    def run(self) -> None:
        """Ask and go until the model says that it has arrived.

        Raises:
            EpisodeOver: A limit is reached, or the robot says so.
        """
        self._place = self._look(compass_degrees(self._robot.start_heading))
        start = self._place
        for _ in range(self._limits.iterations):
            moved = self.counts.moves > 0
            told = summary_text(start) if moved else self._full(start)
            self.counts.requests += 1
            listed = [way.viewpoint for way in self._place.ways]
            reply = self._ask(told, self._pad.text(), listed)
            self._journal.note("thought", text=thought_of(reply))
            wish = read_reply(reply)
            if isinstance(wish, Finish):
                self._journal.note("final_answer", text=wish.answer)
                return
            if isinstance(wish, Unreadable):
                faults = self.counts.parse_failures
                faults[wish.fault] = faults.get(wish.fault, 0) + 1
                self._journal.note("parse_failure", fault=wish.fault, told=wish.told)
                self._fail(reply, wish.told)
            else:
                self._go(wish.viewpoint, reply)
        raise EpisodeOver("budget")

    def _go(self, viewpoint: str, reply: str) -> None:
        before = self._place
        journey = self._robot.go_to(viewpoint)
        if journey.end == "arrived":
            self._arrive(before, journey, reply)
        elif journey.end == "blocked":
            self.counts.blocked_moves += 1
            self._journal.note(
                "blocked_move",
                viewpoint=viewpoint,
                reason=journey.reason,
                distance=journey.distance,
            )
            self._place = self._look(before.heading)
            self._pad.add_move(
                reply,
                f"The way to {viewpoint} is blocked ({journey.reason}). You are back.\n"
                + self._full(self._place),
                f"The way to {viewpoint} was blocked ({journey.reason}).",
            )
        else:
            self._refuse(viewpoint, journey, reply)

    def _arrive(self, before: Place, journey: Journey, reply: str) -> None:
        self.counts.moves += 1
        self._failures = 0
        way = next(way for way in before.ways if way.viewpoint == self._robot.viewpoint)
        self._journal.note(
            "move",
            start=before.viewpoint,
            end=way.viewpoint,
            heading_deg=round(compass_degrees(way.heading), 2),
            distance=journey.distance,
        )
        self._place = self._look(compass_degrees(way.heading))
        self._pad.add_move(
            reply, self._full(self._place), history_line(before, self._place)
        )

    def _refuse(self, viewpoint: str, journey: Journey, reply: str) -> None:
        if journey.end == "unknown":
            self.counts.refused_unknown += 1
            why = "There is no such viewpoint."
        else:
            self.counts.refused_not_adjacent += 1
            why = (
                "That viewpoint is not next to yours, so it cannot be gone to at once."
            )
        self._journal.note("refused_move", viewpoint=viewpoint, why=journey.end)
        self._fail(
            reply,
            f"{why} You did not move and are still at viewpoint "
            f"{self._place.viewpoint}. From here you can go to: "
            f"{ways_text(self._place)}.",
        )

    def _fail(self, reply: str, told: str) -> None:
        self._pad.add_failure(reply, told)
        self._failures += 1
        limit = self._limits.failures
        if limit is not None and self._failures >= limit:
            raise EpisodeOver("stuck")

    def _look(self, heading: float) -> Place:
        robot = self._robot
        place = Place(
            robot.viewpoint, heading, robot.look_around(), tuple(robot.ways_on())
        )
        self._journal.note(
            "observation",
            viewpoint=place.viewpoint,
            described_by=place.panorama.described_by,
            text=self._full(place),
        )
        return place

    def _full(self, place: Place) -> str:
        return observation_text(place, faithful=self._faithful)
