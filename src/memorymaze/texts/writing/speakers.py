"""Speakers who tell a way as a plan, with no words in between.

What is true of a route (`StepPlan`) becomes what one speaker would make of it: some of it
is left out, lengths are too long or too short, things go by other names or were never
there. Plans told so are made by a program and are no data of people.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from memorymaze.language.nouns import kin_of
from memorymaze.language.plans import (
    SECOND_METRES,
    STEP_METRES,
    Arrival,
    Leg,
    Length,
    Mention,
    Passing,
    RoutePlan,
    Unit,
)
from memorymaze.texts.writing.asides import rounded_as_told
from memorymaze.texts.writing.phrases import phrases
from memorymaze.texts.writing.steps import Step, StepPlan, ToldStretch

UNITS: tuple[tuple[Unit, float], ...] = (
    ("metres", 0.62),
    ("steps", 0.16),
    ("time", 0.1),
    ("vague", 0.12),
)
"""How often speakers count in what."""
VAGUE = (4.0, 6.0, 12.0, 25.0)
"""Metres of `a few steps`, `short`, `a while`, `long` in the plan language."""


@dataclass(frozen=True, slots=True)
class Speaker:
    """How one speaker tells ways; shares from 0 to 1."""

    lengths: float
    """Of the stretches whose length is told."""
    unit: Unit
    factor: float
    """By which all lengths said are too long."""
    noise: float
    """Standard deviation of the logarithm of a length, beside the factor."""
    things: float
    """Of the things beside the way that are told."""
    sides: float
    """Of the things told, those of which the side is told."""
    wrong_sides: float
    """Of these, those told on the other side."""
    kin: float
    """Of the names of things, those that are replaced by a related word."""
    invented: float
    """Of the stretches on which a thing is told that is not there."""
    passings: float
    """Of the stretches with openings, those where they are told."""
    floors: float
    names: float
    """Of the stretches whose floor, or name, is told."""
    beyond: float
    """Of the turns of which it is told what lies beyond them."""
    first: float
    """Of the turns at the first opening, those that are said to be the first."""
    goal_seen: float
    """How often the destination is told by what is there, not by what it is called."""


EXACT = Speaker(
    lengths=0.5,
    unit="metres",
    factor=1.0,
    noise=0.05,
    things=0.3,
    sides=0.5,
    wrong_sides=0.0,
    kin=0.0,
    invented=0.0,
    passings=0.3,
    floors=0.2,
    names=0.2,
    beyond=0.2,
    first=0.5,
    goal_seen=0.0,
)
"""Who leaves out, but says nothing that is not so."""


def draw_speaker(rng: np.random.Generator) -> Speaker:
    """Make up somebody who names, counts and measures as people do."""
    units, shares = zip(*UNITS, strict=True)
    return Speaker(
        lengths=float(rng.choice((0.0, 0.3, 0.6, 0.9))),
        unit=units[int(rng.choice(len(units), p=shares))],
        factor=math.exp(rng.normal(0.0, 0.25)),
        noise=0.2,
        things=float(rng.choice((0.1, 0.25, 0.5))),
        sides=float(rng.uniform(0.2, 0.9)),
        wrong_sides=float(rng.choice((0.0, 0.0, 0.1))),
        kin=float(rng.choice((0.0, 0.15, 0.3))),
        invented=float(rng.choice((0.0, 0.05, 0.1))),
        passings=float(rng.choice((0.0, 0.2, 0.5))),
        floors=float(rng.choice((0.0, 0.0, 0.3))),
        names=float(rng.choice((0.0, 0.3))),
        beyond=float(rng.choice((0.0, 0.2))),
        first=float(rng.choice((0.1, 0.6))),
        goal_seen=0.15,
    )


def tell_plan(plan: StepPlan, speaker: Speaker, rng: np.random.Generator) -> RoutePlan:
    """Return what a speaker says of a way; the turns and their cues stay as they are."""
    teller = _PlanTeller(speaker, rng)
    true = plan.said
    steps = [step for step in plan.turns if step.told]
    first = len(true.legs) - len(steps)
    legs = [
        leg if number < first else teller.leg(leg, steps[number - first])
        for number, leg in enumerate(true.legs)
    ]
    return RoutePlan(legs=tuple(legs), arrival=teller.arrival(plan))


class _PlanTeller:
    def __init__(self, speaker: Speaker, rng: np.random.Generator) -> None:
        self._speaker = speaker
        self._rng = rng

    def _does(self, share: float) -> bool:
        return bool(self._rng.random() < share)

    def leg(self, true: Leg, step: Step) -> Leg:
        """Tell a turn and the stretch before it."""
        turn = true.turn
        if turn.ordinal == 1 and not self._does(self._speaker.first):
            turn = replace(turn, ordinal=None)
        marks = [self._named(each) for each in true.mentions if each.place == "turn"]
        return Leg(
            turn,
            length=self._length(step.stretch.length),
            mentions=(*self._on_the_way(step.stretch), *marks),
            passings=self._passings(step.stretch),
            too_far=true.too_far if self._does(self._speaker.beyond) else (),
        )

    def arrival(self, plan: StepPlan) -> Arrival:
        """Tell the last stretch and the destination."""
        true, stretch = plan.ending.arrival, plan.ending.stretch
        goal = true.destinations[0]
        beside = [
            self._named(each)
            for each in true.mentions
            if each.place == "beside" and self._does(self._speaker.things)
        ]
        told = replace(
            true,
            destinations=(self._kin(goal),),
            side=true.side if self._does(0.7) else None,
            length=self._length(stretch.length),
            mentions=(*self._on_the_way(stretch), *beside),
            passings=self._passings(stretch),
        )
        if plan.ending.by is not None and self._does(self._speaker.goal_seen):
            seen = self._kin(plan.ending.by.words)
            return replace(told, destinations=(seen,), nth=None)
        return told

    def _on_the_way(self, stretch: ToldStretch) -> Iterator[Mention]:
        speaker, rng = self._speaker, self._rng
        other = {"left": "right", "right": "left"}
        for each in stretch.mentions:
            share = {"floor": speaker.floors, "place": speaker.names}
            if not self._does(share.get(each.kind, speaker.things)):
                continue
            if each.place == "along":
                yield each
                continue
            side = each.side if self._does(speaker.sides) else None
            if side is not None and self._does(speaker.wrong_sides):
                side = other[side]
            yield replace(self._named(each), side=side, after_metres=None)
        if self._does(speaker.invented):
            words = phrases("not_there")
            yield Mention(words[int(rng.integers(len(words)))], place="along")

    def _passings(self, stretch: ToldStretch) -> tuple[Passing, ...]:
        if not stretch.openings or not self._does(self._speaker.passings):
            return ()
        sides = dict.fromkeys(stretch.openings)
        return tuple(
            Passing(stretch.openings.count(side), side, "opening") for side in sides
        )

    def _length(self, metres: float) -> Length | None:
        speaker = self._speaker
        if metres < 2.0 or not self._does(speaker.lengths):
            return None
        felt = metres * speaker.factor
        felt *= math.exp(self._rng.normal(0.0, speaker.noise))
        if speaker.unit == "vague":
            said = min(VAGUE, key=lambda each: abs(math.log(each / felt)))
            return Length(said, "vague")
        per = {"steps": STEP_METRES, "time": SECOND_METRES}.get(speaker.unit, 1.0)
        told = float(rounded_as_told(felt / per))
        return Length(told * per, speaker.unit, count=told if per != 1.0 else None)

    def _named(self, mention: Mention) -> Mention:
        return replace(mention, phrase=self._kin(mention.phrase))

    def _kin(self, words: str) -> str:
        """Return another word for a thing, for some of the things of some speakers."""
        if not self._does(self._speaker.kin) or " that says " in words:
            return words
        thing, *where = re.split(r"(?= (?:at|by|in|of|on|with) )", words, maxsplit=1)
        *before, noun = thing.split(" ")
        related = kin_of(noun) if noun.islower() else ()
        if not related:
            return words
        other = related[int(self._rng.integers(len(related)))]
        return "".join([" ".join([*before, other]), *where])
