"""Sample what is to be written: who describes which way, how long, with which errors.

An outline is everything about a text but its words; engines make words of it.
"""

import math
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from memorymaze.texts.corpus.error_kinds import kinds_of
from memorymaze.texts.corpus.published import PublishedStudy
from memorymaze.texts.writing.mistakes import made_wrong
from memorymaze.texts.writing.request import (
    CellRates,
    ErrorRates,
    cell_rates,
)
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.steps import Cue, Mistake, Step, StepPlan
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph
from memorymaze.texts.writing.voices import Voice, make_voice
from memorymaze.world.sites.records import Site

LONGEST = 3.5
"""Standard deviations above the mean; longer ones are drawn again."""
STEEPEST = 1.4
"""Greatest deviation as a multiple of the mean above the least length; beyond it no
log-normal with a cut tail has these moments, and the least length gives way."""


def stratified(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return numbers spread evenly over [0, 1), in random order, shape (count,).

    One lies in each of `count` equal parts, so that shares of any event drawn with them
    are right to one part: a cell of 1,000 texts has its failure rate, not one near it.
    """
    return (rng.permutation(count) + rng.random(count)) / count


def wanted_lengths(
    mean: float, deviation: float, least: float, count: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Draw word counts with a mean and standard deviation, shape (count,).

    Log-normal above `least`, as spoken lengths are: many short ones, a few very long.
    The tail is cut; parameters are moved so that the moments still hold.
    """
    least = min(least, mean - deviation / STEEPEST)
    spread = np.log1p((deviation / (mean - least)) ** 2)
    levels = stratified(count, rng)
    top = mean + LONGEST * deviation
    grid = (np.arange(4000) + 0.5) / 4000
    drift, width = math.log(mean - least) - spread / 2, math.sqrt(spread)
    for _ in range(40):
        values = _cut(grid, drift, width, least, top)
        width *= deviation / max(values.std(), 1e-9)
        values = _cut(grid, drift, width, least, top)
        drift += math.log((mean - least) / (values.mean() - least))
    return _cut(levels, drift, width, least, top)


def _cut(
    levels: NDArray[np.float64], drift: float, width: float, least: float, top: float
) -> NDArray[np.float64]:
    """Return quantiles of the log-normal that is cut off at the top."""
    from scipy.special import ndtr, ndtri

    share = ndtr((math.log(top - least) - drift) / width)
    return least + np.exp(drift + width * ndtri(levels * share))


THING_WEIGHT, ORDINAL_WEIGHTS, END_WEIGHT = 1.2, (1.2, 0.9, 0.3), 1.3
RARE = 0.02
"""Weight of a cue that nobody would choose who has another."""
FEW_THINGS = 2
"""Things at one place that a speaker chooses from."""


def chosen_plan(facts: RouteFacts, voice: Voice, rng: np.random.Generator) -> StepPlan:
    """Return a right plan as one speaker would tell it; it arrives when walked."""
    plan = facts.plan
    turns: list[Step] = []
    for turn, cues in zip(plan.turns, facts.cues, strict=True):
        # One thing marks one turn.
        used = {each.cue.words for each in turns if each.cue.words}
        fresh = tuple(cue for cue in cues if cue.words not in used)
        turns.append(replace(turn, cue=_cue(turn, fresh, rng)))
    plan = replace(plan, turns=tuple(turns))
    if not facts.is_right(plan):
        plan = facts.plan
    for turn in plan.turns:
        corner = turn.cue.kind == "forced" and len(plan.turns) > 1
        if rng.random() < voice.surface.skipped_corner and corner:
            shorter = plan.with_turn(turn.key, told=False)
            if any(each.told for each in shorter.turns) and facts.is_right(shorter):
                plan = shorter
    return plan


def _cue(turn: Step, cues: tuple[Cue, ...], rng: np.random.Generator) -> Cue:
    things = [cue for cue in cues if cue.kind == "thing"]
    if things:
        # Two of the same words can stand at one place.
        distinct = list({cue.words: cue for cue in things}.values())
        drawn = rng.permutation(len(distinct))[:FEW_THINGS]
        things = [distinct[number] for number in drawn]
    others = [cue for cue in cues if cue.kind != "thing"]
    pool = [*others, *things]
    weights = np.array([_weight(cue, turn) for cue in pool])
    return pool[int(rng.choice(len(pool), p=weights / weights.sum()))]


def _weight(cue: Cue, turn: Step) -> float:
    if cue.kind == "thing":
        return THING_WEIGHT if turn.stretch.length > 2 else RARE
    if cue.kind == "ordinal":
        return ORDINAL_WEIGHTS[cue.ordinal - 1] if cue.ordinal <= 3 else RARE
    return END_WEIGHT


Iteration = Literal[1, 2]
STUDIES: tuple[PublishedStudy, ...] = ("online", "onsite")
ITERATIONS: tuple[Iteration, ...] = (1, 2)
PER_TURN = 3.5
"""Words that the shortest telling of a turn takes."""


@dataclass(frozen=True)
class Cell:
    """One cell of Table I: a route, a study, an iteration."""

    study: PublishedStudy
    iteration: Iteration
    site: str
    route: str
    reference: RouteFacts
    alternatives: tuple[RouteFacts, ...]

    @property
    def participant_stem(self) -> str:
        """What the ids of its participants begin with."""
        return f"gen-{self.study[:3]}-{self.site}-{self.route.lower()}"


@dataclass(frozen=True, slots=True)
class Outline:
    """A text before its words."""

    id: str
    participant: str
    cell: Cell
    facts: RouteFacts
    """The way described."""
    voice: Voice
    seed: int
    """Of the words."""
    words: float
    """How long the text should be."""
    plan: StepPlan
    """The right plan."""
    mistakes: tuple[Mistake, ...]
    """Its errors; none for a right text."""

    @property
    def told_plan(self) -> StepPlan:
        """The plan that is told."""
        return self.mistakes[-1].plan if self.mistakes else self.plan

    @property
    def alternative(self) -> bool:
        """Whether it is another way than the reference route."""
        return self.facts.route.role == "alternative"


def cells_of(
    site: Site,
    *,
    route: str | None = None,
    studies: Sequence[PublishedStudy] = STUDIES,
    iterations: Sequence[Iteration] = ITERATIONS,
) -> list[Cell]:
    """Return the cells of a site.

    Args:
        site: Any site with routes.
        route: Only this one, such as `R1`; None for all.
        studies: Which.
        iterations: Which.

    Raises:
        SitePlanError: A route cannot be described.
    """
    floor = TurningPointGraph(site)
    ways: dict[str, dict[str, list[RouteFacts]]] = {}
    for each in site.routes:
        roles = ways.setdefault(each.route, {"reference": [], "alternative": []})
        roles[each.role].append(RouteFacts(floor, each))
    return [
        Cell(
            study,
            iteration,
            site.name,
            name,
            roles["reference"][0],
            tuple(roles["alternative"]),
        )
        for study in studies
        for name, roles in ways.items()
        if roles["reference"] and route in {None, name}
        for iteration in iterations
    ]


def sample_outlines(
    cell: Cell, rates: ErrorRates, count: int, seed: int
) -> Iterator[Outline]:
    """Draw what is to be written for a cell.

    Shares and lengths are drawn in strata, so that a cell keeps them whatever the seed.

    Args:
        cell: Which.
        rates: How often they go wrong.
        count: Texts.
        seed: Of all chance; the participants are the same in both iterations.
    """
    turns = len(cell.reference.route.turns)
    table = cell_rates(cell.study, cell.iteration, cell.site, cell.route, turns)
    name = f"{cell.participant_stem}-{cell.iteration}"
    rng = np.random.default_rng([seed, zlib.crc32(name.encode())])
    least = PER_TURN * turns + 6
    lengths = wanted_lengths(table.words_mean, table.words_sd, least, count, rng)
    wrong = stratified(count, rng)
    other = stratified(count, rng)
    kinds = kinds_of(cell.study)
    for number in range(count):
        participant = f"{cell.participant_stem}-{number + 1:04d}"
        own = zlib.crc32(participant.encode())
        person = np.random.default_rng([seed, own])
        voice = make_voice(cell.study, cell.iteration, person, rates.surface)
        facts = _way(cell, table, rates, float(other[number]), rng)
        plan = chosen_plan(facts, voice, rng)
        mistakes: tuple[Mistake, ...] = ()
        for wanted in _kinds(rates, table, float(wrong[number]), kinds, rng):
            mistakes = made_wrong(facts, plan, wanted, rng)
            if mistakes:
                break
        yield Outline(
            id=f"{participant}-{cell.iteration}",
            participant=participant,
            cell=cell,
            facts=facts,
            voice=voice,
            seed=int(rng.integers(2**32)),
            words=float(lengths[number]),
            plan=plan,
            mistakes=mistakes,
        )


def _way(
    cell: Cell,
    table: CellRates,
    rates: ErrorRates,
    level: float,
    rng: np.random.Generator,
) -> RouteFacts:
    share = rates.surface.get("alternative_way", table.alternative)
    if level < share and cell.alternatives:
        return cell.alternatives[int(rng.integers(len(cell.alternatives)))]
    return cell.reference


def _kinds(
    rates: ErrorRates,
    table: CellRates,
    level: float,
    kinds: tuple[str, ...],
    rng: np.random.Generator,
) -> list[tuple[str, ...]]:
    """Return which kinds of errors to make; the later ones where there is no room."""
    if rates.kinds:
        chosen = [kind for kind, share in rates.kinds.items() if rng.random() < share]
        return [tuple(chosen)] if chosen else []
    share = table.failure if rates.failure is None else rates.failure
    if level >= share:
        return []
    return [(kinds[number],) for number in rng.permutation(len(kinds))]
