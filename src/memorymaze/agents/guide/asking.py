"""Whether, when and what the guide asks people on the way, and what it takes of answers."""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.agents.notes import AskedNote
from memorymaze.agents.walking.walker import Walker
from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading import parse_route_description
from memorymaze.robot.api.asking import AskingRobot, Question, way_to

AskWhen = Literal["never", "start", "random", "lost", "gain"]

ANSWER_TRUST = 0.7
"""How likely the answer of a stranger is of any help, beside other tellings."""
HELPS, HARMS = 0.4, 0.06
"""How likely an answer leads to the goal who would not arrive, and astray who would."""
WORTH_ASKING = 0.055
"""Gain in the probability of success for which the last question is asked; while more are
left, so much less is enough. Small, as answers help more the earlier they come."""
SURE_ENOUGH = 0.75
"""Probability of a place from which on the robot stops there without asking."""
QUARTERS_WAITED = 24
"""Quarter turns, about half a minute, that it waits for somebody before it stops; longer
took the time of short ways."""
LOST_DOUBT, LOST_SHARE = 0.6, 0.3
"""Doubt from which on, and share of the likeliest way below which the robot is lost."""
_ASK_AGAIN = re.compile(r"\bask\b", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Situation:
    """How an episode stands, as far as the robot can know."""

    share: float
    """Of the belief in the likeliest step."""
    doubt: float
    """How likely it is that something told is wrong."""
    over: float
    """Metres walked beyond those of the way told, as a share of these; 0 before."""

    @property
    def success(self) -> float:
        """How likely it is to arrive without asking.

        A logistic regression on the guide's own walks of the texts that were read while
        developing, every metre a case (docs/lab/asking.md).
        """
        logit = 1.72 + 0.25 * math.log(max(self.share, 1e-3))
        logit -= 1.9 * self.doubt + 1.1 * min(self.over, 0.5)
        return 1 / (1 + math.exp(-logit))


@dataclass(frozen=True, slots=True)
class Answer:
    """What somebody said of the way, and where the robot stood."""

    plan: RoutePlan
    turned_back: bool
    """Whether one has to go back the way one came."""
    breaks_off: bool
    """Whether it ends before the destination, where one is to ask again."""


def destination_names(words: str) -> tuple[str, ...]:
    """Return what to look for of a destination that the user calls so.

    >>> destination_names("Conference Room 6")
    ('door that says conference room 6', 'conference room 6')
    """
    return parse_route_description(f"Go to {words}.").arrival.destinations


class Inquiry:
    """The questions of one episode."""

    def __init__(
        self,
        robot: AskingRobot,
        when: AskWhen,
        metres: float,
        journal: Journal,
        rng: np.random.Generator,
        *,
        forgets: bool = False,
    ) -> None:
        """Prepare to ask.

        Args:
            robot: Asks.
            when: What tells that it is time to.
            metres: Expected of the walk.
            journal: Takes the notes.
            rng: Where random moments come from.
            forgets: Answers are not used (a control).
        """
        self.destination = robot.destination()
        """What the user calls it."""
        self._names = destination_names(self.destination)
        self._robot = robot
        self._when = when
        self._most = robot.questions_left()
        self._moments = sorted(rng.uniform(0, metres, self._most).tolist())
        self._journal = journal
        self._forgets = forgets
        self._waited_in_vain = False

    @property
    def _is_over(self) -> bool:
        """Whether no question is left, or none is wanted."""
        return self._when == "never" or self._robot.questions_left() == 0

    def named(self, plan: RoutePlan) -> RoutePlan:
        """Return a plan with the user's name of the destination first."""
        told = dict.fromkeys([*self._names, *plan.arrival.destinations])
        return replace(plan, arrival=replace(plan.arrival, destinations=tuple(told)))

    def way(self, situation: Callable[[], Situation], walked: float) -> Answer | None:
        """Ask for the way, if it is time to and somebody is there."""
        if self._is_over or not self._is_time(situation, walked):
            return None
        return self._way()

    def _way(self) -> Answer | None:
        said = self._ask(way_to(self.destination))
        if said is None:
            return None
        plan = parse_route_description(said)
        back = bool(plan.legs) and plan.legs[0].turn.way == "around"
        if back:
            plan = replace(plan, legs=plan.legs[1:])
        if not (plan.legs or back or self._named_in(plan)):
            return None
        return Answer(self.named(plan), back, _ASK_AGAIN.search(said) is not None)

    def _named_in(self, plan: RoutePlan) -> bool:
        """Tell whether a plan says where the destination lies."""
        arrival = plan.arrival
        where = arrival.side or arrival.length or arrival.at_end
        return bool(where and set(arrival.destinations) & set(self._names))

    def before_stopping(self, chance: float, walker: Walker) -> Answer | None:
        """Ask for the way rather than stop at an unlikely place; wait for somebody."""
        if self._when != "gain" or chance >= SURE_ENOUGH:
            return None
        for _ in range(QUARTERS_WAITED):
            if self._is_over or self._waited_in_vain:
                return None
            answer = self._way()
            if answer is not None:
                return answer
            walker.turn_by(90.0)
        self._waited_in_vain = True
        return None

    def _is_time(self, situation: Callable[[], Situation], walked: float) -> bool:
        left = self._robot.questions_left()
        if self._when == "start":
            return True
        if self._when == "random":
            return walked >= self._moments[self._most - left]
        now = situation()
        if self._when == "lost":
            return now.doubt >= LOST_DOUBT or now.share <= LOST_SHARE
        gain = HELPS * (1 - now.success) - HARMS * now.success
        return gain >= WORTH_ASKING / left

    def _ask(self, question: Question) -> str | None:
        said = self._robot.ask(question)
        if said is not None:
            self._journal.add(AskedNote(str(question), said))
        return None if self._forgets else said
