"""The walk of the guide: believe, choose, walk on, doubt, go back, arrive or give up."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.agents.guide.alignments import Frontier, Segment, Slip, Start
from memorymaze.agents.guide.arriving import (
    SAME_PLACE,
    Arrivals,
    Ending,
    walk_up_to,
)
from memorymaze.agents.guide.belief import Belief
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.signs import Pointers
from memorymaze.agents.guide.things import Things
from memorymaze.agents.walking.floor_map import FloorMap, Sighting
from memorymaze.agents.walking.outlooks import (
    LEG_METRES,
    expected_metres,
    first_heading_cost,
    headings_to_begin,
    looks_of,
    outlook_of,
    things_on,
)
from memorymaze.agents.walking.walker import Walker
from memorymaze.routes import RoutePlan

FEWEST_METRES, MOST_METRES = 120.0, 400.0
"""Bounds of the walk after which the agent stops at the best place it knows."""
PATIENCE = 2.0
"""Times as long as that, while there is no place that it takes for the destination."""
WAYS = 2.2
"""Times the way told that the robot walks at most, once it knows a place to end at."""
SURELY_TOLD = 0.8
"""Share of its expected length that a way told has in most cases."""
SHORT_WALK = 80.0
"""Metres that are never too many."""
MOST_PHRASES, LIKELY_ENOUGH = 15, 0.02
"""Things looked for at a time, and how likely a leg has to be for its things to count."""
MOST_DECISIONS = 400
SHORT_OF_THE_END = 1.5
"""Metres before the end of a way at which to stop where nothing was seen of the place."""

Step = Frontier | Ending
"""What one may do next: walk a way that is new, or arrive."""
Advise = Callable[[Sequence[tuple[Step, float]]], Step]
"""Returns one of some steps, which come with what they are worth in nats, best first."""


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
    hope: float = 0.05
    """Probability of a way below which it is not worth walking any more."""
    hopeless: float = 0.02
    """Probability below which it does not go to a place."""
    claims: float = 0.2
    """Probability below which it says that it could not find the place."""


class Search:
    """The walk of one episode, decided by the belief."""

    def __init__(
        self,
        plan: RoutePlan,
        walker: Walker,
        journal: Journal,
        *,
        any_heading: bool = False,
        goes_back: bool = True,
        advise: Advise | None = None,
    ) -> None:
        """Prepare to follow a plan from where the robot stands.

        Args:
            plan: What was said.
            walker: Drives the robot and draws the map.
            journal: Takes the notes.
            any_heading: The robot may have to face any way at the start.
            goes_back: It may go back for another explanation.
            advise: Has the last word on what to do next.
        """
        self._plan = plan
        self._walker = walker
        self._journal = journal
        self._any_heading = any_heading
        self._goes_back = goes_back
        self._model = Likelihoods()
        self._patience = Patience()
        self._advise = advise
        self._things = Things(plan, walker.map, self._model)
        self._arrivals = Arrivals(plan, walker.map, self._model, self._things)
        self._belief = Belief(plan, walker.map, self._model, self._things)
        self._pointers = Pointers(self._arrivals.names)
        self._endings: list[Ending] = []
        self._starts: list[Start] = []
        self._limit = _walk_limit(plan)
        self._looks = looks_of(plan)
        """What tells ways apart: looked for at every crossing."""
        self._doubted: frozenset[tuple[str, int]] = frozenset()

    def run(self) -> None:
        """Walk until arrived, or until there is no hope."""
        self._begin()
        for _ in range(MOST_DECISIONS):
            self._update()
            self._survey()
            step = self._choose()
            if step is None:
                break
            if isinstance(step, Ending):
                if self._finish(step):
                    break
            elif self._walk(step):
                return
        if self._said is None:
            self._give_up("there is nothing left to try")

    # -- the start

    def _begin(self) -> None:
        walker = self._walker
        self._said: str | None = None
        if self._any_heading:
            named = [m.phrase for m in things_on(self._plan, 0)]
            outlook = outlook_of(self._plan, 0)
            first = [*outlook.ahead, *outlook.behind, *named, *self._arrivals.names]
            walker.look_about(dict.fromkeys([*self._looks, *first]))
            self._starts = starts_any_way(self._plan, walker.map, walker.at)
        else:
            self._starts = starts_ahead(self._model, walker.map, walker.at)

    def _survey(self) -> None:
        """Look along the ways out of where the robot is, if that may tell them apart.

        Or if the destination should be near and was not seen: it may be round a corner.
        """
        if self._walker.at <= 0:
            return
        best = self._best_frontier()
        wanted: list[str] = []
        if best is None or best.mass < self._patience.plain * self._total:
            wanted.extend(self._looks)
        if self._legs_done[-1] >= self._patience.near and not any(
            each.sighting is not None for each in self._endings
        ):
            wanted.extend(self._arrivals.names)
        if wanted:
            self._walker.survey(wanted)
            self._update()

    # -- believing

    def _update(self) -> None:
        """Believe anew after what was seen, and say what changed."""
        self._belief.pointers = self._pointers.headings(self._walker.map)
        self._belief.update(self._starts)
        self._endings = self._arrivals.endings(self._belief)
        self._total = sum(f.mass for f in self._belief.frontiers.values())
        self._total += sum(each.mass for each in self._endings)
        self._distances = self._walker.map.distances_from(self._walker.at)
        best = self._likeliest()
        self._legs_done, self._doubt = self._summary()
        self._journal.note(
            "belief",
            at=self._walker.at,
            legs=[round(each, 3) for each in self._legs_done],
            doubt=round(self._doubt, 3),
        )
        if best is not None:
            self._say_doubts(best, self._doubt)

    def _summary(self) -> tuple[list[float], float]:
        """Return the probabilities of legs done, and that something told is wrong."""
        legs = np.zeros(len(self._plan.legs) + 1)
        wrong = 0.0
        for frontier in self._belief.frontiers.values():
            for segment, weights in frontier.alignments:
                legs[segment.leg] += weights.sum()
                wrong += weights[1].sum()
        for ending in self._endings:
            legs[-1] += ending.mass
            wrong += ending.weights[1].sum()
        total = max(float(legs.sum()), 1e-300)
        return [float(each) / total for each in legs], float(wrong) / total

    def _likeliest(self) -> Segment | None:
        """Return the likeliest of the alignments."""
        candidates = [(f.mass, f.best) for f in self._belief.frontiers.values()]
        candidates += [(each.mass, each.segment) for each in self._endings]
        return max(candidates, key=lambda each: each[0], default=(0.0, None))[1]

    def _say_doubts(self, best: Segment, doubt: float) -> None:
        """Note where what was told is now believed to be wrong."""
        slips = {(each.kind, each.leg): each for each in best.slips}
        new = [slip for key, slip in slips.items() if key not in self._doubted]
        if new and doubt >= 0.5:
            self._note_doubt(new[0], doubt)
            self._doubted = frozenset(slips)

    def _note_doubt(self, slip: Slip, doubt: float) -> None:
        self._journal.note(
            "doubt",
            score=round(doubt, 3),
            leg=slip.leg + 1,
            at=slip.at,
            kind_of=slip.kind,
        )
        self._walker.say(_doubt_in_words(slip, len(self._plan.legs)))

    # -- choosing

    def _value(self, choice: Frontier | Ending) -> float:
        """Return the logarithm of a probability, less what the way there costs."""
        metres = self._distances.get(choice.at, math.inf)
        mass = choice.mass
        if isinstance(choice, Ending):
            metres += choice.distance
            mass = self._mass_about(choice)
        return math.log(max(mass, 1e-300)) - self._patience.metre_back * metres

    def _mass_about(self, ending: Ending) -> float:
        """Sum the belief in places to arrive at that are as good as this one."""
        return sum(each.mass for each in self._same_place(ending))

    def _same_place(self, ending: Ending) -> list[Ending]:
        return [
            each
            for each in self._endings
            if math.dist(each.place, ending.place) < SAME_PLACE
        ]

    def _is_enough(self, ending: Ending, frontier: Frontier) -> bool:
        """Tell whether what going on may still show is worth less than stopping."""
        chance = self._chance(ending)
        unseen = ending.sighting is None and self._arrivals.at_once
        enough = self._patience.unseen if unseen else self._patience.stops
        if chance < enough and frontier.mass >= self._patience.hope * self._total:
            return False
        return self._value(ending) >= self._value(frontier)

    def _chance(self, ending: Ending) -> float:
        """Return how likely a place is the one to arrive at."""
        return min(self._mass_about(ending) / self._total, 1.0)

    def _choose(self) -> Step | None:
        """Return what to do next; None where nothing is left."""
        frontier, ending = self._best_frontier(), self._best_ending()
        if frontier is None:
            return ending
        best: Step = frontier
        if self._too_far_for(frontier, ending):
            return ending
        if ending is not None and self._is_enough(ending, frontier):
            best = ending
        if self._advise is None:
            return best
        steps = [best, *self._belief.frontiers.values(), *self._endings]
        ranked = sorted(steps, key=lambda each: (each is best, self._value(each)))
        return self._advise([(each, self._value(each)) for each in reversed(ranked)])

    def _best_frontier(self) -> Frontier | None:
        ways: Iterable[Frontier] = self._belief.frontiers.values()
        if not self._goes_back:
            ways = [each for each in ways if each.at == self._walker.at]
        return max(ways, key=self._value, default=None)

    def _best_ending(self) -> Ending | None:
        best = max(self._endings, key=self._value, default=None)
        if best is None or best.mass <= 0.0:
            return None
        return max(self._same_place(best), key=lambda each: each.mass)

    def _too_far_for(self, frontier: Frontier, ending: Ending | None) -> bool:
        """Tell whether after one more stretch there is no time to come back.

        There is time for a small multiple of the way told; if a place seen already is the
        one, the way told is the way to it.
        """
        back, limit = 0.0, self._limit * PATIENCE
        if ending is not None and self._chance(ending) >= self._patience.claims:
            back = self._distances.get(ending.at, math.inf) + ending.distance
            way = self._walker.map.distances_from(self._starts[0].at).get(ending.at)
            if way is not None:
                told = SURELY_TOLD * expected_metres(self._plan)
                enough = WAYS * max(way + ending.distance, told)
                limit = min(limit, max(enough, SHORT_WALK))
        further = self._distances.get(frontier.at, math.inf) + LEG_METRES
        return self._walker.travelled + further + back > limit

    # -- walking

    def _walk(self, frontier: Frontier) -> bool:
        """Walk a way that is new; True when arrived on it."""
        walker, best = self._walker, frontier.best
        self._journal.note(
            "decision",
            at=frontier.at,
            exit=frontier.exit,
            probability=round(frontier.mass / self._total, 3),
            legs_done=best.leg,
            because=list(best.story[-3:]),
        )
        if walker.at != frontier.at and best.slips:
            slip = best.slips[-1]
            self._journal.note(
                "repair", leg=slip.leg + 1, at=frontier.at, reason=slip.kind
            )
        if not walker.go_to(frontier.at):
            walker.map.crossings[frontier.at].closed.add(frontier.exit)
            return False
        begin = walker.travelled
        found: list[tuple[Sighting, float]] = []
        rest = self._total - sum(
            weights.sum()
            for segment, weights in frontier.alignments
            if segment.leg == len(self._plan.legs)
        )

        def arrived(seen: list[Sighting]) -> bool:
            for sighting in seen:
                if not self._may_be_there(sighting):
                    continue
                walked = walker.travelled - begin
                there = sum(
                    self._arrivals.here(segment, sighting, walked).sum()
                    for segment, _ in frontier.alignments
                )
                chance = float(there / (there + rest))
                if chance >= self._patience.sure:
                    if walker.points_on(sighting):
                        self._arrivals.refuted.add(sighting.track)
                        continue
                    found.append((sighting, chance))
                    return True
            return False

        walker.follow_exit(frontier.exit, self._phrases(frontier), arrived)
        if found:
            sighting, chance = found[0]
            self._arrive(f"{sighting.phrase} seen", chance)
            walk_up_to(walker, sighting, self._arrivals.names)
            return True
        return False

    def _may_be_there(self, sighting: Sighting) -> bool:
        return (
            sighting.phrase in self._arrivals.at_once
            and sighting.track not in self._arrivals.refuted
        )

    def _phrases(self, frontier: Frontier) -> list[str]:
        """Return what to look for on a way: what the likelier alignments await."""
        phrases: list[str] = [*self._looks, *self._arrivals.names]
        legs = len(self._plan.legs)
        masses = np.zeros(legs + 1)
        for segment, weights in frontier.alignments:
            masses[segment.leg] += weights.sum()
        shares = masses / max(masses.sum(), 1e-300)
        near = [shares[max(n - 1, 0) : n + 2].sum() for n in range(legs + 1)]
        for number in sorted(range(legs + 1), key=lambda n: -near[n]):
            if near[number] >= LIKELY_ENOUGH:
                phrases.extend(self._things.phrases(number))
        return list(dict.fromkeys(phrases))[:MOST_PHRASES]

    # -- ending

    def _finish(self, ending: Ending) -> bool:
        """Go to a place to arrive at; False where it turns out not to be it."""
        walker = self._walker
        chance = self._chance(ending)
        if chance < self._patience.hopeless:
            self._give_up("nothing fits what was told", chance)
            return True
        if not walker.go_to(ending.at):
            if ending.sighting is None:
                return True
            self._arrivals.refuted.add(ending.sighting.track)
            return False
        if ending.exit is not None and not walker.face(ending.exit):
            walker.map.crossings[ending.at].closed.add(ending.exit)
            return False
        if chance < self._patience.claims:
            self._give_up(f"unlikely: {ending.reason}", chance)
        else:
            self._arrive(ending.reason, chance, ending.segment.story)
        if ending.sighting is None and walker.map.is_dead_end(ending.at):
            # The place is here or short of here, and never beyond.
            walker.turn_by(180.0)
            walker.step(SHORT_OF_THE_END)
            return True
        goal = ending.distance
        while ending.exit is not None and goal > 0.2:
            if ending.sighting is not None:
                seen = [
                    each
                    for each in walker.look((ending.sighting.phrase,))
                    if each.track == ending.sighting.track
                ]
                if seen:
                    walk_up_to(walker, seen[0], self._arrivals.names)
                    return True
            step = min(goal, 0.8)
            if not walker.step(step):
                return True
            goal -= step
        return True

    def _note_last_doubt(self) -> None:
        self._journal.note("doubt", score=round(self._doubt, 3), at=self._walker.at)

    def _arrive(
        self, reason: str, confidence: float, story: tuple[str, ...] = ()
    ) -> None:
        self._said = "arrival"
        self._note_last_doubt()
        self._journal.note(
            "arrival",
            reason=reason,
            confidence=round(confidence, 3),
            because=list(story),
        )

    def _give_up(self, reason: str, confidence: float = 0.0) -> None:
        self._said = "gave_up"
        self._note_last_doubt()
        self._journal.note("gave_up", reason=reason, confidence=round(confidence, 3))
        self._walker.say("I could not find it.")


def starts_ahead(model: Likelihoods, floor: FloorMap, at: int) -> list[Start]:
    """Return the ways to begin where the robot faces the way told, or the opposite one."""
    wrong = model.wrong_start
    if at == 0:
        back = floor.crossings[at].add_exit(math.pi)
        return [Start(0, 0.0, 0, 1 - wrong), Start(0, math.pi, back, wrong)]
    return [Start(at, 0.0, -1, 1 - wrong), Start(at, math.pi, -1, wrong)]


def starts_any_way(plan: RoutePlan, floor: FloorMap, at: int) -> list[Start]:
    """Return the ways to begin where the robot may have to face any way."""
    headings = headings_to_begin(floor.crossings[at].exits)
    costs = [first_heading_cost(plan, floor, at, heading) for heading in headings]
    chances = [math.exp(-cost) for cost in costs]
    return [
        Start(at, heading, -1, chance / sum(chances))
        for heading, chance in zip(headings, chances, strict=True)
    ]


def _doubt_in_words(slip: Slip, legs: int) -> str:
    told = f"turn {slip.leg + 1}" if slip.leg < legs else "the last stretch"
    words = {
        "wrong start": "I think we should have begun the other way.",
        "wrong side": f"I think {told} goes to the other side.",
        "no such turn": f"I think there is no {told} as it was told.",
        "lost": "I think the way was told wrongly. I look for the place.",
        "turn left out": f"I think a turn was left out before {told}.",
    }
    return words.get(slip.kind, f"I doubt what was told of {told}.")


def _walk_limit(plan: RoutePlan) -> float:
    """Metres after which to stop at the best place known."""
    return min(max(FEWEST_METRES, WAYS * expected_metres(plan)), MOST_METRES)
