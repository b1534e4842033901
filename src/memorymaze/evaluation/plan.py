"""What a run consists of: which agent follows which instructions where, and how."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from memorymaze.evaluation.agents_for_runs import build_agent
from memorymaze.evaluation.eyes_for_runs import checked_eyes
from memorymaze.evaluation.looks_for_runs import looks_of_run
from memorymaze.evaluation.program_replay import check_programs_for, with_programs
from memorymaze.evaluation.sampling import of_split, sample
from memorymaze.evaluation.settings import AgentSettings, RunSettings, stamp_file
from memorymaze.evaluation.step_budgets import time_budget_for
from memorymaze.instructions.corpus import episodes
from memorymaze.instructions.files import BUILTIN_CORPUS, load_instructions
from memorymaze.instructions.records import Episode
from memorymaze.metrics.success import SUCCESS_DISTANCE
from memorymaze.perception.eyes import TRUTH, DetectorSettings, SignSource
from memorymaze.simulation.obstacles import ObstacleSettings
from memorymaze.simulation.settings import SimulationSettings, TurningPoints
from memorymaze.sites import Site, load_sites


@dataclass(frozen=True, slots=True)
class EpisodeCorpus:
    """Episodes, the sites they are on, and the files they come from."""

    episodes: list[Episode]
    sites: dict[str, Site]
    files: Sequence[str | Path]


@dataclass(frozen=True, slots=True)
class RunPlan:
    """All that a run needs."""

    settings: RunSettings
    episodes: tuple[Episode, ...]
    sites: dict[str, Site]
    """Those the episodes are on."""


def plan_run(
    agent: AgentSettings,
    *,
    instruction_files: Sequence[str | Path] | None = None,
    sites_folder: str | Path | None = None,
    limit: int | None = None,
    seed: int = 0,
    success_distance: float = SUCCESS_DISTANCE,
    time_budget: float | None = None,
    call_budget: int | None = None,
    simulation: SimulationSettings | None = None,
    obstacles: ObstacleSettings | None = None,
    turning_points: TurningPoints | None = None,
    detector: DetectorSettings = TRUTH,
    signs: SignSource = "truth",
    split: str | None = None,
    corpus: EpisodeCorpus | None = None,
) -> RunPlan:
    """Load and check everything a run needs, before anything is written.

    Args:
        agent: Which agent, and its language model.
        instruction_files: JSONL files; None for the shipped corpus.
        sites_folder: Folder of site plans; None for the shipped ones.
        limit: Episodes to run, alike many of every route; see `sampling.sample`. None
            for all.
        seed: Of all random numbers.
        success_distance: Metres.
        time_budget: Simulated seconds per episode; None for `default_time_budget`.
        call_budget: Calls of the control API per episode; None for the simulation's.
        simulation: The robot's abilities; None for the defaults. Budgets above and
            the source of turning points below count before those in it.
        obstacles: Things in the way and people; None for none.
        turning_points: Where the robot knows them from; None for the simulation's.
        detector: Eyes of `detect_from_RGB_image`.
        signs: Where `read_signs` knows texts from.
        split: Only instructions of this split; None for all.
        corpus: Episodes with their sites, instead of files and folder.

    Raises:
        MemoryMazeError: Something that was given cannot be used.
    """
    checked_eyes(detector, signs)
    agent, programs = with_programs(agent)
    build_agent(agent)
    if corpus is None:
        corpus = _corpus_of_files(instruction_files, sites_folder)
    all_sites = corpus.sites
    chosen = sample(of_split(corpus.episodes, split), limit)
    if programs is not None:
        check_programs_for(programs, chosen)
    names = dict.fromkeys(episode.instruction.site for episode in chosen)
    sites = {name: all_sites[name] for name in names}
    abilities = simulation or SimulationSettings()
    if turning_points is not None:
        abilities = replace(abilities, turning_points=turning_points)
    if time_budget is None:
        routes = [route for site in sites.values() for route in site.routes]
        time_budget = time_budget_for(agent.name, routes, abilities)
    if call_budget is None:
        call_budget = abilities.call_budget
    abilities = replace(abilities, time_budget=time_budget, call_budget=call_budget)
    settings = RunSettings(
        agent=agent,
        instructions=tuple(stamp_file(path) for path in corpus.files),
        sites=tuple(stamp_file(site.source, name) for name, site in sites.items()),
        seed=seed,
        limit=limit,
        episodes=len(chosen),
        success_distance=success_distance,
        simulation=abilities,
        obstacles=obstacles,
        detector=detector,
        signs=signs,
        programs=None if programs is None else stamp_file(programs.path),
        split=split,
        looks=looks_of_run(agent.name, detector, signs),
    )
    return RunPlan(settings, tuple(chosen), sites)


def _corpus_of_files(
    files: Sequence[str | Path] | None, folder: str | Path | None
) -> EpisodeCorpus:
    files = [BUILTIN_CORPUS] if files is None else files
    sites = load_sites(folder)
    return EpisodeCorpus(episodes(load_instructions(files), sites), sites, files)
