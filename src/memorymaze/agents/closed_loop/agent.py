"""A language model that reads the text itself and decides on the way."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from memorymaze.agents.agent import Asking, FairLimits, Journal, Need
from memorymaze.agents.closed_loop.decided_walk import DecidedWalk
from memorymaze.agents.closed_loop.questions import (
    MOST_REQUESTS,
    DecisionQuestions,
    decision_prompts,
)
from memorymaze.agents.closed_loop.walk_log import WalkLog
from memorymaze.agents.walking.walker import Walker
from memorymaze.basics.options import check_least
from memorymaze.language.models.model import LanguageModel
from memorymaze.robot.api.control import Robot


@dataclass(frozen=True, slots=True)
class ClosedLoopOptions:
    """What can be set of the closed-loop agent."""

    start_heading: Literal["given", "unknown"] = "given"
    """Whether the robot faces the way the description begins with, or any way."""
    signs: bool = True
    """Whether it reads signs (false is for ablations)."""
    most_requests: int = MOST_REQUESTS
    """Requests to the model in an episode, after which the robot gives up."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_least(self, most_requests=1)


class ClosedLoopAgent:
    """Asks a language model at each turning point, and does what it says.

    The model is told the text, and a log of what the robot has met and done so far; it
    answers with the way to take, what to look for, or that it has arrived.
    """

    needs: ClassVar[frozenset[Need]] = frozenset({"language_model"})
    Options = ClosedLoopOptions

    def __init__(self, options: ClosedLoopOptions | None, model: LanguageModel) -> None:
        """Make the agent with its options and the model that decides."""
        self.options = options or ClosedLoopOptions()
        self._model = model

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell the prompts; what is asked depends on the walk."""
        return Asking(decision_prompts())

    @property
    def name(self) -> str:
        """`closed_loop[model]`."""
        return f"closed_loop[{self._model.name}]"

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive the robot as the model says, and stop."""
        walker = Walker(robot, reads_signs=self.options.signs)
        log = WalkLog(walker.map, any_heading=self.options.start_heading == "unknown")
        most = self.options.most_requests
        questions = DecisionQuestions(instruction, self._model, journal, log, most)
        DecidedWalk(walker, questions).run()
        robot.stop()
