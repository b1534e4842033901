"""Make a right plan wrong in one known way: a wrong turn, place or destination.

Every proposal is walked: only those that no longer arrive are errors.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from memorymaze.texts.writing.phrases import phrases
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.steps import (
    SIDES,
    Beside,
    Cue,
    Mistake,
    Step,
    StepPlan,
    ToldEnding,
    ToldStretch,
)
from memorymaze.texts.writing.things import with_article
from memorymaze.texts.writing.turning_point_graph import TurnSide

OPPOSITE: Mapping[TurnSide, TurnSide] = {
    "left": "right",
    "right": "left",
    "slight_left": "slight_right",
    "slight_right": "slight_left",
}
GOING_ON = 4.0
"""Metres between a destination and a place that is taken for it."""
TRIES = 40
"""Proposals that are walked, at most."""


def possible_mistakes(
    facts: RouteFacts, plan: StepPlan, kind: str, rng: np.random.Generator
) -> Iterator[Mistake]:
    """Yield the errors of a kind from `ERROR_KINDS` that a plan can have.

    They come in random order. The plan is right, or wrong in other steps.
    """
    proposals = list(PROPOSALS[kind](_Proposals(facts, plan, kind, rng)))
    for number in rng.permutation(len(proposals))[:TRIES]:
        if facts.is_wrong(proposals[number].plan):
            yield proposals[number]


def made_wrong(
    facts: RouteFacts,
    plan: StepPlan,
    kinds: tuple[str, ...],
    rng: np.random.Generator,
) -> tuple[Mistake, ...]:
    """Put errors of several kinds into a plan, each into a step of its own.

    The last one's plan has all of them. A kind for which the plan has no room is left
    out.
    """
    done: list[Mistake] = []
    for kind in kinds:
        taken = {mistake.key for mistake in done}
        for mistake in possible_mistakes(facts, plan, kind, rng):
            if mistake.key not in taken and (not done or _is_one_alone(facts, mistake)):
                done.append(mistake)
                plan = mistake.plan
                break
    return tuple(done)


def _is_one_alone(facts: RouteFacts, mistake: Mistake) -> bool:
    """Tell whether an error would be one without those made before it."""
    rng = np.random.default_rng(0)
    again = _Proposals(facts, facts.plan, mistake.kind, rng)
    return any(
        each.key == mistake.key and facts.is_wrong(each.plan)
        for each in PROPOSALS[mistake.kind](again)
    )


@dataclass(frozen=True, slots=True)
class _Proposals:
    """What may be said wrongly of a route; not all of it leads astray."""

    facts: RouteFacts
    plan: StepPlan
    kind: str
    rng: np.random.Generator

    @property
    def told(self) -> list[Step]:
        return [turn for turn in self.plan.turns if turn.told]

    def mistake(
        self, key: str, part: str, where: str, detail: str, plan: StepPlan
    ) -> Mistake:
        return Mistake(self.kind, key, part, where, detail, plan)

    # -- sides

    def wrong_sides(self) -> Iterator[Mistake]:
        """Yield told turns with the other side."""
        return map(self.flipped, self.turns_with_choice())

    def turns_with_choice(self) -> list[Step]:
        """Return the told turns where one could go wrong; all where none is such.

        Whoever comes to a corner without a choice turns there, whatever is said.
        """
        told = [turn for turn in self.told if not turn.extra]
        return [turn for turn in told if self.has_choice(turn)] or told

    def has_choice(self, turn: Step) -> bool:
        heading = self.facts.headings.get(turn.at)
        if heading is None:
            return False
        return self.facts.graph.only_way(turn.at, heading) is None

    def flipped(self, turn: Step) -> Mistake:
        said = OPPOSITE[turn.side]
        detail = f"says {_plain(said)}; the way goes {_plain(turn.side)}"
        plan = self.plan.with_turn(turn.key, side=said)
        return self.mistake(turn.key, "side", turn.at, detail, plan)

    def wrong_starts(self) -> Iterator[Mistake]:
        """Yield what sends the listener off the wrong way."""
        if not self.plan.around:
            detail = "tells to turn around first; the way goes ahead"
            plan = replace(self.plan, around=True)
            yield self.mistake("start", "step", "start", detail, plan)
        first = next(iter(self.told), None)
        if first is not None and first.stretch.length < 15 and not first.extra:
            yield self.flipped(first)

    # -- turns too few, too many, or elsewhere

    def missing_turns(self) -> Iterator[Mistake]:
        """Yield every told turn left out, apart from corners without a choice."""
        for turn in self.told:
            if turn.cue.kind != "forced" and not turn.extra:
                detail = f"leaves out the turn {_plain(turn.side)}"
                plan = self.plan.without(turn.key)
                yield self.mistake(turn.key, "gone", turn.at, detail, plan)

    def extra_turns(self) -> Iterator[Mistake]:
        """Yield turns where the route goes straight on; without openings, anywhere."""
        openings = self.turns_at_openings()
        found = [each for each in openings if self.facts.is_wrong(each.plan)]
        yield from found or self.turns_nowhere()

    def turns_at_openings(self) -> Iterator[Mistake]:
        facts, plan = self.facts, self.plan
        route_turns = {turn.at: n for n, turn in enumerate(facts.route.turns)}
        for n, points in enumerate(facts.between):
            place = next(
                (
                    place
                    for place, turn in enumerate(plan.turns)
                    if not turn.extra and route_turns.get(turn.at, -1) >= n
                ),
                len(plan.turns),
            )
            for point in points:
                heading = facts.headings.get(point)
                if heading is None or point in route_turns:
                    continue
                for side in SIDES:
                    if facts.graph.leaving(point, heading, side) is not None:
                        yield from self.turns_at(place, point, side)

    def turns_at(self, place: int, point: str, side: TurnSide) -> Iterator[Mistake]:
        """Yield a turn that can be made at a point, with a cue that leads there."""
        facts, plan = self.facts, self.plan
        here = facts.graph.points[point].polygon.centroid.coords[0]
        near = [
            Cue("thing", words=each.words)
            for each in facts.graph.things
            if each.words in facts.graph.marks[point]
            and math.dist(each.position, here) < 6
        ]
        told = sum(each.told for each in plan.turns[:place])
        for cue in (*(Cue("ordinal", n) for n in (1, 2, 3)), *near[:3]):
            key = f"extra_{point}_{side}"
            turn = Step(key, side, cue, ToldStretch(0.0), point, extra=True)
            wrong = plan.with_another(turn, place)
            if facts.follow(wrong).turned[told : told + 1] == (point,):
                detail = f"adds a turn {side}; the way goes straight on there"
                yield self.mistake(key, "step", point, detail, wrong)

    def turns_nowhere(self) -> Iterator[Mistake]:
        """Yield turns where no way lies, for routes that pass no opening."""
        for place in range(len(self.plan.turns) + 1):
            side = SIDES[int(self.rng.choice(2))]
            at = f"after {self.plan.turns[place - 1].at}" if place else "start"
            key = f"extra_{place}"
            turn = Step(key, side, Cue("ordinal"), ToldStretch(0.0), at, extra=True)
            detail = f"adds a turn {side} that the way does not have"
            wrong = self.plan.with_another(turn, place)
            yield self.mistake(key, "step", at, detail, wrong)

    def wrong_points(self) -> Iterator[Mistake]:
        """Yield turns at another opening on the same side than the right one."""
        right = self.facts.follow(self.plan).turned
        for n, turn in enumerate(self.told):
            slight = turn.side.startswith("slight")
            if turn.extra or slight or not self.has_choice(turn):
                continue
            for ordinal in (1, 2, 3):
                cue = Cue("ordinal", ordinal)
                wrong = self.plan.with_turn(turn.key, cue=cue)
                made = self.facts.follow(wrong).turned
                if cue == turn.cue or len(made) <= n or made[: n + 1] == right[: n + 1]:
                    continue
                detail = (
                    f"says to turn {turn.side} at {made[n]}; the way turns at {turn.at}"
                )
                yield self.mistake(turn.key, "cue", turn.at, detail, wrong)

    # -- destinations and things

    def wrong_destinations(self) -> Iterator[Mistake]:
        """Yield ends at other things, on the last stretch or one or two turns before."""
        goal, last = self.facts.route.goal_landmark, self.plan.ending
        for each in last.stretch.beside:
            off = math.dist(each.thing.position, last.place)
            if off > GOING_ON and each.thing.id != goal:
                yield self.ends_at(self.plan, each, last.stretch)
        turns = self.told
        for cut in (1, 2):
            gone = turns[-cut:]
            if len(turns) < cut or any(turn.extra for turn in gone):
                return
            kept = self.plan.turns[: self.plan.turns.index(gone[0])]
            shorter = replace(self.plan, turns=kept)
            for each in gone[0].stretch.beside[-4:]:
                if each.thing.id != goal:
                    yield self.ends_at(shorter, each, gone[0].stretch)

    def ends_at(self, plan: StepPlan, beside: Beside, stretch: ToldStretch) -> Mistake:
        thing, goal = beside.thing, plan.ending.goal
        claimed = with_article(thing, definite=True)
        ending = ToldEnding(
            goal, thing.position, stretch, beside.side, thing, claimed=claimed
        )
        detail = f"ends at {claimed} and takes it for {goal}"
        wrong = replace(plan, ending=ending)
        return self.mistake("arrival", "step", thing.id, detail, wrong)

    def things_not_there(self) -> Iterator[Mistake]:
        """Yield turns that hang on a thing the floor does not have."""
        here = {thing.words for thing in self.facts.graph.things}
        words = [
            each
            for each in phrases("not_there")
            if not any(each.split()[-1] in known for known in here)
        ]
        for turn in self.turns_with_choice():
            thing = str(self.rng.choice(words))
            detail = (
                f"makes the turn {_plain(turn.side)} hang on a {thing}; there is none"
            )
            wrong = self.plan.with_turn(turn.key, cue=Cue("thing", words=thing))
            yield self.mistake(turn.key, "cue", turn.at, detail, wrong)
        if not self.plan.turns:
            for each in self.plan.ending.stretch.beside[:1]:
                thing = str(self.rng.choice(words))
                key, cue = "extra_thing", Cue("thing", words=thing)
                turn = Step(
                    key, each.side, cue, ToldStretch(0.0), "the way", extra=True
                )
                detail = f"tells of a {thing} and a turn there; there is neither"
                wrong = self.plan.with_another(turn, 0)
                yield self.mistake(key, "step", "the way", detail, wrong)


def _plain(side: TurnSide) -> str:
    return side.replace("_", " ")


PROPOSALS: Mapping[str, Callable[[_Proposals], Iterator[Mistake]]] = {
    "wrong_direction": _Proposals.wrong_sides,
    "wrong_turning_point": _Proposals.wrong_points,
    "extra_turn": _Proposals.extra_turns,
    "incorrect_direction": _Proposals.wrong_starts,
    "wrong_destination": _Proposals.wrong_destinations,
    "missing_turn": _Proposals.missing_turns,
    "wrong_direction_at_turn": _Proposals.wrong_sides,
    "inaccurate_environment": _Proposals.things_not_there,
}
