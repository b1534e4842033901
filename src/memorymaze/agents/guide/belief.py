"""Where on the way told the robot may be: a belief over (place, leg), by summing.

A segmental hidden Markov model: a segment is a stretch between two turns of the plan, its
states are the ways out of crossings with so many legs done. Weights are summed over all
alignments of the plan with the sketch map, not only the best one; each carries what was
learned on it of the speaker. The whole is computed anew from the map after each stretch,
so what is seen late speaks for and against every turn before it.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from memorymaze.agents.guide.alignments import (
    AssumedStart,
    Frontier,
    Segment,
    Slip,
    Visit,
    mass_of,
    summed,
)
from memorymaze.agents.guide.likelihoods import (
    Likelihoods,
    Weights,
    then,
    untold_bend,
    way_ratio,
    without_turn,
)
from memorymaze.agents.guide.said_of_legs import SaidOfLegs
from memorymaze.agents.guide.things import Things
from memorymaze.agents.walking.choices import BACK, SLIGHT, Choices, KnownChoices
from memorymaze.agents.walking.floor_map import FloorMap, Stretch
from memorymaze.agents.walking.outlooks import faces, length_of
from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.language.plans import RoutePlan

LEAST_WEIGHT = 1e-3
"""Share of the heaviest alignment below which one is not followed."""
LIGHTEST, ENOUGH = 1e-9, 100.0
"""The least such share, and how many times that has to be left of all."""
MOST_PLACES = 25
"""Of a segment."""
MOST_ALIGNMENTS = 2000
"""Stretches that are followed at a time, over all alignments."""
POINTED_AT = math.radians(50)
"""A way that differs less from where a sign points is meant by it."""
LEGS_LEFT_OUT = 2
"""Turns told in a row that there may not be."""


@dataclass
class Belief:
    """All alignments of a plan with a map, summed where they meet."""

    plan: RoutePlan
    floor: FloorMap
    model: Likelihoods
    things: Things
    telling: int = 0
    """Number of the telling that the plan was read in."""
    pointers: dict[int, list[float]] = field(default_factory=dict[int, list[float]])
    """Headings in which signs point to the destination, by crossing."""
    frontiers: dict[tuple[int, int], Frontier] = field(
        default_factory=dict[tuple[int, int], Frontier]
    )
    visits: list[Visit] = field(default_factory=list[Visit])
    start: int = 0
    """Crossing where the walk began."""

    def __post_init__(self) -> None:
        """Hold what was said of the legs together."""
        self._said = SaidOfLegs(self.plan, self.model, self.things)
        self._untold = self.model.way_untold if self.plan.tells_place_alone else 0.0

    def update(self, starts: list[AssumedStart]) -> None:
        """Sum all alignments anew, from all ways to begin.

        Where there are too many, those that weigh least are left out; where those that
        weighed most have come to nothing, lighter ones are followed.
        """
        least = LEAST_WEIGHT
        self.start = starts[0].at
        self.things.forget()
        while self._sum_up(starts, least):
            if self._knows_all_ways():
                break
            left = sum(each.mass for each in self.frontiers.values())
            if left > self._heaviest * least * ENOUGH or least <= LIGHTEST:
                break
            least /= 100
        else:
            while not self._sum_up(starts, least):
                least *= 10
        self._add_lost(sum(each.chance for each in starts))

    def _sum_up(self, starts: list[AssumedStart], least: float) -> bool:
        """Sum the alignments that weigh so much; False where there are too many."""
        self._least, self._followed = least, 0
        self.frontiers.clear()
        self.visits.clear()
        self._heaviest = 0.0
        self._choices = KnownChoices(self.floor)
        legs = len(self.plan.legs)
        self._levels: list[dict[tuple[int, int], list[Segment]]] = [
            {} for _ in range(legs + 1)
        ]
        speakers = self.model.speakers
        for at, heading, exit, chance, walked in starts:
            weights = speakers * (chance * (1 - self._untold))
            slips: tuple[Slip, ...] = ()
            place = self.floor.crossings[at].place
            if chance <= self.model.wrong_start + 1e-9 and len(starts) > 1:
                weights = weights[::-1].copy()
                slips = (Slip("wrong start", 0, at),)
            start = Segment(
                at,
                heading,
                0,
                weights,
                walked,
                line=(place,),
                slips=slips,
                telling=self.telling,
            )
            if exit < 0:
                self._come_to(start)
            else:
                self._leave(start, exit)
        for level in range(legs + 1):
            for (_, exit), segments in self._levels[level].items():
                for segment in summed(segments):
                    self._leave(segment, exit)
                    if self._followed > MOST_ALIGNMENTS:
                        return False
        return True

    def _knows_all_ways(self) -> bool:
        """Tell whether there is no way left that a lighter alignment could lead to."""
        return all(way in self.floor.stretches for way in self.floor.ways_out())

    def _add_lost(self, chance: float) -> None:
        """Believe that any way may do: a little, since all that was told may be wrong.

        And mostly so where no way was told, but the place alone.
        """
        halls, legs = [*self._choices.halls()], len(self.plan.legs)
        share = self.model.speakers[0] * chance / max(sum(map(len, halls)), 1)
        weights = np.stack([share * self._untold, share * self.model.lost])
        story = "no way was told" if self._untold else "nothing that was told fits"
        for hall in halls:
            at, exit = hall[0]
            crossing = self.floor.crossings[at]
            segment = Segment(
                at,
                crossing.exits[exit],
                legs,
                weights,
                line=(crossing.place,),
                story=(story,),
                slips=() if self._untold else (Slip("lost", legs, at),),
                lost=True,
                telling=self.telling,
            )
            for _, exit in hall:
                stretch = self.floor.stretches.get((segment.at, exit))
                if stretch is None:
                    self._reach(segment, exit, self._said.to_come(segment, exit))
                    continue
                self.visits.append(Visit(segment, stretch))
                segment = self._after(segment, stretch)
                # Where all that was told may be wrong, seeing the place alone tells it.
                if self._untold:
                    self.visits.append(Visit(segment, None))

    def _reach(self, segment: Segment, exit: int, weights: Weights) -> None:
        """Let an alignment lead into a way that was not walked yet."""
        key = segment.at, exit
        self.frontiers.setdefault(key, Frontier(*key)).add(segment, weights)

    # -- one alignment

    def _leave(self, segment: Segment, exit: int) -> None:
        """Follow a way out as far as the map goes."""
        mass = mass_of(segment.weights)
        if mass < self._least * self._heaviest:
            return
        self._heaviest = max(self._heaviest, mass)
        stretch = self.floor.stretches.get((segment.at, exit))
        if stretch is None:
            if exit not in self.floor.crossings[segment.at].closed:
                self._reach(segment, exit, self._said.to_come(segment, exit))
            return
        self._followed += 1
        if segment.places >= MOST_PLACES or self._followed > MOST_ALIGNMENTS:
            return
        # Nobody goes in a circle without telling of a turn.
        if stretch.end in segment.passed:
            return
        if segment.leg == len(self.plan.legs):
            self.visits.append(Visit(segment, stretch))
        self._come_to(self._after(segment, stretch))

    def _after(self, segment: Segment, stretch: Stretch) -> Segment:
        asked = (
            stretch.asked if segment.asked is None else segment.asked & stretch.asked
        )
        return segment._replace(
            at=stretch.end,
            heading=stretch.arrival,
            walked=segment.walked + stretch.length,
            line=(*segment.line, self.floor.crossings[stretch.end].place),
            asked=asked,
            passed=(*segment.passed, stretch.end),
        )

    def _come_to(self, segment: Segment) -> None:
        """Branch at a crossing into what the speaker may have meant there."""
        choices = self._choices[segment.at, segment.heading]
        if segment.leg == len(self.plan.legs):
            self.visits.append(Visit(segment, None))
        self._turn(segment, choices)
        self._go_on(segment, choices)

    # -- going on without a word

    def _go_on(self, segment: Segment, choices: Choices) -> None:
        model = self.model
        ahead = choices.forward
        junction = len(choices.ways) > 1
        left, right = bool(choices.on("left")), bool(choices.on("right"))
        # Nobody counts the junction where they stand.
        counts = junction and segment.walked > 0
        passed = segment._replace(
            left=segment.left + left,
            right=segment.right + right,
            junctions=segment.junctions + counts,
            openings=(*segment.openings, (segment.places, left, right, counts)),
        )
        for index, angle in choices.ways:
            base = self._by_signs(segment, index, choices)
            if ahead is not None and index == ahead[0]:
                chance = model.pass_untold if junction else 1.0
                chance *= untold_bend(model, angle)
                if self._said.plain_turn_fits(segment, choices):
                    chance = model.pass_fitting
                self._leave(passed._replace(weights=base * chance), index)
            elif not junction:
                bend = abs(angle) <= SLIGHT
                chance = untold_bend(model, angle) if bend else model.corner_untold
                self._leave(passed._replace(weights=base * chance), index)
            else:
                chance = model.choice_untold if ahead is None else model.turn_untold
                if ahead is None and self._tells_side(segment, angle):
                    chance = 0.5
                    weights = base * chance
                    self._leave(passed._replace(weights=weights), index)
                    continue
                weights = then(base, 0.0, chance, model.again)
                if self._is_light(weights):
                    continue
                slip = Slip("turn left out", segment.leg, segment.at)
                erred = passed._replace(
                    weights=weights,
                    slips=(*segment.slips, slip),
                    story=(*segment.story, f"a turn at {segment.at} nobody told of"),
                )
                self._leave(erred, index)

    def _tells_side(self, segment: Segment, angle: float) -> bool:
        """`The glass door is on the right` may mean to turn right at the end."""
        side = self.plan.arrival.side
        if segment.leg < len(self.plan.legs) or side not in {"left", "right"}:
            return False
        return (angle > 0) == (side == "left")

    # -- turns told

    def _turn(self, segment: Segment, choices: Choices) -> None:
        model = self.model
        weights = segment.weights
        story, slips = segment.story, segment.slips
        lead = 0.0
        last = min(segment.leg + LEGS_LEFT_OUT + 1, len(self.plan.legs))
        for number in range(segment.leg, last):
            if number > segment.leg and self._is_light(weights):
                return
            leg = self.plan.legs[number]
            doubt = leg.unclear
            meant = weights * (1 - doubt) if doubt else weights
            here = self._said.at_place(segment, number, meant, lead, choices)
            if not self._is_light(here):
                base = segment._replace(weights=here, story=story, slips=slips)
                self._take(base, number, choices)
            easy = (
                leg.turn.forced
                or leg.turn.way.startswith("slight")
                or faces(self.plan, number)
            )
            if easy:
                weights = weights * (doubt + (1 - doubt) * model.no_bend)
            else:
                weights = without_turn(model, weights, leg)
                if doubt < model.no_turn:
                    slips = (*slips, Slip("no such turn", number, segment.at))
                story = (*story, f"no turn {number + 1}")
            length = length_of(leg)
            lead += length.metres if length is not None else 0.0
        else:
            # The last turns told may not be there: arrive on the way that one is on.
            if last == len(self.plan.legs) and segment.leg < last:
                self._skip_to_arrival(segment, weights, story, slips, choices)

    def _skip_to_arrival(
        self,
        segment: Segment,
        weights: Weights,
        story: tuple[str, ...],
        slips: tuple[Slip, ...],
        choices: Choices,
    ) -> None:
        ahead = choices.forward
        weights = weights * self.model.pass_untold
        if ahead is None or not segment.walked or self._is_light(weights):
            return
        legs = len(self.plan.legs)
        self._add(
            segment._replace(leg=legs, weights=weights, story=story, slips=slips),
            ahead[0],
        )

    def _take(self, segment: Segment, number: int, choices: Choices) -> None:
        """Take the ways out that a turn told may mean."""
        leg = self.plan.legs[number]
        looks = faces(self.plan, number)
        around = leg.turn.way == "around"
        anew = looks or around
        wrong_side = self.model.wrong_side if number else self.model.wrong_first_side
        ways = choices.ways
        if anew:
            ways = [
                (index, wrap_angle(each - segment.heading))
                for index, each in self.floor.crossings[segment.at].open_exits()
            ]
        for index, angle in ways:
            fine, wrong = way_ratio(leg.turn, angle), 0.0
            if looks:
                fine = 1.0
            elif around:
                fine = 1.5 if abs(angle) > BACK else 0.0
            elif not fine:
                wrong = wrong_side * (1.0 if abs(angle) > 0.26 else 0.5)
            fine *= self.things.outlook_ratio(segment.at, index, number + 1)
            signs = self._by_signs(segment, index, choices)
            weights = then(signs, fine, wrong, self.model.again)
            if self._is_light(weights):
                continue
            story = (*segment.story, f"turn {number + 1} at {segment.at}")
            slips = segment.slips
            if not fine:
                slips = (*slips, Slip("wrong side", number, segment.at))
                story = (*story, "to the other side")
            done = Segment(
                segment.at,
                wrap_angle(segment.heading + angle),
                number + 1,
                weights,
                line=(self.floor.crossings[segment.at].place,),
                story=story,
                slips=slips,
                turns=(*segment.turns, (number, segment.at)),
                telling=self.telling,
            )
            self._add(done, index)
            following = self._said.leg_of(done)
            if anew and following is not None and following.on_the_spot:
                # Turns on one spot lead to others there, each way as often.
                self._followed += 1
                if self._followed > MOST_ALIGNMENTS:
                    return
                self._turn(done, self._choices[segment.at, done.heading])

    def _by_signs(self, segment: Segment, exit: int, choices: Choices) -> Weights:
        """Weigh a way out against the signs that point to the destination there."""
        headings = self.pointers.get(segment.at)
        if not headings:
            return segment.weights
        out = self.floor.crossings[segment.at].exits[exit]
        ways, right = len(choices.ways), self.model.sign_right
        ratio = 1.0
        for heading in headings:
            if abs(wrap_angle(out - heading)) <= POINTED_AT:
                ratio *= max(ways, 2) * right
            else:
                ratio *= max(ways, 2) * (1 - right) / max(ways - 1, 1)
        return segment.weights * ratio

    def _add(self, segment: Segment, exit: int) -> None:
        level = self._levels[segment.leg]
        level.setdefault((segment.at, exit), []).append(segment)

    def _is_light(self, weights: Weights) -> bool:
        return mass_of(weights) < self._least * self._heaviest
