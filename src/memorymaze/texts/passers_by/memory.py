"""What one passer-by remembers of what is true, and how it comes out in words.

Errors are made in what is told, never in the words: these come from the bank alone.
"""

import hashlib
import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from shapely import Point

from memorymaze.basics.geometry.pose import Pose
from memorymaze.language.models.model import Completion
from memorymaze.robot.api.asking import Question
from memorymaze.texts.corpus.error_kinds import kinds_of
from memorymaze.texts.passers_by.bank import Bank
from memorymaze.texts.passers_by.bank_records import (
    Reply,
    StartSide,
    TurnFact,
    WayFacts,
)
from memorymaze.texts.passers_by.knowledge import (
    FURTHER_ON,
    FloorKnowledge,
    NamedPlace,
    WayThere,
)
from memorymaze.texts.writing.mistakes import possible_mistakes
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.steps import Step, StepPlan
from memorymaze.texts.writing.things import thing_called, with_article

Truth = Literal["right", "wrong", "unknown"]
"""What is known of an answer."""

NOT_KNOWN = 0.1
"""Share of questions to which a person says that they do not know."""
PLAINEST = 0.5
"""Share of turns told by their plainest cue, where there are others."""
BEYOND = 3.0
"""Metres of floor beyond a destination without which the way ends there."""

_OPPOSITE: dict[StartSide, StartSide] = {
    "ahead": "back",
    "back": "ahead",
    "left": "right",
    "right": "left",
}


@dataclass(frozen=True, slots=True)
class AnswerWithTruth:
    """An answer, and what is true of it."""

    words: str
    truth: Truth
    error: str = ""
    """What is wrong, in words; empty where nothing is."""
    completion: Completion | None = None
    """Of a language model that put it into words."""


@dataclass(frozen=True, slots=True)
class Recalled:
    """What comes to somebody's mind, before it is put into words."""

    facts: WayFacts | Reply
    truth: Truth
    error: str = ""
    """As in `AnswerWithTruth`."""


@dataclass(frozen=True)
class Memory:
    """One person of one episode; the same question at the same place has the same answer."""

    seed: tuple[int, ...]
    """Of all that chance decides about this person."""
    floor: FloorKnowledge
    bank: Bank
    error_rate: float
    """Share of people who are not reliable."""
    success_distance: float
    """Metres from a place within which one is there, as one walks."""
    kind: Literal["memory", "wrong", "empty"] = "memory"
    """The last two are controls: wrong in all, and knowing nothing."""

    @property
    def is_reliable(self) -> bool:
        """Whether the person makes no errors; who is not makes one in each answer."""
        return bool(self._rng("reliable").random() >= self.error_rate)

    def answer(self, question: Question, here: Pose) -> AnswerWithTruth:
        """Answer a question where one stands, facing as the asker faces."""
        rng = self._rng(question.kind, question.about)
        recalled = self._recall(question, here, rng)
        match recalled.facts:
            case WayFacts() as way:
                words = self.bank.way(way, rng, self.voice)
            case Reply(case, slots):
                words = self.bank.reply(question.kind, case, slots, rng, self.voice)
        return AnswerWithTruth(words, recalled.truth, recalled.error)

    def recall(self, question: Question, here: Pose) -> Recalled:
        """Return what is remembered, for somebody else to put into words."""
        return self._recall(question, here, self._rng(question.kind, question.about))

    @property
    def voice(self) -> str:
        """How the person speaks: one of the bank's manners."""
        return str(self._rng("voice").choice(self.bank.manners))

    def _recall(
        self, question: Question, here: Pose, rng: np.random.Generator
    ) -> Recalled:
        knows = rng.random() >= NOT_KNOWN or self.kind == "wrong"
        errs = self.kind == "wrong" or not self.is_reliable
        if self.kind == "empty" or not knows:
            return _unknown(question)
        if question.kind == "way_to":
            return self._way_to(question, here, rng, errs=errs)
        place = self.floor.nearest_called(question.about, here)
        if place is None:
            return _unknown(question)
        if question.kind == "where_is":
            return self._where_is(question, place, here, errs=errs)
        return self._is_this(question, place, here, errs=errs)

    def _rng(self, *about: str) -> np.random.Generator:
        digest = hashlib.sha256("\0".join(about).encode()).digest()
        return np.random.default_rng([*self.seed, int.from_bytes(digest[:8], "big")])

    def _way_to(
        self, question: Question, here: Pose, rng: np.random.Generator, *, errs: bool
    ) -> Recalled:
        way = self.floor.way_to(question.about, here)
        if way is None:
            return _unknown(question)
        plan = told_plan(way.facts, rng)
        remembered = misremembered(way, plan, rng) if errs else (plan, "")
        if remembered is None:
            return _unknown(question)
        said, error = remembered
        facts = way_facts(way, said, plan)
        return Recalled(facts, "wrong" if errs else "right", error)

    def _where_is(
        self, question: Question, place: NamedPlace, here: Pose, *, errs: bool
    ) -> Recalled:
        found = self.floor.whereabouts(place, here)
        true = _as_told(found.bearing)
        case = true
        if errs:
            case = _as_told(_OPPOSITE[found.bearing] if found.bearing else "ahead")
        slots = {"thing": question.about, "metres": f"{found.metres:.0f}"}
        if found.near is not None:
            slots["near"] = found.near
        if not errs:
            return Recalled(Reply(case, slots), "right")
        return Recalled(Reply(case, slots), "wrong", f"says {case}; it is {true}")

    def _is_this(
        self, question: Question, place: NamedPlace, here: Pose, *, errs: bool
    ) -> Recalled:
        metres = self.floor.walk_to(here, place)
        bearing = self.floor.whereabouts(place, here).bearing
        if self.kind == "memory":
            # Nobody takes a place for one that is far away.
            errs = errs and metres <= FURTHER_ON
        case = "yes" if (metres < self.success_distance) != errs else "no"
        slots = {"place": question.about}
        around = self.floor.thing_near(NamedPlace(place.id, (here.x, here.y)))
        if case == "no" and not errs and bearing and metres <= FURTHER_ON:
            case, slots["where"] = "not_yet", bearing
        elif around is not None:
            slots["near"] = around
        if not errs:
            return Recalled(Reply(case, slots), "right")
        error = f"says {case}; it is {metres:.1f} m away"
        return Recalled(Reply(case, slots), "wrong", error)


def _unknown(question: Question) -> Recalled:
    slot, case = {
        "way_to": ("destination", "unknown"),
        "where_is": ("thing", "unknown"),
        "is_this": ("place", "unsure"),
    }[question.kind]
    return Recalled(Reply(case, {slot: question.about}), "unknown")


def told_plan(facts: RouteFacts, rng: np.random.Generator) -> StepPlan:
    """Return a right description of a way with cues as they come to somebody's mind."""
    plan = facts.plan
    for turn, cues in zip(facts.plan.turns, facts.cues, strict=True):
        if len(cues) > 1 and rng.random() >= PLAINEST:
            cue = cues[1 + int(rng.integers(len(cues) - 1))]
            other = plan.with_turn(turn.key, cue=cue)
            if facts.is_right(other):
                plan = other
    return plan


def way_facts(way: WayThere, plan: StepPlan, right: StepPlan) -> WayFacts:
    """Return what a plan says of a way; what it has in common with a right one is true."""
    known = {turn.key: turn for turn in right.turns}
    return WayFacts(
        _OPPOSITE[way.start] if plan.around else way.start,
        tuple(
            _turn_fact(way.facts, plan, turn, is_right=known.get(turn.key) == turn)
            for turn in plan.turns
        ),
        plan.ending.side or ("end" if _ends_there(way.facts) else "ahead"),
        way.facts.route.goal,
        plan.ending.stretch.length,
    )


def _turn_fact(
    facts: RouteFacts, plan: StepPlan, turn: Step, *, is_right: bool
) -> TurnFact:
    kind, ordinal = turn.cue.kind, turn.cue.ordinal
    thing = ""
    if kind == "thing":
        thing = with_article(thing_called(turn.cue.words, plan.things), definite=True)
    cue = "end" if kind == "forced" else kind
    if kind == "ordinal" and ordinal == 1:
        cue = "crossing" if is_right and _is_first_crossing(facts, turn) else "next"
    side = turn.side.replace("slight_", "half ")
    return TurnFact(side, cue, ordinal, thing, turn.stretch.length)


def _is_first_crossing(facts: RouteFacts, turn: Step) -> bool:
    """Whether a turn is at a crossing with no other turning point before it."""
    number = next((n for n, t in enumerate(facts.route.turns) if t.at == turn.at), 0)
    shape = facts.graph.points[turn.at].shape
    return shape == "crossing" and not facts.between[number]


def _ends_there(facts: RouteFacts) -> bool:
    """Whether there is no floor beyond the destination."""
    line = facts.route.line
    (ax, ay), (bx, by) = (place[:2] for place in line.coords[-2:])
    share = BEYOND / max(math.dist((ax, ay), (bx, by)), 0.01)
    beyond = Point(bx + share * (bx - ax), by + share * (by - ay))
    return not facts.graph.site.walkable_floor.covers(beyond)


def misremembered(
    way: WayThere, plan: StepPlan, rng: np.random.Generator
) -> tuple[StepPlan, str] | None:
    """Return the plan of who errs once, and what is wrong with it.

    Only what can be said of a way counts, and only what leads astray; None where no
    error does both.
    """
    right = way_facts(way, plan, plan)
    for kind in rng.permutation(kinds_of("onsite")):
        for mistake in possible_mistakes(way.facts, plan, str(kind), rng):
            facts = way_facts(way, mistake.plan, plan)
            if (facts.start, *map(_said, facts.turns)) != (
                right.start,
                *map(_said, right.turns),
            ):
                return mistake.plan, mistake.detail
    return None


def _said(turn: TurnFact) -> tuple[object, ...]:
    return turn.side, turn.cue, turn.ordinal, turn.thing


def _as_told(bearing: StartSide | None) -> str:
    return "far" if bearing is None else "behind" if bearing == "back" else bearing
