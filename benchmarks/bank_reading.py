"""How much the grammar reads of what passers-by say, of which it is known what it means.

A way drawn at random is said by the bank of `passers_by`, and the plan that the grammar
reads is held against the way: `python -m benchmarks.reading --bank` (docs/benches.md).
The voices are halved by their names. What those of one half say was looked at while the
grammar was changed, of the other half only these figures. Phrases that fit all voices are
in both halves.
"""

import hashlib
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar, get_args

import numpy as np

from memorymaze.instructions import load_corpus
from memorymaze.passers_by.bank import Bank, load_bank
from memorymaze.passers_by.bank_records import (
    MANY_TURNS,
    OPPOSITES,
    WAY_CASES,
    Answer,
    Cue,
    End,
    Start,
    TurnFact,
    WayFacts,
)
from memorymaze.routes import Leg, RoutePlan, Way
from memorymaze.tables import Column, Table
from memorymaze.understanding import parse_route_description
from memorymaze.writing.things import things_of, with_article

_Drawn = TypeVar("_Drawn")

TEXTS = 600
"""Ways told, in each half."""
SEED = 14
STARTS: dict[Start, float] = {"ahead": 0.5, "left": 0.2, "right": 0.2, "back": 0.1}
CUES: dict[Cue, float] = dict.fromkeys(get_args(Cue), 1 / len(get_args(Cue)))
ENDS: dict[End, float] = dict.fromkeys(get_args(End), 1 / len(get_args(End)))
SIDE_SHARES = dict(zip(OPPOSITES, (0.44, 0.44, 0.06, 0.06), strict=True))
ORDINALS = (0.3, 0.4, 0.2, 0.1)
"""How often the first, second, third and fourth opening is told."""
PARTS = {
    "sides": "every side",
    "cue": "cues",
    "start": "start",
    "end": "end",
    "destination": "destination",
    "whole": "all of these",
    "nothing": "nothing known",
}
_WAYS: dict[str, Way] = {
    "left": "left",
    "right": "right",
    "half left": "slight_left",
    "half right": "slight_right",
    "back": "around",
}
_IDLE = frozenset({"the", "a", "an", "of", "to", "for", "room", "that", "says"})


@dataclass(frozen=True, slots=True)
class Told:
    """What somebody said, and what they meant by it; None that they do not know."""

    text: str
    answer: Answer
    facts: WayFacts | None


def is_unread(manner: str) -> bool:
    """Tell whether a voice is of the half of which nothing was looked at."""
    return hashlib.sha256(manner.encode()).digest()[0] % 2 == 0


def tell(bank: Bank, *, unread: bool, texts: int, seed: int) -> Iterator[Told]:
    """Yield what the voices of a half say of as many ways, and all they do not know."""
    rng = np.random.default_rng(seed)
    sites = load_corpus().sites.values()
    things = sorted({
        with_article(each, definite=True) for site in sites for each in things_of(site)
    })
    goals = sorted({route.goal for site in sites for route in site.routes})
    answers = [each for each in bank.answers if is_unread(each.manner) == unread]
    ways = [each for each in answers if each.case in WAY_CASES]
    for _ in range(texts):
        answer = ways[int(rng.integers(len(ways)))]
        facts = _facts(answer, things, goals, rng)
        text = Bank((answer,), bank.words).way(facts, rng)
        if "rest" not in answer.slots:
            facts = replace(facts, turns=facts.turns[: answer.turns_told])
        yield Told(text, answer, facts)
    for answer in answers:
        if (answer.kind, answer.case) == ("way_to", "unknown"):
            goal = goals[int(rng.integers(len(goals)))]
            said = Bank((answer,), bank.words)
            text = said.reply("way_to", "unknown", {"destination": goal}, rng)
            yield Told(text, answer, None)


def _facts(
    answer: Answer,
    things: Sequence[str],
    goals: Sequence[str],
    rng: np.random.Generator,
) -> WayFacts:
    turns = WAY_CASES.index(answer.case)
    if turns == MANY_TURNS:
        turns += int(rng.integers(3))
    return WayFacts(
        start=_drawn(STARTS, rng),
        turns=tuple(
            TurnFact(
                side=_drawn(SIDE_SHARES, rng),
                cue=_drawn(CUES, rng),
                ordinal=1 + int(rng.choice(len(ORDINALS), p=ORDINALS)),
                thing=things[int(rng.integers(len(things)))],
                metres=float(rng.uniform(4, 40)),
            )
            for _ in range(turns)
        ),
        end=_drawn(ENDS, rng),
        destination=goals[int(rng.integers(len(goals)))],
        metres=float(rng.uniform(4, 40)),
    )


def _drawn(shares: Mapping[_Drawn, float], rng: np.random.Generator) -> _Drawn:
    return list(shares)[int(rng.choice(len(shares), p=list(shares.values())))]


def compare(told: Told, plan: RoutePlan) -> dict[str, tuple[float, float]]:
    """Return of each part how much was read rightly, and how much was told."""
    facts = told.facts
    if facts is None:
        return {"nothing": (not plan.legs and not plan.arrival.destinations, 1)}
    start, legs = _parted(facts, plan)
    sides = [leg.turn.way for leg in legs] == [_WAYS[t.side] for t in facts.turns]
    cues = 0
    if sides:
        cues = sum(map(_is_cue, facts.turns, legs))
    found: dict[str, tuple[float, float]] = {
        "sides": (sides, 1),
        "cue": (cues, len(facts.turns)),
        "start": (start, 1),
    }
    if "where" in told.answer.slots:
        end = plan.arrival.at_end if facts.end == "end" else plan.arrival.side
        found["end"] = (end in {True, facts.end}, 1)
    if {"destination", "where"} <= told.answer.slots:
        number = re.search(r"\d{3,}", facts.destination)
        name = facts.destination if number is None else number[0]
        named = any(_is_named(name, each) for each in plan.arrival.destinations)
        found["destination"] = (named, 1)
    found["whole"] = (all(right == said for right, said in found.values()), 1)
    return found


def _parted(facts: WayFacts, plan: RoutePlan) -> tuple[bool, tuple[Leg, ...]]:
    """Return whether one leaves as was said, and the legs after that."""
    first = plan.legs[0] if plan.legs else None
    if facts.start == "ahead":
        return first is None or not first.on_the_spot, plan.legs
    if first is None or first.turn.way != _WAYS[facts.start]:
        return False, plan.legs
    if len(plan.legs) > len(facts.turns) or first.on_the_spot:
        return first.on_the_spot, plan.legs[1:]
    return False, plan.legs


def _is_cue(turn: TurnFact, leg: Leg) -> bool:
    """Tell whether a leg ends where a turn was said to be, and nowhere else."""
    said = leg.turn
    things = [
        each.phrase
        for each in leg.mentions
        if each.place in {"turn", "beside", "opposite", "before_turn", "after_turn"}
    ]
    match turn.cue:
        case "thing":
            named = len(things) == 1 and _is_named(turn.thing, things[0])
            return named and not said.at_end and said.ordinal is None
        case "end":
            return said.at_end and said.ordinal is None and not things
        case "ordinal":
            return said.ordinal == turn.ordinal and not said.at_end and not things
        case _:
            return said.ordinal in {None, 1} and not said.at_end and not things


def _is_named(name: str, phrase: str) -> bool:
    """Tell whether a phrase to look for is of what a name says, in singular or plural."""
    said, read = (
        {word.removesuffix("s") for word in re.findall(r"[\w']+", each.casefold())}
        for each in (name, phrase)
    )
    return bool(said & read) and said - _IDLE <= read


def bank_table(texts: int = TEXTS, seed: int = SEED) -> Table:
    """Return what the grammar reads of both halves of the bank, the unread one first."""
    bank = load_bank()
    rows: list[dict[str, object]] = []
    for unread in (True, False):
        right, said = dict.fromkeys(PARTS, 0.0), dict.fromkeys(PARTS, 0.0)
        for told in tell(bank, unread=unread, texts=texts, seed=seed):
            found = compare(told, parse_route_description(told.text))
            for part, (hits, parts) in found.items():
                right[part] += hits
                said[part] += parts
        manners = sum(is_unread(manner) == unread for manner in bank.manners)
        rows.append({
            "half": "unread" if unread else "read",
            "manners": manners,
            "texts": texts,
            **{part: right[part] / said[part] for part in PARTS},
        })
    return Table(
        "Answers of passers-by, beside what they mean",
        (
            Column("half", "Half", "label"),
            Column("manners", "voices"),
            Column("texts", "n"),
            *(Column(name, heading, digits=2) for name, heading in PARTS.items()),
        ),
        tuple(rows),
        (
            "Shares of ways drawn at random. `every side`: the turns in order, and no "
            "others; `cues`: of turns, what they are known by (next, ordinal, end, thing), "
            "and that of no other turn; `start`: how one leaves, as a turn on the spot; "
            "`nothing known`: answers of who does not know, read as no plan.",
        ),
        "bank_reading",
    )
