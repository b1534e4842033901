"""Put errors into what people said: by a certain edit, else by telling it anew."""

import re
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus.error_kinds import kinds_of
from memorymaze.texts.corpus.records import Failure, Instruction, Span
from memorymaze.texts.corpus.statistics import word_count
from memorymaze.texts.writing.grammar import write_texts
from memorymaze.texts.writing.mistakes import (
    made_wrong,
    possible_mistakes,
)
from memorymaze.texts.writing.request import ErrorRates
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.sampling import Cell, Outline, chosen_plan
from memorymaze.texts.writing.steps import Mistake
from memorymaze.texts.writing.told_sides import certain_sides
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph
from memorymaze.texts.writing.voices import make_voice
from memorymaze.world.sites.records import Site

EDITABLE = frozenset({
    "incorrect_direction",
    "missing_turn",
    "wrong_direction",
    "wrong_direction_at_turn",
})
"""Kinds that can be a change of one word, or of one sentence left out."""
SHORT = 12
"""Words of a sentence that can be left out without taking much else with it."""
SENTENCE = re.compile(r"[^.!?\n]+[.!?]*\s*")


def with_errors(
    instructions: Sequence[Instruction],
    sites: Mapping[str, Site],
    rates: ErrorRates,
    seed: int,
    *,
    paired: bool,
) -> Iterator[Instruction]:
    """Make the wrong counterparts of right instructions.

    A text is edited where it is certain which word tells which turn of its route; else
    its route is told anew, as long as it, by a voice of its study. The field `method`
    says which. Texts with failures, and of studies other than the paper's, are left out.

    Raises:
        InstructionFileError: No instruction is left.
        SitePlanError: A route cannot be described.
    """
    floors = {name: TurningPointGraph(site) for name, site in sites.items()}
    all_facts: dict[tuple[str, str], RouteFacts] = {}
    right = [
        each
        for each in instructions
        if not each.failures and each.study in {"online", "onsite"}
    ]
    if not right:
        raise InstructionFileError(
            "expected instructions without failures to put errors into, got none"
        )
    for one in right:
        key = (one.site, one.reference_route)
        if key not in all_facts:
            route = sites[one.site].find_route(one.reference_route)
            all_facts[key] = RouteFacts(floors[one.site], route)
        yield from _of_one(one, all_facts[key], rates, seed, paired=paired)


def _of_one(
    one: Instruction,
    facts: RouteFacts,
    rates: ErrorRates,
    seed: int,
    *,
    paired: bool,
) -> Iterator[Instruction]:
    rng = np.random.default_rng([seed, zlib.crc32(one.id.encode())])
    known = kinds_of(one.study)
    failing = 1.0 if rates.failure is None else rates.failure
    if rates.kinds:
        wanted = [kind for kind, share in rates.kinds.items() if rng.random() < share]
    elif rng.random() < failing:
        wanted = [known[number] for number in rng.permutation(len(known))]
    else:
        wanted = []
    for kind in wanted:
        edited = _edited(one, facts, kind, rng) if kind in EDITABLE else None
        made = edited or _retold(one, facts, kind, rates, rng)
        if made:
            yield made[0]
            if paired:
                yield made[1]
            return


def _edited(
    one: Instruction, facts: RouteFacts, kind: str, rng: np.random.Generator
) -> tuple[Instruction, Instruction] | None:
    """Return the text with one word changed or one sentence gone, and the text."""
    turns = [turn.direction.rpartition("_")[2] for turn in facts.route.turns]
    told = certain_sides(one.text, turns)
    if told is None:
        return None
    for mistake in possible_mistakes(facts, facts.plan, kind, rng):
        if not mistake.key.startswith("turn"):
            continue
        number = int(mistake.key.removeprefix("turn"))
        start, end = told[number].start, told[number].end
        if mistake.part == "side":
            new = {"left": "right", "right": "left"}[told[number].side]
            new = new.capitalize() if one.text[start].isupper() else new
        else:
            own = next(
                found
                for found in SENTENCE.finditer(one.text)
                if found.start() <= start < found.end()
            )
            others = [each for each in told if own.start() <= each.start < own.end()]
            words, last = len(own[0].split()), not one.text[own.end() :].strip()
            if len(others) != 1 or words > SHORT or last or "\n" in one.text:
                continue
            start, end, new = own.start(), own.end(), ""
        text = one.text[:start] + new + one.text[end:]
        return _edited_pair(one, mistake, text, start, end, start + len(new))
    return None


def _edited_pair(
    one: Instruction, mistake: Mistake, text: str, start: int, right: int, wrong: int
) -> tuple[Instruction, Instruction]:
    pair = f"{one.id}-{mistake.kind}"
    where, detail = mistake.where, mistake.detail
    made = replace(
        one,
        id=pair,
        text=text,
        original_text=one.text,
        failures=(Failure(mistake.kind, where, detail),),
        source="synthetic",
        pair=pair,
        spans=(Span(mistake.kind, start, wrong, where, detail),),
        method="edited",
        followers=None,
    )
    counterpart = replace(
        one,
        id=f"{pair}-right",
        pair=pair,
        spans=(Span(mistake.kind, start, right, where, detail),),
    )
    return made, counterpart


def _retold(
    one: Instruction,
    facts: RouteFacts,
    kind: str,
    rates: ErrorRates,
    rng: np.random.Generator,
) -> tuple[Instruction, Instruction] | None:
    """Return the route told anew with an error, and without."""
    voice = make_voice(one.study, one.iteration, rng, rates.surface)
    plan = chosen_plan(facts, voice, rng)
    mistakes = made_wrong(facts, plan, (kind,), rng)
    if not mistakes or one.study == "sail" or one.study == "memory":
        return None
    cell = Cell(one.study, one.iteration, one.site, one.route, facts, ())
    outline = Outline(
        id=f"{one.id}-{kind}",
        participant=one.participant,
        cell=cell,
        facts=facts,
        voice=voice,
        seed=int(rng.integers(2**32)),
        words=float(word_count(one.text)),
        plan=plan,
        mistakes=mistakes,
    )
    made = write_texts(outline, paired=True)
    wrong, right = (
        replace(each, method="retold", split=one.split, original_text=one.text)
        for each in made
    )
    return wrong, right
