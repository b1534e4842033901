"""What the guide does next: walk a way that is new, or stop; and what metres are worth."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from memorymaze.agents.guide.alignments import Frontier
from memorymaze.agents.guide.arriving import Ending, endings_at
from memorymaze.agents.guide.tellings import Tellings
from memorymaze.agents.walking.floor_map import Point
from memorymaze.agents.walking.outlooks import LEG_METRES, expected_metres
from memorymaze.agents.walking.walker import Walker
from memorymaze.language.plans import RoutePlan

FEWEST_METRES, MOST_METRES = 120.0, 400.0
"""Bounds of the walk after which a search ends at the best place it knows."""
PATIENCE = 2.0
"""Times as long as that, after which every walk does."""
WAYS = 2.2
"""Times the way told that there is time to walk."""
SHORT_WALK = 80.0
"""Metres that are never too many."""

_Step = Frontier | Ending
"""What one may do next: walk a way that is new, or arrive."""


@dataclass(frozen=True, slots=True)
class Patience:
    """What metres are worth, and when the robot claims to be there."""

    metre_back: float = 0.02
    """Nats that a metre to walk to another explanation is worth."""
    sure: float = 0.8
    """Probability from which on it stops at what it just saw."""
    plain: float = 0.85
    """Probability from which on a way is taken without looking along the others."""
    near: float = 0.4
    """Probability that all turns are made, from which on it looks about for the place."""
    stops: float = 0.5
    """Probability of a place from which on it goes there while other ways are open."""
    unseen: float = 0.7
    """The same of a place where nothing was seen of a destination told by a name."""
    untold: float = 0.25
    """The same where nothing is told of the place, so that no other way will show it."""
    hope: float = 0.05
    """Probability of a way below which it is not worth walking any more."""
    hopeless: float = 0.02
    """Probability below which it does not go to a place."""
    claims: float = 0.2
    """Probability below which it says that it could not find the place."""
    claims_unseen: float = 0.4
    """The same where nothing was seen of a destination told by a name."""


class Choice:
    """Chooses among the ways and places that the tellings make likely."""

    def __init__(
        self,
        plans: Sequence[RoutePlan],
        tellings: Tellings,
        walker: Walker,
        *,
        goes_back: bool,
    ) -> None:
        """Choose on the way told by these plans, which bounds how far to walk."""
        self.patience = Patience()
        self._tellings = tellings
        self._walker = walker
        self._goes_back = goes_back
        self._searches = all(each.tells_place_alone for each in plans)
        self._limit = max(map(_walk_limit, plans))

    def update(self) -> None:
        """Measure anew from where the robot is, and by what is believed now."""
        self._distances = self._walker.map.distances_from(self._walker.at)
        self._masses: dict[Point, float] = {}

    def walk_on_for(self, plan: RoutePlan) -> None:
        """Allow for the metres of a way that was told on the way."""
        self._searches = self._searches and plan.tells_place_alone
        self._limit = max(self._limit, self._walker.travelled + _walk_limit(plan))

    def value(self, choice: _Step) -> float:
        """Return the logarithm of a probability, less what the way there costs."""
        metres, mass = self._metres_to(choice), choice.mass
        if isinstance(choice, Ending):
            mass = self._mass_here(choice)
        return math.log(max(mass, 1e-300)) - self.patience.metre_back * metres

    def _metres_to(self, choice: _Step) -> float:
        metres = self._distances.get(choice.at, math.inf)
        return metres + choice.distance if isinstance(choice, Ending) else metres

    def mass_about(self, ending: Ending) -> float:
        """Sum the belief in places to arrive at that are as good as this one."""
        # Many alignments end at one place.
        if ending.place not in self._masses:
            near = endings_at(self._tellings.endings, ending.place)
            self._masses[ending.place] = sum(each.mass for each in near)
        return self._masses[ending.place]

    def _mass_here(self, ending: Ending) -> float:
        """Return the most belief in a place that is one with this one."""
        near = endings_at(self._tellings.endings, ending.place)
        return max(self.mass_about(each) for each in near)

    def _is_enough(self, ending: Ending, frontier: Frontier) -> bool:
        """Tell whether a place is likely enough to walk no other way."""
        enough = self.patience.stops
        if self._misses_name(ending):
            enough = self.patience.unseen
        elif ending.sighting is None and not self._tellings.is_told:
            enough = self.patience.untold
        return self.chance(ending) >= enough or not self._is_hope(frontier)

    def _is_hope(self, frontier: Frontier) -> bool:
        """Tell whether the best way on is worth walking, or in a search all that are left."""
        ways = self._tellings.frontiers.values() if self._searches else [frontier]
        left = sum(each.mass for each in ways)
        return left >= self.patience.hope * self._tellings.total

    def _misses_name(self, ending: Ending) -> bool:
        """Tell whether a name was told that is met once, and nothing of it was seen."""
        return ending.sighting is None and bool(self._tellings.names_at_once)

    def claims(self, ending: Ending) -> bool:
        """Tell whether a place is likely enough to say that it is the one."""
        unseen = self._misses_name(ending)
        least = self.patience.claims_unseen if unseen else self.patience.claims
        return self.chance(ending) >= least

    def chance(self, ending: Ending) -> float:
        """Return how likely a place is the one to arrive at."""
        return min(self._mass_here(ending) / self._tellings.total, 1.0)

    def best(self) -> _Step | None:
        """Return what to do next; None where nothing is left."""
        frontier, ending = self.best_frontier(), self.best_ending()
        if frontier is None:
            return ending
        walked = self._walker.travelled + self._metres_to(frontier) + LEG_METRES
        if walked > self._limit * PATIENCE:
            return ending
        if ending is None or self.value(ending) < self.value(frontier):
            return frontier
        if self._is_enough(ending, frontier) or self._is_too_late(ending, walked):
            return ending
        return frontier

    def best_frontier(self) -> Frontier | None:
        """Return the way that is worth most; None where there is none."""
        ways: Iterable[Frontier] = self._tellings.frontiers.values()
        if not self._goes_back:
            ways = [each for each in ways if each.at == self._walker.at]
        return max(ways, key=self.value, default=None)

    def best_ending(self) -> Ending | None:
        """Return the likeliest place to arrive at; None where there is none."""
        best = max(self._tellings.endings, key=self.mass_about, default=None)
        if best is None or best.mass <= 0.0:
            return None
        near = endings_at(self._tellings.endings, best.place)
        return max(near, key=lambda each: each.mass)

    def _is_too_late(self, ending: Ending, walked: float) -> bool:
        """Tell whether there is no time to come back to a place after so many metres.

        If the place is the one, the way told is the way to it, and there is time for a small
        multiple of that.
        """
        if not self.claims(ending):
            return False
        limit = self._limit
        begun = self._tellings.all[0].starts[0].at
        way = self._walker.map.distances_from(begun).get(ending.at)
        if way is not None and not self._searches:
            limit = max(WAYS * (way + ending.distance), SHORT_WALK)
        return walked + self._metres_to(ending) > limit


def _walk_limit(plan: RoutePlan) -> float:
    """Metres after which to stop at the best place known."""
    return min(max(FEWEST_METRES, WAYS * expected_metres(plan)), MOST_METRES)
