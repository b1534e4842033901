"""What was said of a leg, weighed against where its turn may be and how far it may go on."""

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from memorymaze.agents.guide.alignments import Segment
from memorymaze.agents.guide.likelihoods import (
    Likelihoods,
    Weights,
    junction_ratio,
    length_ratio,
    length_to_come,
    ordinal_ratio,
    ordinal_to_come,
    passings_ratio,
    untold_length,
)
from memorymaze.agents.guide.things import Things
from memorymaze.agents.walking.choices import Choices
from memorymaze.agents.walking.outlooks import length_of
from memorymaze.language.plans import Leg, Length, RoutePlan

BESIDE_THING = 1.5
"""Metres within which a place is beside a thing, and not after it."""


class Counted(NamedTuple):
    """What was come to on a stretch, since its beginning or since a thing on it."""

    metres: float
    places: int
    """Where one can turn, the present one included."""
    left: int
    """Openings passed, the present one left out."""
    right: int
    junctions: int


@dataclass(frozen=True, slots=True)
class SaidOfLegs:
    """Lengths, counts, junctions and things that were said of the legs of a plan."""

    plan: RoutePlan
    model: Likelihoods
    things: Things

    def leg_of(self, segment: Segment) -> Leg | None:
        """Return the leg that a segment is in; None on the way to the destination."""
        legs = self.plan.legs
        return legs[segment.leg] if segment.leg < len(legs) else None

    def plain_turn_fits(self, segment: Segment, choices: Choices) -> bool:
        """Tell whether a turn about which nothing else was said could be here."""
        leg = self.leg_of(segment)
        if leg is None or leg.turn.way not in {"left", "right"}:
            return False
        turn = leg.turn
        if turn.ordinal is not None or turn.at_end or turn.junction or turn.forced:
            return False
        if leg.length is not None and leg.length.unit != "vague":
            return False
        if leg.passings or self.things.awaited(segment.leg, segment.line, segment.at):
            return False
        return bool(choices.on(turn.way))

    def at_place(
        self,
        segment: Segment,
        number: int,
        weights: Weights,
        lead: float,
        choices: Choices,
    ) -> Weights:
        """Weigh all that was said of where a turn is against a crossing."""
        model = self.model
        leg = self.plan.legs[number]
        turn = leg.turn
        junction = len(choices.ways) > 1
        fine: float | Weights = junction_ratio(model, turn, choices)
        since = counted_since(self.things, segment, turn.counted_after)
        if since is not None:
            on_side = _on_side(since, leg) + 1
            fine = fine * ordinal_ratio(
                model, turn, on_side, since.junctions + junction, choices
            )
        fine = fine * passings_ratio(
            model, leg.passings, segment.left, segment.right, segment.junctions
        )
        length = _with_lead(length_of(leg), lead)
        if length is not None and segment.walked:
            since = counted_since(self.things, segment, length.after)
            if since is not None:
                # Who counts junctions alone does not end at a place that is none.
                counts = junction and since.places > 0
                of_all = since.junctions + 1 if counts else since.places
                fine = fine * length_ratio(
                    model, length, since.metres, since.places, of_all
                )
        elif length is None:
            fine = fine * untold_length(model, segment.walked)
        if not leg.on_the_spot and not segment.walked:
            fine = fine * 0.13
        right = self.things.weigh(
            weights * fine,
            number,
            segment.line,
            segment.asked or frozenset(),
            segment.line[-1],
            segment.at,
        )
        return self._or_elsewhere(weights, right)

    def _or_elsewhere(self, weights: Weights, right: Weights) -> Weights:
        """Weigh that all is right that is said of where to turn, or all wrong."""
        wrong = self.model.wrong_place
        after = (1 - wrong) * right
        after[1] += wrong * (weights[0] + self.model.again * weights[1])
        return after

    def to_come(self, segment: Segment, exit: int) -> Weights:
        """Weigh what was said of the present leg against its going on beyond here."""
        leg = self.leg_of(segment)
        ahead = self.things.ahead(segment.leg, segment.line, segment.at, exit)
        so_far = self.things.so_far(segment.leg, segment.line)
        weights = segment.weights * ahead * so_far
        if leg is None:
            length = self.plan.arrival.length
            if length is None:
                return weights * untold_length(self.model, segment.walked)
            return weights * rest_to_come(self.model, self.things, segment, length)
        ratio = np.ones(weights.shape[1])
        length = length_of(leg)
        if length is None:
            ratio = ratio * untold_length(self.model, segment.walked)
        else:
            ratio = ratio * rest_to_come(self.model, self.things, segment, length)
        since = counted_since(self.things, segment, leg.turn.counted_after)
        if since is not None:
            ratio = ratio * ordinal_to_come(
                self.model, leg.turn, _on_side(since, leg), since.junctions
            )
        passings = passings_ratio(
            self.model,
            leg.passings,
            segment.left,
            segment.right,
            segment.junctions,
            going_on=True,
        )
        ratio = ratio * min(passings, 1.0)
        return self._or_elsewhere(weights, weights * ratio)


def rest_to_come(
    model: Likelihoods, things: Things, segment: Segment, length: Length
) -> Weights:
    """Weigh a length said where the stretch goes on beyond here."""
    since = counted_since(things, segment, length.after)
    if since is None:
        return np.ones(segment.weights.shape[1])
    return length_to_come(model, length, since.metres, since.places)


def counted_since(
    things: Things, segment: Segment, after: str | None
) -> Counted | None:
    """Count since a thing on a stretch; None where it was not met yet."""
    if after is None:
        return _since_the_beginning(segment)
    passed = things.passed_at(after, segment.line)
    if passed is None:
        return None
    reached = [0.0]
    for start, end in pairwise(segment.line):
        reached.append(reached[-1] + math.dist(start, end))
    beyond = [metres > passed + BESIDE_THING for metres in reached]
    met = [openings[1:] for openings in segment.openings if beyond[openings[0]]]
    left, right, junctions = map(sum, zip(*met, strict=True)) if met else (0, 0, 0)
    return Counted(reached[-1] - passed, sum(beyond[1:]), left, right, junctions)


def _since_the_beginning(segment: Segment) -> Counted:
    return Counted(
        segment.walked,
        segment.places,
        segment.left,
        segment.right,
        segment.junctions,
    )


def _on_side(counted: Counted, leg: Leg) -> int:
    way = leg.turn.way
    if way.endswith("left"):
        return counted.left
    return counted.right if way.endswith("right") else counted.junctions


def _with_lead(length: Length | None, lead: float) -> Length | None:
    """Add the length of legs that were left out."""
    if length is None or not lead or length.unit == "places":
        return length
    return replace(length, metres=length.metres + lead)
