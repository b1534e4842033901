"""The guide: reads what was told, walks, doubts, repairs, arrives or gives up."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.agents.guide.asking import AskWhen, Inquiry
from memorymaze.agents.guide.search import Search
from memorymaze.agents.notes import PlanNote
from memorymaze.agents.plan_readers import ReaderOptions, ReadsFirst
from memorymaze.agents.walking.outlooks import expected_metres
from memorymaze.agents.walking.walker import Walker
from memorymaze.language.models.model import LanguageModel
from memorymaze.language.plans import RoutePlan, describe
from memorymaze.robot.api.asking import can_ask
from memorymaze.robot.api.control import Robot


@dataclass(frozen=True, slots=True)
class GuideOptions(ReaderOptions):
    """What can be set of the guide."""

    start_heading: Literal["given", "unknown"] = "given"
    """Whether the robot faces the way the description begins with, or any way."""
    things: bool = True
    """Whether things said to be on the way count (false is for ablations)."""
    signs: bool = True
    """Whether it reads signs (false is for ablations)."""
    repair: bool = True
    """Whether it goes back to try another explanation (false is for ablations)."""
    ask: AskWhen = "gain"
    """When it asks people, in the track that has them: never, at the start, at random
    moments, when lost, or where an answer is worth most."""
    told: bool = True
    """Whether the instruction counts, or what people answer alone (false is a control)."""
    answers: bool = True
    """Whether what people answer counts (false is a control)."""


class GuideAgent(ReadsFirst):
    """Follows route descriptions with a belief over where on the way told it is.

    Everything that was said weighs in every explanation of the walk so far; the robot
    goes where success is likeliest for the metres, says what it doubts, goes back to
    the likeliest place of a mistake, and tells how sure it is to have arrived.
    """

    Options = GuideOptions

    def __init__(
        self, options: GuideOptions | None = None, model: LanguageModel | None = None
    ) -> None:
        """Make the agent with its options, and a model where one reads."""
        self.options = options or GuideOptions()
        super().__init__(self.options, model)

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
        options = self.options
        anyhow = options.start_heading == "unknown"
        # Read before the robot is touched, so that what is asked of a model can be
        # written down where there is no building.
        tellings = self.reader.read_tellings(instruction, journal)
        plans = [plan for readings in tellings for plan in readings]
        told = [n for n, readings in enumerate(tellings) for _ in readings]
        walker = Walker(robot, reads_signs=options.signs)
        for plan in plans:
            journal.add(PlanNote(describe(plan)))
        if not options.things:
            plans = list(map(_without_things, plans))
        inquiry = None
        if can_ask(robot):
            metres = expected_metres(plans[-1])
            inquiry = Inquiry(
                robot, options.ask, metres, journal, rng, forgets=not options.answers
            )
            plans = [inquiry.named(p if options.told else RoutePlan()) for p in plans]
        Search(
            plans,
            told,
            walker,
            journal,
            any_heading=anyhow,
            goes_back=options.repair,
            inquiry=inquiry,
        ).run()
        robot.stop()


def _without_things(plan: RoutePlan) -> RoutePlan:
    """Forget what was said to be on the way; the names of the destination stay."""
    nothing = {"mentions": (), "too_far": (), "wrong_way": ()}
    legs = tuple(replace(leg, **nothing) for leg in plan.legs)
    return replace(plan, legs=legs, arrival=replace(plan.arrival, **nothing))
