"""One building of a dataset: its plan, its texts, and walks along its routes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from memorymaze.basics.errors import SitePlanError
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.datasets.splits import PlannedBuilding
from memorymaze.texts.datasets.walks import StepWalk, walk_by_steps
from memorymaze.texts.writing import ErrorRates, cells_of, sample_outlines, write_texts
from memorymaze.world.construction import make_building
from memorymaze.world.sites import Site

CELLS = (("online", 1), ("onsite", 1), ("online", 2), ("onsite", 2))
"""Studies and iterations, between which the texts of a route are shared evenly."""

TRIES = 5
"""Buildings made in place of one of which a route cannot be told."""
SEEDS_OF_TRIES_APART = 1_000_000_000
"""Apart from the seeds of all other buildings of any dataset one would make."""


@dataclass(frozen=True, slots=True)
class BuildingTask:
    """What a worker needs to make a building."""

    planned: PlannedBuilding
    folder: Path
    """Of the plans; there already."""
    per_route: int
    rates: ErrorRates
    seed: int
    """Of the texts."""
    walked: bool
    """Whether its routes are walked by steps."""


@dataclass(frozen=True, slots=True)
class FinishedBuilding:
    """A building whose plan is written, and what is told of it."""

    planned: PlannedBuilding
    site: Site
    instructions: tuple[Instruction, ...]
    walks: Mapping[str, StepWalk]
    """By the id of the route."""

    @property
    def splits(self) -> dict[str, str]:
        """The split of each route that is described, by its name."""
        return {each.route: each.split for each in self.instructions}


def finish_building(task: BuildingTask) -> FinishedBuilding:
    """Make a building, write its plan, and tell its routes.

    Where a route cannot be told (no cue leads to one of its turns), another building of
    the kind is made.
    """
    planned = task.planned
    for _ in range(TRIES - 1):
        try:
            return _finished(planned, task)
        except SitePlanError:
            planned = replace(planned, seed=planned.seed + SEEDS_OF_TRIES_APART)
    return _finished(planned, task)


def _finished(planned: PlannedBuilding, task: BuildingTask) -> FinishedBuilding:
    made = make_building(planned.kind, planned.seed)
    path = task.folder / f"{made.name}.geojson"
    site = replace(made, source=str(path))
    instructions = _texts(site, task)
    site.save(path)
    walks: dict[str, StepWalk] = {}
    if task.walked:
        scene = build_scene(site)
        for route in sorted({each.reference_route for each in instructions}):
            walks[route] = walk_by_steps(scene, site.find_route(route))
    return FinishedBuilding(planned, site, tuple(instructions), walks)


def _texts(site: Site, task: BuildingTask) -> list[Instruction]:
    cells = cells_of(site)
    split_of = task.planned.splits(sorted({cell.route for cell in cells}))
    whole, more = divmod(task.per_route, len(CELLS))
    texts: list[Instruction] = []
    for cell in cells:
        count = whole + (CELLS.index((cell.study, cell.iteration)) < more)
        if count:
            for outline in sample_outlines(cell, task.rates, count, task.seed):
                texts += write_texts(outline, paired=False)
    return [replace(each, split=split_of[each.route]) for each in texts]
