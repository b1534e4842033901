"""Several tellings of one way, and readings of each, joined place by place.

Every reading has a belief of its own.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from statistics import fmean

from memorymaze.agents.guide.alignments import AssumedStart, Frontier, Segment
from memorymaze.agents.guide.arriving import Arrivals, Ending, endings_at
from memorymaze.agents.guide.belief import Belief
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.signs import Pointers
from memorymaze.agents.guide.things import Things
from memorymaze.agents.walking.floor_map import FloorMap, Point
from memorymaze.agents.walking.outlooks import each_once
from memorymaze.language.plans import RoutePlan

TRUST = 0.85
"""How likely a telling is of any help, beside others."""


MOST_FIT = 5.0
"""How much likelier at most a telling becomes by what it fits."""


class Telling:
    """One telling as it is read: its plan, what it makes likely, and where it may end."""

    def __init__(
        self,
        plan: RoutePlan,
        floor: FloorMap,
        model: Likelihoods,
        number: int,
        trust: float,
        breaks_off: bool,
        told: int,
    ) -> None:
        """Take a plan, and which telling it is a reading of.

        Trust is how likely it is of any help; one that breaks off says nothing of where
        to go after its last turn.
        """
        self.plan = plan
        self.told = told
        self.breaks_off = breaks_off
        self.starts: list[AssumedStart] = []
        self.trust = trust
        self.things = Things(plan, floor, model)
        self.arrivals = Arrivals(plan, floor, model, self.things)
        self.destination = self.arrivals.destination
        self.belief = Belief(plan, floor, model, self.things, telling=number)
        self.endings: list[Ending] = []
        self.total = 0.0
        self._pointers = Pointers(self.destination.names)

    @property
    def legs(self) -> int:
        """How many turns it tells."""
        return len(self.plan.legs)

    def update(self) -> None:
        """Believe anew after what was seen."""
        self.belief.pointers = self._pointers.headings(self.belief.floor)
        self.belief.update(self.starts)
        self.endings = [] if self.breaks_off else self.arrivals.endings(self.belief)
        self._shares_at: dict[Point, float] = {}
        self._open = sum(
            mass
            for frontier in self.belief.frontiers.values()
            for segment, _, mass in frontier.alignments
            if self.is_past(segment)
        )
        self.total = sum(each.mass for each in self.belief.frontiers.values())
        self.total += sum(each.mass for each in self.endings)

    def is_past(self, segment: Segment) -> bool:
        """Tell whether an alignment is where it says no more."""
        return self.breaks_off and segment.leg == self.legs

    @property
    def is_right(self) -> float:
        """How likely it is of any help: trust, and how well it fits what was seen."""
        fits = self.trust * min(self.total, MOST_FIT)
        return fits / (fits + 1 - self.trust)

    @property
    def says(self) -> float:
        """How likely it says where to go now."""
        return self.is_right * (1 - self._open / self.total)

    def share_of_way(self, key: tuple[int, int]) -> float:
        """Return how likely it takes a way out of a crossing to be the next."""
        frontier = self.belief.frontiers.get(key)
        if frontier is None:
            return 0.0
        masses = (
            mass
            for segment, _, mass in frontier.alignments
            if not self.is_past(segment)
        )
        return sum(masses) / self.total

    def share_at(self, place: Point) -> float:
        """Return how likely it takes a place for the destination."""
        # Many alignments end at one place.
        if place not in self._shares_at:
            near = endings_at(self.endings, place)
            self._shares_at[place] = sum(each.mass for each in near) / self.total
        return self._shares_at[place]


@dataclass
class Tellings:
    """What all tellings together make likely.

    A way, or a place to arrive at, is as likely as all of them together make it: each
    is right with the probability that one trusts it, and else says nothing. So an error
    of one is outvoted by the others. Readings of one telling do not bear each other out,
    since one was said: each may be the right one, as likely as it fits.
    """

    floor: FloorMap
    model: Likelihoods
    all: list[Telling] = field(default_factory=list[Telling])
    frontiers: dict[tuple[int, int], Frontier] = field(
        default_factory=dict[tuple[int, int], Frontier]
    )
    endings: list[Ending] = field(default_factory=list[Ending])
    total: float = 0.0

    def add(
        self,
        plan: RoutePlan,
        trust: float = TRUST,
        *,
        breaks_off: bool = False,
        told: int | None = None,
    ) -> Telling:
        """Take one more; where it begins is still to be said.

        It is a reading of the telling with a number, or, without, a telling by itself.
        """
        number = len(self.all)
        told = -1 - number if told is None else told
        telling = Telling(plan, self.floor, self.model, number, trust, breaks_off, told)
        self.all.append(telling)
        return telling

    def update(self) -> None:
        """Believe anew after what was seen."""
        for telling in self.all:
            telling.update()
        if len(self.all) == 1:
            self.frontiers = self.all[0].belief.frontiers
            self.endings = self.all[0].endings
        else:
            self._join()
        self.total = sum(each.mass for each in self.frontiers.values())
        self.total += sum(each.mass for each in self.endings)

    @property
    def names(self) -> tuple[str, ...]:
        """What to look for of the destination."""
        return tuple(each_once(each.destination.names for each in self.all))

    @property
    def names_at_once(self) -> list[str]:
        """Names at which to stop without having seen what else the way has."""
        return each_once(each.destination.at_once for each in self.all)

    @property
    def is_told(self) -> bool:
        """Whether anything is told by which one knows the place."""
        return any(each.arrivals.is_told for each in self.all)

    def _join(self) -> None:
        ways = {key for each in self.all for key in each.belief.frontiers}
        choices = len(ways) + max(sum(len(each.endings) > 0 for each in self.all), 1)
        self.frontiers, self.endings = {}, []
        # One that explains nothing any more makes all alike likely.
        speaking: dict[int, list[Telling]] = {}
        for each in self.all:
            if each.total:
                speaking.setdefault(each.told, []).append(each)
        for telling in chain.from_iterable(speaking.values()):
            others = [
                readings for told, readings in speaking.items() if told != telling.told
            ]
            readings = speaking[telling.told]
            is_it = telling.is_right / sum(each.is_right for each in readings)

            def agreed(
                share: Callable[[Telling], float],
                others: Sequence[Sequence[Telling]] = others,
            ) -> float:
                return math.prod(
                    fmean(
                        each.is_right * share(each) + (1 - each.says) / choices
                        for each in readings
                    )
                    for readings in others
                )

            for key, frontier in telling.belief.frontiers.items():
                factor = agreed(lambda each, key=key: each.share_of_way(key))
                factor *= is_it / telling.total
                joined = self.frontiers.setdefault(key, Frontier(*key))
                for segment, weights, _ in frontier.alignments:
                    if not telling.is_past(segment):
                        scaled = segment._replace(weights=segment.weights * factor)
                        joined.add(scaled, weights * factor)
            for ending in telling.endings:
                place = ending.place
                factor = agreed(lambda each, place=place: each.share_at(place))
                factor *= is_it / telling.total
                self.endings.append(replace(ending, weights=ending.weights * factor))
