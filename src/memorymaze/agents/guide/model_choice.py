"""Which of two near explanations is right: the belief ranks, a language model is asked."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from memorymaze.agents.guide.arriving import SAME_PLACE, Ending
from memorymaze.agents.guide.choosing import Step
from memorymaze.agents.guide.model_questions import ModelQuestions
from memorymaze.agents.guide.model_replies import Choice, read_choice
from memorymaze.agents.guide.walk_log import way_name
from memorymaze.agents.walking.walker import Walker
from memorymaze.routes import RoutePlan, describe

NEAR = 0.5
"""Share of what the best step is worth from which on another is about as good."""
MOST_STEPS = 4
"""That are asked about at a time."""


@dataclass
class ModelChoice:
    """Asks a model where the belief cannot tell; else, and with no request left, the best."""

    plan: RoutePlan
    walker: Walker
    questions: ModelQuestions
    near: float = NEAR

    def __call__(self, ranked: Sequence[tuple[Step, float]]) -> Step:
        """Return one of some steps, which come the best first with their worth in nats."""
        steps = self._near(ranked)
        choice = self._ask(steps) if len(steps) > 1 else None
        if choice is None:
            return steps[0][0]
        self.questions.journal.note(
            "choice",
            step=choice.step,
            of=len(steps),
            doubt=choice.doubt,
            reason=choice.note,
        )
        chosen = steps[choice.step - 1][0]
        self.questions.log.add_step(f"{choice.note} -> {_in_words(chosen)}.")
        return chosen

    def _near(self, ranked: Sequence[tuple[Step, float]]) -> list[tuple[Step, float]]:
        """Return what is about as good as the best, with its worth as a share of that."""
        highest = ranked[0][1]
        found: list[tuple[Step, float]] = []
        for step, worth in ranked:
            share = math.exp(min(worth - highest, 0.0))
            known = any(_are_one(step, other) for other, _ in found)
            if share >= self.near and not known:
                found.append((step, share))
        return found[:MOST_STEPS]

    def _ask(self, steps: Sequence[tuple[Step, float]]) -> Choice | None:
        floor = self.walker.map
        reached = floor.distances_from(self.walker.at)
        for number in [each for each in floor.crossings if each in reached]:
            ways = floor.stretches.values()
            arrivals = (each.arrival for each in ways if each.end == number)
            self.questions.log.arrive(number, next(arrivals, 0.0) if number else 0.0)
        whole = sum(share for _, share in steps)
        told = [
            f"{number}. ({share / whole:.0%}) {_in_words(each)}"
            for number, (each, share) in enumerate(steps, 1)
        ]
        now = "\n".join((
            f"The robot is at place {self.walker.at} after "
            f"{self.walker.travelled:.0f} m. It reads the description so:",
            *describe(self.plan),
            "\nSteps that it could take:",
            *told,
            "",
        ))
        count = len(steps)
        return self.questions.ask("choice", lambda each: read_choice(each, count), now)


def _in_words(step: Step) -> str:
    """Say what a step is, and what it takes for the turns that were told."""
    if isinstance(step, Ending):
        story, where = step.segment.story, f"stop, {step.reason}, at place {step.at}"
        if step.exit is not None:
            where += f", {step.distance:.0f} m along way {way_name(step.exit)}"
    else:
        story = step.best.story
        where = f"take way {way_name(step.exit)} of place {step.at}"
    return f"{where}: {', '.join(story) or 'no turn is made yet'}"


def _are_one(step: Step, other: Step) -> bool:
    if isinstance(step, Ending) and isinstance(other, Ending):
        return math.dist(step.place, other.place) < SAME_PLACE
    return step is other
