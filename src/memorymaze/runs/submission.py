"""Whether a run can stand on a leaderboard: complete, by the rules, and as it says."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from memorymaze.basics.errors import RunFolderError, UndefinedMetricError
from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory
from memorymaze.basics.input_files import stamp_file
from memorymaze.basics.wording import counted
from memorymaze.robot.perception.eyes import TRUTH
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.budgets import time_budget_for
from memorymaze.runs.episodes.in_words import agent_version
from memorymaze.runs.episodes.plan import stamp_site
from memorymaze.runs.episodes.results import MEASURES, EpisodeResult, measure_walk
from memorymaze.runs.episodes.settings import (
    RunDefinition,
    RunSettings,
    Track,
    differences,
)
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import (
    CallEntry,
    EndEntry,
    TrajectoryEntry,
)
from memorymaze.runs.metrics.success import SUCCESS_DISTANCE
from memorymaze.runs.work.run_folder import RunRecord, read_run
from memorymaze.texts.corpus.corpus import Corpus, load_corpus
from memorymaze.texts.corpus.records import Episode
from memorymaze.world.sites import Site

ROUNDING = 0.02
"""By how much a metric may differ that is worked out from poses in whole millimetres."""
PRIVILEGED_CALLS = frozenset({"follow"})
"""Calls in a trace that only an agent makes that knows the answers."""

_UNSCORABLE = (ArithmeticError, LookupError, TypeError, ValueError)
"""What scoring raises on something that is no trajectory."""


@dataclass(frozen=True, slots=True)
class Submission:
    """A run folder, looked over."""

    track: Track
    problems: tuple[str, ...]
    """Why it cannot stand on a leaderboard; empty when it can."""
    remarks: tuple[str, ...]
    """What readers of a leaderboard must know of it."""


def check_submission(
    folder: str | Path,
    corpus: Corpus | None = None,
    *,
    progress: Callable[[int, int], None] | None = None,
) -> Submission:
    """Look over a run folder as a leaderboard would.

    It must hold every episode of the leaderboard's corpus on its plans, run with the
    default settings (of the obstacle track, where it has obstacles) by committed code,
    with a trace for each, and each trace must give the result that stands in
    `episodes.jsonl`: all metrics are worked out again from the trajectory. No trace may
    hold a call that only an agent with answers makes. That an agent of one's own did
    not learn the answers elsewhere cannot be checked.
    """
    folder, corpus = Path(folder), corpus or load_corpus()
    record, results = read_run(folder)
    settings = record.settings
    problems = [
        *_settings_problems(settings, corpus),
        *_episode_problems(results, settings.episodes, corpus.episodes),
        *_code_problems(record),
    ]
    if not problems:
        arenas = {name: Arena(site) for name, site in _sites_of(corpus).items()}
        known = {episode.id: episode for episode in corpus.episodes}
        for number, result in enumerate(results, start=1):
            episode = known[result.episode_id]
            problems += _trace_problems(
                folder, result, episode, arenas[episode.instruction.site], settings
            )
            if progress is not None:
                progress(number, len(results))
    found = tuple(remarks(settings, results))
    return Submission(settings.track, tuple(problems), found)


def _settings_problems(settings: RunDefinition, corpus: Corpus) -> Iterator[str]:
    sites = _sites_of(corpus)
    routes = [route for site in sites.values() for route in site.routes]
    abilities = SimulationSettings()
    budget = time_budget_for(frozenset(settings.needs), routes, abilities)
    obstacles = None
    if settings.obstacles is not None:
        obstacles = replace(ObstacleSettings(), seed=settings.obstacles.seed)
    # In the order of the run's own stamps, which is that of the episodes.
    order = [stamp.name for stamp in settings.sites if stamp.name in sites]
    names = order if len(order) == len(sites) else sorted(sites)
    expected = replace(
        settings,
        instructions=tuple(stamp_file(path) for path in corpus.files),
        sites=tuple(stamp_site(sites[name]) for name in names),
        limit=None,
        split=None,
        shard=None,
        second_telling=False,
        episodes=len(corpus.episodes),
        success_distance=SUCCESS_DISTANCE,
        budget_by=RunSettings().budget_by,
        time_budget=None,
        simulation=replace(abilities, time_budget=budget),
        obstacles=obstacles,
        noise=None,
        passers_by="memory",
        detector=TRUTH,
        signs="truth",
    )
    for each in differences(expected, settings):
        # Of episodes that were not asked for there is a problem of its own.
        if each.name != "episodes" and not (each.kind == "site" and each.here is None):
            yield f"setting {each.name}: {each.there!r} expected, got {each.here!r}"
    if settings.agent.is_own and not settings.isolate:
        yield (
            f"agent: expected {settings.agent.name} to be run in a process without "
            "buildings, got a run without isolate (--with isolate=true)"
        )
    if "answers" in settings.needs:
        yield f"agent: {settings.agent.name} is given the answers"


def _sites_of(corpus: Corpus) -> dict[str, Site]:
    """Return the sites that episodes take place on."""
    names = {episode.instruction.site for episode in corpus.episodes}
    return {name: corpus.sites[name] for name in names}


def _episode_problems(
    results: Sequence[EpisodeResult], asked: int, corpus: Sequence[Episode]
) -> Iterator[str]:
    told = {episode.id: episode.instruction for episode in corpus}
    missing = told.keys() - {result.episode_id for result in results}
    if len(results) < asked:
        such = f", such as {min(missing)!r}" if missing and asked == len(told) else ""
        yield (
            f"episodes without a result: {asked - len(results)} of {asked}{such}; finish "
            "the run with --resume"
        )
    if missing and asked != len(told):
        whole = "" if len(results) < asked else ", and is whole for what it was asked"
        yield (
            f"episodes: expected all {len(told)} of the leaderboard, got a run that was "
            f"asked for {asked}{whole}; run it again on all"
        )
    for result in results:
        mine = told.get(result.episode_id)
        if mine is None:
            yield f"episode {result.episode_id!r}: is none of the corpus"
            continue
        for name in ("site", "route", "reference_route", "study", "iteration", "split"):
            if getattr(result, name) != getattr(mine, name):
                yield (
                    f"episode {result.episode_id!r}: expected {name} "
                    f"{getattr(mine, name)!r}, got {getattr(result, name)!r}"
                )
        if result.success and result.stopped_by != "agent":
            yield (
                f"episode {result.episode_id!r}: is called a success although it was "
                f"stopped by {result.stopped_by}"
            )


def _code_problems(record: RunRecord) -> Iterator[str]:
    if record.code.commit is None:
        yield "code: expected a commit that others can look up, got none"
    elif record.code.commit.endswith("+"):
        yield (
            "code: expected a run by committed code, got files that differ from commit "
            f"{record.code.commit[:12]}"
        )


def _trace_problems(
    folder: Path,
    result: EpisodeResult,
    episode: Episode,
    arena: Arena,
    settings: RunDefinition,
) -> Iterator[str]:
    place = f"episode {result.episode_id!r}"
    try:
        entries = list(read_trace(folder, result.episode_id))
    except RunFolderError as error:
        yield str(error)
        return
    ending = next((e.stopped_by for e in entries if isinstance(e, EndEntry)), None)
    walked = next((e for e in entries if isinstance(e, TrajectoryEntry)), None)
    if ending != result.stopped_by or walked is None:
        yield (
            f"{place}: expected a trace that ends with {result.stopped_by}, got {ending}"
        )
        return
    called = {entry.call for entry in entries if isinstance(entry, CallEntry)}
    for call in sorted(name for name in PRIVILEGED_CALLS if name in called):
        yield f"{place}: the trace has the call {call}, which needs answers"
    try:
        walk = arena.finished(
            episode,
            Trajectory([TimedPose(*pose) for pose in walked.poses]),
            result.stopped_by,
            settings.success_distance,
        )
        values = measure_walk(walk)
    except (*_UNSCORABLE, UndefinedMetricError) as error:
        yield f"{place}: the trajectory in the trace cannot be scored ({error!r})"
        return
    for measure in MEASURES:
        if measure.of_walk is None or not measure.is_rechecked:
            continue
        again, said = values[measure.field], getattr(result, measure.field)
        # NaN is near nothing.
        if not abs(again - said) <= ROUNDING:
            yield (
                f"{place}: expected {measure.field} {again:.3f}, as its trajectory "
                f"gives, got {said:.3f}"
            )


def remarks(settings: RunDefinition, results: Iterable[EpisodeResult]) -> Iterator[str]:
    """Say what readers of a leaderboard must know of a run."""
    if "graph" in settings.needs:
        yield "The agent is given the navigation graph of the building."
    if settings.agent.is_own:
        files = agent_version(settings) or "files not known"
        yield (
            "The agent is not part of memorymaze; its code must be published with it: "
            f"{files}."
        )
    development = sum(result.split == "dev" for result in results)
    if development:
        yield (
            f"With {counted(development, 'episode')} on texts that prompts may be built "
            "from (dev)."
        )
