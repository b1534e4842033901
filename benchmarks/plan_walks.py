"""Agents that are given plans, not texts: what the benches of arrival and repair share.

The instruction of an episode is a plan as JSON (docs/lab/benches.md), so that no reading of
language is measured. Walks are kept in run folders, and taken up again where a bench was
broken off.
"""

import argparse
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np

from memorymaze.basics.tables import Column
from memorymaze.front.cli.agent_options import given_options
from memorymaze.language.plans import RoutePlan, plan_record
from memorymaze.runs.episodes.agent_catalogue import choose_agent
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import NoteEntry, TrajectoryEntry
from memorymaze.runs.metrics.aggregate import participant_bootstrap
from memorymaze.runs.work.driver import run_plan
from memorymaze.texts.corpus import Corpus, Instruction
from memorymaze.texts.corpus.corpus import episodes
from memorymaze.world.construction import BUILDING_KINDS, make_building
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Route, Site, load_sites

RESAMPLES = 2000
AGENTS = ("guide", "explorer")


@dataclass(frozen=True, slots=True)
class Note:
    """Something that an agent wrote down on its way."""

    about: str
    details: Mapping[str, Any]
    place: tuple[float, float]
    """Where the robot was, metres."""


@dataclass(frozen=True, slots=True)
class PlanWalk:
    """What came of a plan, and what the agent wrote down."""

    result: EpisodeResult
    notes: tuple[Note, ...]


def parser_of(bench: str, told: str) -> argparse.ArgumentParser:
    """Return the options that all benches have."""
    parser = argparse.ArgumentParser(prog=f"python -m benchmarks.{bench}")
    for flag, kind, metavar, default, meaning in (
        ("--made", int, "K", 0, "also on K made buildings"),
        ("--sample", int, "N", None, told),
        ("--seed", int, "N", 0, "of what is drawn, and of the runs"),
        ("--workers", int, "N", 0, "processes; 0 for one per core"),
        ("--out", Path, "DIR", Path("runs") / bench, "keeps the walks"),
    ):
        parser.add_argument(
            flag, type=kind, metavar=metavar, default=default, help=meaning
        )
    parser.add_argument(
        "--agent",
        action="append",
        metavar="NAME",
        help="may be repeated; your own as module:Class or file.py:Class (default: "
        f"{' and '.join(AGENTS)})",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="an option of the agents; may be repeated",
    )
    return parser


def agents_of(options: argparse.Namespace) -> list[AgentSettings]:
    """Return the agents that are asked for; those with a reader are given plans."""
    given = given_options(options.set)
    return [
        given_plans(AgentSettings(name, options=given))
        for name in options.agent or AGENTS
    ]


def given_plans(agent: AgentSettings) -> AgentSettings:
    """Tell an agent that has an option `reader` that its texts are plans."""
    return choose_agent(agent).with_defaults(reader="plan").settings


def plan_instruction(
    name: str, site: Site, route: Route, plan: RoutePlan
) -> Instruction:
    """Return a plan as what an episode is told."""
    return Instruction(
        id=name,
        site=site.name,
        route=route.route,
        reference_route=route.id,
        participant=name,
        text=json.dumps(plan_record(plan)),
        source="synthetic",
    )


def walk_plans(
    agent: AgentSettings,
    told: Sequence[Instruction],
    sites: Mapping[str, Site],
    options: argparse.Namespace,
    settings: RunSettings | None = None,
) -> dict[str, PlanWalk]:
    """Let an agent walk plans, and return the walks by the ids of the instructions.

    Unless settings say otherwise, every episode has the time that the longest route of
    all sites takes, so that who goes back is not cut off.
    """
    corpus = Corpus("plans", tuple(episodes(told, sites)), sites, ())
    settings = settings or RunSettings(seed=options.seed, budget_by="longest")
    folder = options.out / quote(agent.name, safe="")
    plan = plan_run(agent, corpus, settings)
    results = run_plan(plan, folder, workers=options.workers, resume=True)
    return {
        each.instruction_id: PlanWalk(each, tuple(notes_of(folder, each.episode_id)))
        for each in results
    }


def notes_of(folder: Path, episode: str) -> Iterator[Note]:
    """Yield what an agent wrote down in an episode, with the places."""
    entries = list(read_trace(folder, episode))
    [walk] = [each for each in entries if isinstance(each, TrajectoryEntry)]
    times, x, y, _ = np.array(walk.poses).T
    for entry in entries:
        if isinstance(entry, NoteEntry):
            now = entry.time
            place = float(np.interp(now, times, x)), float(np.interp(now, times, y))
            yield Note(entry.about, entry.details, place)


def estimates(
    values: Mapping[str, Sequence[float]], units: Sequence[str], seed: int = 0
) -> dict[str, float | None]:
    """Return means with 95 % intervals, as fields of a row: `sr`, `sr_low`, `sr_high`.

    What shares a unit is drawn together.
    """
    row: dict[str, float | None] = {}
    if not units:
        return dict.fromkeys(
            (f"{name}{end}" for name in values for end in ("", "_low", "_high")), None
        )
    rng = np.random.default_rng(seed)
    table = np.array(list(values.values()), dtype=np.float64).T
    found = participant_bootstrap(table, units, rng, resamples=RESAMPLES)
    for name, each in zip(values, found, strict=True):
        row |= {name: each.mean, f"{name}_low": each.low, f"{name}_high": each.high}
    return row


def share(name: str, heading: str, better: Any = None) -> Column:
    """Return a column of a mean with its interval."""
    ends = (f"{name}_low", f"{name}_high")
    return Column(name, heading, digits=2, interval=ends, better=better)


def buildings(options: argparse.Namespace) -> dict[str, Site]:
    """Return the shipped sites and the made ones that are asked for, by name.

    Made ones take turns by kind; their plans are kept in `made/`.
    """
    sites = load_sites()
    folder = options.out / "made"
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(options.made):
        seed, kind = divmod(number, len(BUILDING_KINDS))
        building = make_building(BUILDING_KINDS[kind], seed)
        building.save(folder / f"{building.name}.geojson")
        sites[building.name] = building
    return sites


def labels(rows: Sequence[Mapping[str, object]]) -> tuple[Column, ...]:
    """Return the columns that say what a row is about: the floors where both are there."""
    agent = Column("agent", "Agent", role="label")
    if len({row["floors"] for row in rows}) == 1:
        return (agent,)
    return (agent, Column("floors", "Floors", role="label"))


def by_floors(walks: Mapping[str, PlanWalk]) -> dict[str, dict[str, PlanWalk]]:
    """Return walks on the shipped floors and those on made ones, where there are any."""
    parts: dict[str, dict[str, PlanWalk]] = {}
    for name, walk in walks.items():
        where = "shipped" if walk.result.site in BUILTIN_SITE_NAMES else "made"
        parts.setdefault(where, {})[name] = walk
    return parts
