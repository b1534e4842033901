"""Whether agents follow right plans on floors that nobody has seen, by kind of building.

Floors of all kinds are made, and speakers made up for each (`memorymaze.texts.writing.speakers`):
`all` is all that there is to say, `exact` ones leave out and say nothing that is not so,
`people` name, count and measure as people do, `errors` make a significant error besides.
No text is between:
`python -m benchmarks.made_walks --agent guide [--speakers people]` (docs/lab/benches.md).
"""

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.plan_walks import (
    PlanWalk,
    agents_of,
    estimates,
    parser_of,
    plan_instruction,
    share,
    walk_plans,
)
from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.tables import Column, Table
from memorymaze.language.plans import RoutePlan
from memorymaze.runs.episodes.settings import RunSettings
from memorymaze.texts.corpus import Instruction
from memorymaze.texts.writing import ErrorRates, cells_of, sample_outlines
from memorymaze.texts.writing.speakers import EXACT, draw_speaker, tell_plan
from memorymaze.world.construction import BUILDING_KINDS, BuildingKind, make_building
from memorymaze.world.sites import Route, Site

SPEAKERS = ("all", "exact", "people", "errors")
FIRST_SEED = 100_000
"""Of floors, so that none is one that other benches or tests know."""


@dataclass(frozen=True, slots=True)
class ToldWay:
    """A way on a made floor, and what one speaker said of it."""

    name: str
    kind: str
    """Of the building."""
    site: Site
    route: Route
    plan: RoutePlan
    errors: tuple[str, ...] = ()
    """Kinds of the errors in it."""

    @property
    def instruction(self) -> Instruction:
        """What an episode is told."""
        return plan_instruction(self.name, self.site, self.route, self.plan)


def told_ways(
    floors: Mapping[BuildingKind, Sequence[int]],
    speakers: str,
    per_route: int,
    seed: int,
    folder: Path,
) -> Iterator[ToldWay]:
    """Yield ways told on made floors, by kind and seed of these; untold routes are left out.

    Floors are the same for all speakers.
    """
    for kind, site in made_floors(floors, folder):
        try:
            yield from ways_of(site, kind, speakers, per_route, seed)
        except SitePlanError:
            continue


def made_floors(
    floors: Mapping[BuildingKind, Sequence[int]], folder: Path
) -> Iterator[tuple[BuildingKind, Site]]:
    """Make floors, by kind and seed of these; their plans go into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for kind, seeds in floors.items():
        for number in seeds:
            building = make_building(kind, number)
            building.save(folder / f"{building.name}.geojson")
            yield kind, building


def floor_seeds(seed: int, made: int) -> range:
    """Return the seeds of so many floors of a kind."""
    first = FIRST_SEED + 1000 * seed
    return range(first, first + made)


def ways_of(
    site: Site, kind: str, speakers: str, per_route: int, seed: int
) -> Iterator[ToldWay]:
    """Yield what some speakers say of each route of a site."""
    rates = ErrorRates(failure=1.0 if speakers == "errors" else 0.0)
    for cell in cells_of(site, studies=("onsite",), iterations=(1,)):
        for number, each in enumerate(sample_outlines(cell, rates, per_route, seed)):
            rng = np.random.default_rng([seed, each.seed])
            speaker = EXACT if speakers == "exact" else draw_speaker(rng)
            said = each.told_plan.said
            if speakers != "all":
                said = tell_plan(each.told_plan, speaker, rng)
            yield ToldWay(
                f"{site.name}-{cell.route}-{number}",
                kind,
                site,
                each.facts.route,
                said,
                tuple(error.kind for error in each.mistakes),
            )


def rows_of(
    agent: str, told: Sequence[ToldWay], walks: Mapping[str, PlanWalk], seed: int
) -> Iterator[dict[str, object]]:
    """Yield a row a kind of building, and one of all; buildings are drawn again."""
    kinds = dict.fromkeys(each.kind for each in told)
    for kind in [*kinds, "all"]:
        mine = [each for each in told if kind in {each.kind, "all"}]
        found = [walks[each.name].result for each in mine]
        values = {
            "sr": [each.success for each in found],
            "osr": [each.oracle_success for each in found],
            "false": [
                not each.success and each.stopped_by == "agent" and not each.gave_up
                for each in found
            ],
        }
        yield {
            "agent": agent,
            "kind": kind,
            "n": len(mine),
            **estimates(values, [each.site.name for each in mine], seed),
        }


def made_walks_parser(bench: str) -> argparse.ArgumentParser:
    """Return the options that say which floors, and who tells."""
    parser = parser_of(bench, "so many tellings of each route")
    parser.add_argument("--speakers", choices=SPEAKERS, default="exact")
    parser.add_argument("--kinds", nargs="+", choices=BUILDING_KINDS, metavar="KIND")
    parser.set_defaults(made=3, sample=1)
    return parser


def told_by(options: argparse.Namespace) -> Iterator[ToldWay]:
    """Yield the ways that the options ask for."""
    seeds = floor_seeds(options.seed, options.made)
    floors = dict.fromkeys(options.kinds or BUILDING_KINDS, seeds)
    return told_ways(
        floors, options.speakers, options.sample, options.seed, options.out / "made"
    )


def main() -> int:
    options = made_walks_parser("made_walks").parse_args()
    told = list(told_by(options))
    sites = {each.site.name: each.site for each in told}
    rows: list[Mapping[str, object]] = []
    for agent in agents_of(options):
        walks = walk_plans(
            agent,
            [each.instruction for each in told],
            sites,
            options,
            RunSettings(seed=options.seed),
        )
        rows += rows_of(agent.name, told, walks, options.seed)
    columns = (
        Column("agent", "Agent", role="label"),
        Column("kind", "Building", role="label"),
        Column("n", "n"),
        share("sr", "success", "higher"),
        share("osr", "was there", "higher"),
        share("false", "false arrivals", "lower"),
    )
    notes = (f"made floors, plans by made-up speakers ({options.speakers})",)
    print(Table("Right plans on made floors", columns, tuple(rows), notes).text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
