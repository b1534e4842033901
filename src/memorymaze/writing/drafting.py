"""Draw what is to be written: who describes which way, how long, with which errors.

A draft is everything about a text but its words; engines make words of it.
"""

import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from memorymaze.instructions.error_kinds import kinds_of
from memorymaze.sites.records import Site
from memorymaze.writing.choosing import chosen_plan
from memorymaze.writing.lengths import stratified, wanted_lengths
from memorymaze.writing.mistakes import made_wrong
from memorymaze.writing.rates import (
    CellRates,
    ErrorRates,
    cell_rates,
)
from memorymaze.writing.reading import RouteReading
from memorymaze.writing.steps import Mistake, StepPlan
from memorymaze.writing.voices import Voice, make_voice
from memorymaze.writing.walks import WalkMap

Study = Literal["online", "onsite"]
Iteration = Literal[1, 2]
STUDIES: tuple[Study, ...] = ("online", "onsite")
ITERATIONS: tuple[Iteration, ...] = (1, 2)
PER_TURN = 3.5
"""Words that the shortest telling of a turn takes."""


@dataclass(frozen=True)
class Cell:
    """One cell of Table I: a route, a study, an iteration."""

    study: Study
    iteration: Iteration
    site: str
    route: str
    reference: RouteReading
    alternatives: tuple[RouteReading, ...]

    @property
    def participant_stem(self) -> str:
        """What the ids of its participants begin with."""
        return f"gen-{self.study[:3]}-{self.site}-{self.route.lower()}"


@dataclass(frozen=True, slots=True)
class Draft:
    """A text before its words."""

    id: str
    participant: str
    cell: Cell
    reading: RouteReading
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
        return self.reading.route.role == "alternative"


def cells_of(
    site: Site,
    *,
    route: str | None = None,
    studies: Sequence[Study] = STUDIES,
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
    floor = WalkMap(site)
    readings = [RouteReading(floor, each) for each in site.routes]
    names = dict.fromkeys(each.route.route for each in readings)
    cells: list[Cell] = []
    for study in studies:
        for name in names:
            if route not in {None, name}:
                continue
            own = [each for each in readings if each.route.route == name]
            references = [each for each in own if each.route.role == "reference"]
            others = [each for each in own if each.route.role == "alternative"]
            for iteration in iterations if references else ():
                first = references[0]
                cells.append(
                    Cell(study, iteration, site.name, name, first, tuple(others))
                )
    return cells


def drafts(cell: Cell, rates: ErrorRates, count: int, seed: int) -> Iterator[Draft]:
    """Draw the texts of a cell.

    Shares and lengths are drawn in strata, so that a cell keeps them whatever the
    seed; see `lengths.stratified`.

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
        reading = _way(cell, table, rates, float(other[number]), rng)
        plan = chosen_plan(reading, voice, rng)
        mistakes: tuple[Mistake, ...] = ()
        for wanted in _kinds(rates, table, float(wrong[number]), kinds, rng):
            mistakes = made_wrong(reading, plan, wanted, rng)
            if mistakes:
                break
        yield Draft(
            id=f"{participant}-{cell.iteration}",
            participant=participant,
            cell=cell,
            reading=reading,
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
) -> RouteReading:
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
