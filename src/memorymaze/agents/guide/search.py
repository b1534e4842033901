"""The walk of the guide: believe, choose, walk on, doubt, go back, arrive or give up."""

import math
from collections.abc import Sequence

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.agents.guide.alignments import (
    AssumedStart,
    Frontier,
    Segment,
    Slip,
    mass_of,
)
from memorymaze.agents.guide.arriving import Ending
from memorymaze.agents.guide.asking import ANSWER_TRUST, Answer, Inquiry, Situation
from memorymaze.agents.guide.choosing import Choice
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.starts import starts_ahead, starts_any_way
from memorymaze.agents.guide.tellings import Telling, Tellings
from memorymaze.agents.notes import (
    ArrivalNote,
    BeliefNote,
    DecisionNote,
    DoubtNote,
    GaveUpNote,
    RepairNote,
)
from memorymaze.agents.walking.approaching import stand_before, walk_up_to
from memorymaze.agents.walking.floor_map import Sighting, Stretch
from memorymaze.agents.walking.outlooks import (
    each_once,
    expected_metres,
    looks_of,
    phrases_at_start,
)
from memorymaze.agents.walking.walker import Walker
from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.language.plans import RoutePlan

MOST_PHRASES, LIKELY_ENOUGH = 24, 0.02
"""Things looked for at a time, and how likely a leg has to be for its things to count."""
MOST_DECISIONS = 400
SEES_MOST = 0.95
"""Share of what stands beside its way from which on it need not look there."""
GLANCE_METRES = 2.4
"""Metres of a wide way, on which the place may be, between two looks beside it."""
BEYOND, PAST = 1.5, 3.0
"""Times the length told of the last stretch, and metres more, after which to think anew."""
SHORT_OF_THE_END = 1.5
"""Metres before the end of a way at which to stop where nothing was seen of the place."""


class Search:
    """The walk of one episode, decided by the belief."""

    def __init__(
        self,
        plans: Sequence[RoutePlan],
        told: Sequence[int],
        walker: Walker,
        journal: Journal,
        *,
        any_heading: bool = False,
        goes_back: bool = True,
        inquiry: Inquiry | None = None,
    ) -> None:
        """Prepare to follow what was told from where the robot stands.

        Args:
            plans: What was said; several where the way was told several times, or a
                telling is read in several ways.
            told: Which telling each plan is a reading of.
            walker: Drives the robot and draws the map.
            journal: Takes the notes.
            any_heading: The robot may have to face any way at the start.
            goes_back: It may go back for another explanation.
            inquiry: Asks people, where there are some.
        """
        self._plans, self._told = plans, told
        self._walker = walker
        self._journal = journal
        self._any_heading = any_heading
        self._model = Likelihoods()
        self._inquiry = inquiry
        self._tellings = Tellings(walker.map, self._model)
        self._choice = Choice(plans, self._tellings, walker, goes_back=goes_back)
        self._looks = each_once(map(looks_of, plans))
        """What tells ways apart: looked for at every crossing."""
        self._doubted: frozenset[tuple[str, int]] = frozenset()

    def run(self) -> None:
        """Walk until arrived, or until there is no hope."""
        self._begin()
        for _ in range(MOST_DECISIONS):
            self._update()
            self._survey()
            if self._inquiry is not None:
                answer = self._inquiry.way(self._situation, self._walker.travelled)
                if answer is not None:
                    self._heed(answer)
            step = self._choice.best()
            if not isinstance(step, Frontier) and self._asks_rather_than_stop(step):
                continue
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
        for plan, told in zip(self._plans, self._told, strict=True):
            self._tellings.add(plan, told=told)
        if self._any_heading:
            first = map(phrases_at_start, self._plans)
            walker.look_about(each_once([self._looks, *first, self._tellings.names]))
        for telling in self._tellings.all:
            if self._any_heading:
                telling.starts = starts_any_way(telling.plan, walker.map, walker.at)
            else:
                telling.starts = starts_ahead(self._model, walker.map, walker.at)

    def _survey(self) -> None:
        """Look along the ways out of where the robot is, if that may tell them apart.

        Or if the destination should be near and was not seen: it may be round a corner.
        """
        if self._walker.at <= 0:
            return
        best = self._choice.best_frontier()
        wanted: list[str] = []
        if best is None or best.mass < self._choice.patience.plain * self._total:
            wanted.extend(self._looks)
        if self._legs_done[-1] >= self._choice.patience.near and not any(
            each.sighting is not None for each in self._tellings.endings
        ):
            wanted.extend(self._tellings.names)
        if wanted:
            self._walker.survey(wanted)
            self._update()

    # -- believing

    def _update(self) -> None:
        """Believe anew after what was seen, and say what changed."""
        self._tellings.update()
        self._total = self._tellings.total
        self._share: float | None = None
        """Of the likeliest step; worked out when somebody wants to know."""
        self._choice.update()
        best = self._likeliest()
        self._legs_done, self._doubt = self._summary()
        legs = [round(each, 3) for each in self._legs_done]
        self._journal.add(BeliefNote(self._walker.at, legs, round(self._doubt, 3)))
        if best is not None:
            self._say_doubts(best, self._doubt)

    def _summary(self) -> tuple[list[float], float]:
        """Return the probabilities of legs done, and that something told is wrong.

        Legs are counted from the last, where tellings have more and fewer.
        """
        most = max(each.legs for each in self._tellings.all)
        legs = np.zeros(most + 1)
        wrong = 0.0
        for frontier in self._tellings.frontiers.values():
            for segment, weights, mass in frontier.alignments:
                telling = self._tellings.all[segment.telling]
                legs[segment.leg + most - telling.legs] += mass
                wrong += mass_of(weights[1])
        for ending in self._tellings.endings:
            legs[-1] += ending.mass
            wrong += mass_of(ending.weights[1])
        total = max(float(legs.sum()), 1e-300)
        return [float(each) / total for each in legs], float(wrong) / total

    def _likeliest(self) -> Segment | None:
        """Return the likeliest of the alignments."""
        candidates = [(f.mass, f.best) for f in self._tellings.frontiers.values()]
        candidates += [(each.mass, each.segment) for each in self._tellings.endings]
        return max(candidates, key=lambda each: each[0], default=(0.0, None))[1]

    def _say_doubts(self, best: Segment, doubt: float) -> None:
        """Note where what was told is now believed to be wrong."""
        slips = {(each.kind, each.leg): each for each in best.slips}
        new = [slip for key, slip in slips.items() if key not in self._doubted]
        if new and doubt >= 0.5:
            self._note_doubt(new[0], doubt)
            self._doubted = frozenset(slips)

    def _note_doubt(self, slip: Slip, doubt: float) -> None:
        self._journal.add(DoubtNote(round(doubt, 3), slip.leg + 1, slip.at, slip.kind))
        self._walker.say(_doubt_in_words(slip, len(self._plans[0].legs)))

    # -- walking

    def _walk(self, frontier: Frontier) -> bool:
        """Walk a way that is new; True when arrived on it."""
        walker, best = self._walker, frontier.best
        self._journal.add(
            DecisionNote(
                frontier.at,
                frontier.exit,
                probability=round(frontier.mass / self._total, 3),
                legs_done=best.leg,
                because=best.story[-3:],
            )
        )
        if walker.at != frontier.at and best.slips:
            slip = best.slips[-1]
            self._journal.add(RepairNote(slip.leg + 1, frontier.at, slip.kind))
        if not walker.go_to(frontier.at):
            walker.map.crossings[frontier.at].closed.add(frontier.exit)
            return False
        begin = walker.travelled
        found: list[tuple[Sighting, float]] = []
        rest = self._total - sum(
            mass
            for segment, _, mass in frontier.alignments
            if segment.leg == self._of(segment).legs
        )

        def arrived(seen: list[Sighting]) -> bool:
            for sighting in seen:
                if not self._may_be_there(sighting):
                    continue
                walked = walker.travelled - begin
                there = sum(
                    self._of(segment).arrivals.here(segment, sighting, walked).sum()
                    for segment, _, _ in frontier.alignments
                )
                beyond = sum(
                    self._of(segment).arrivals.beyond(segment, sighting, walked).sum()
                    for segment, _, _ in frontier.alignments
                )
                chance = float(there / (there + beyond + rest))
                if chance >= self._choice.patience.sure:
                    if walker.points_on(sighting):
                        walker.map.refuted.add(sighting.track)
                        continue
                    found.append((sighting, chance))
                    return True
            return False

        answers: list[tuple[Answer, float]] = []
        may_end = self._may_end_on(frontier)
        wide = may_end and walker.map.seen_beside < SEES_MOST
        side, glanced = self._plans[0].arrival.side, [begin]

        def is_too_far() -> bool:
            walked = walker.travelled - begin
            return may_end and self._is_beyond_what_was_told(best, walked)

        def told(seen: list[Sighting]) -> bool:
            if self._inquiry is not None:
                answer = self._inquiry.way(self._situation, walker.travelled)
                if answer is not None:
                    answers.append((answer, walker.travelled - begin))
                    if answer.turned_back or walker.is_in_turning_point:
                        return True
            if wide and walker.travelled - glanced[-1] >= GLANCE_METRES:
                glanced.append(walker.travelled)
                seen = [*seen, *walker.glance(self._tellings.names, side)]
            if arrived(seen):
                return True
            return is_too_far() and not walker.is_in_turning_point

        stretch = walker.follow_exit(frontier.exit, self._phrases(frontier), told)
        for answer, walked in answers:
            if stretch is not None:
                self._heed(answer, stretch, walked)
                continue
            if walked > 0 and not walker.is_in_turning_point:
                walker.halt()
            self._heed(answer)
        if stretch is None and is_too_far() and not found and not answers:
            walker.halt()
        if found:
            sighting, chance = found[0]
            self._arrive(f"{sighting.phrase} seen", chance)
            walk_up_to(walker, sighting, self._tellings.names)
            return True
        return False

    def _is_beyond_what_was_told(self, segment: Segment, walked: float) -> bool:
        """Tell whether a last stretch has just become longer than was told of it."""
        length = self._of(segment).plan.arrival.length
        if length is None or length.unit == "places":
            return False
        enough = BEYOND * length.metres + PAST
        return segment.walked < enough <= segment.walked + walked

    def _may_end_on(self, frontier: Frontier) -> bool:
        """Tell whether all turns are likely made where a way begins."""
        last = sum(
            mass
            for segment, _, mass in frontier.alignments
            if segment.leg == self._of(segment).legs
        )
        return last >= self._choice.patience.near * frontier.mass

    def _situation(self) -> Situation:
        """Return how the episode stands."""
        if self._share is None:
            masses = [each.mass for each in self._tellings.frontiers.values()]
            masses += [self._choice.mass_about(each) for each in self._tellings.endings]
            # Where nothing that was told fits any more, no place is likely.
            self._share = max(masses, default=0.0) / self._total if self._total else 0.0
        told = expected_metres(self._plans[0])
        return Situation(
            self._share,
            self._doubt,
            max(self._walker.travelled / told - 1.0, 0.0),
        )

    def _asks_rather_than_stop(self, ending: Ending | None) -> bool:
        """Ask for the way where the robot would stop without being sure."""
        if self._inquiry is None:
            return False
        chance = 0.0 if ending is None else self._choice.chance(ending)
        answer = self._inquiry.before_stopping(chance, self._walker)
        if answer is None:
            return False
        self._heed(answer)
        return True

    def _heed(
        self, answer: Answer, stretch: Stretch | None = None, walked: float = 0.0
    ) -> None:
        """Take what somebody said of the way on from here, or from a place on a stretch."""
        walker = self._walker
        at, exit, heading = walker.at, -1, walker.heading
        if stretch is not None:
            at, exit = stretch.start, stretch.exit
            heading = walker.map.crossings[at].exits[exit]
        elif answer.turned_back:
            heading = wrap_angle(heading + math.pi)
        telling = self._tellings.add(
            answer.plan, ANSWER_TRUST, breaks_off=answer.breaks_off
        )
        telling.starts = [AssumedStart(at, heading, exit, 1.0, -walked)]
        self._choice.walk_on_for(answer.plan)
        self._update()

    def _of(self, segment: Segment) -> Telling:
        return self._tellings.all[segment.telling]

    def _may_be_there(self, sighting: Sighting) -> bool:
        return (
            sighting.phrase in self._tellings.names_at_once
            and sighting.track not in self._walker.map.refuted
        )

    def _phrases(self, frontier: Frontier) -> list[str]:
        """Return what to look for on a way: what the likelier alignments await."""
        whole = max(frontier.mass, 1e-300)
        awaited: list[tuple[float, list[str]]] = []
        kin: list[str] = []
        for number, telling in enumerate(self._tellings.all):
            shares = np.zeros(telling.legs + 1)
            for segment, _, mass in frontier.alignments:
                if segment.telling == number:
                    shares[segment.leg] += mass / whole
            for leg in range(telling.legs + 1):
                near = float(shares[max(leg - 1, 0) : leg + 2].sum())
                awaited.append((near, telling.things.phrases(leg)))
            if shares[-1] >= self._choice.patience.near:
                kin.extend(telling.destination.kin)
        awaited.sort(key=lambda each: -each[0])
        likely = [phrases for near, phrases in awaited if near >= LIKELY_ENOUGH]
        told = each_once([self._looks, self._tellings.names, *likely])[:MOST_PHRASES]
        return each_once([told, kin])

    # -- ending

    def _finish(self, ending: Ending) -> bool:
        """Go to a place to arrive at; False where it turns out not to be it."""
        walker = self._walker
        chance = self._choice.chance(ending)
        if chance < self._choice.patience.hopeless:
            self._give_up("nothing fits what was told", chance)
            return True
        if not walker.go_to(ending.at):
            if ending.sighting is None:
                return True
            walker.map.refuted.add(ending.sighting.track)
            return False
        if ending.exit is not None and not walker.face(ending.exit):
            walker.map.crossings[ending.at].closed.add(ending.exit)
            return False
        if not self._choice.claims(ending):
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
                    if ending.sighting.is_again(each)
                ]
                if seen:
                    walk_up_to(walker, seen[0], self._tellings.names)
                    return True
            step = min(goal, 0.8)
            if not walker.step(step):
                break
            goal -= step
        if ending.sighting is not None:
            # From here it may be round a corner, as it was seen from another way.
            stand_before(walker, ending.sighting)
        return True

    def _note_last_doubt(self) -> None:
        self._journal.add(DoubtNote(round(self._doubt, 3), at=self._walker.at))

    def _arrive(
        self, reason: str, confidence: float, story: tuple[str, ...] = ()
    ) -> None:
        self._said = "arrival"
        self._note_last_doubt()
        self._journal.add(
            ArrivalNote(reason, confidence=round(confidence, 3), because=story)
        )

    def _give_up(self, reason: str, confidence: float = 0.0) -> None:
        self._said = "gave_up"
        self._note_last_doubt()
        self._journal.add(GaveUpNote(reason, round(confidence, 3)))
        self._walker.say("I could not find it.")


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
