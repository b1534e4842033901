"""The guide: reads what was told, believes, doubts, repairs, arrives or gives up."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from memorymaze.agents.agent import Journal, Need
from memorymaze.agents.guide.search import Search
from memorymaze.agents.plan_readers import (
    PlanReader,
    ReaderName,
    ReadsFirst,
    needs_of_reader,
    reader_without_model,
)
from memorymaze.agents.walking.walker import Walker
from memorymaze.robot.api import Robot
from memorymaze.routes import describe


@dataclass(frozen=True, slots=True)
class GuideOptions:
    """What can be set of the guide."""

    start_heading: Literal["given", "unknown"] = "given"
    """Whether the robot faces the way the description begins with, or any way."""
    reader: ReaderName = "grammar"
    """What turns the text into a plan: the grammar, offline, a language model, or nobody,
    where the text is the JSON of a plan (`plan`)."""

    @property
    def needs(self) -> frozenset[Need]:
        """What the agent needs with these options."""
        return needs_of_reader(self.reader)


class GuideAgent(ReadsFirst):
    """Follows route descriptions with a belief over where on the way told it is.

    Everything that was said weighs in every explanation of the walk so far; the robot
    goes where success is likeliest for the metres, says what it doubts, goes back to
    the likeliest place of a mistake, and tells how sure it is to have arrived.
    """

    def __init__(
        self, options: GuideOptions | None = None, reader: PlanReader | None = None
    ) -> None:
        """Make the agent with its options, and what reads; that of the options when None."""
        self.options = options or GuideOptions()
        self.reader = reader or reader_without_model(self.options.reader)

    @property
    def name(self) -> str:
        """`guide`, or `guide[model]` where a model reads."""
        return f"guide{self.reader.variant}"

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive the robot as the instruction says, and stop."""
        plan = self.reader.read(instruction, journal)
        journal.note("plan", steps=describe(plan))
        anyhow = self.options.start_heading == "unknown"
        Search(plan, Walker(robot), journal, any_heading=anyhow).run()
        robot.stop()
