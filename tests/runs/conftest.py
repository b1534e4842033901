"""Runs over tiny sites."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.robot.simulation.obstacles import parse_obstacles
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.episode import run_episode
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.provenance import CodeStamp
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace import keep_trace, trace_content
from memorymaze.runs.story import RecordedEpisode, load_episode
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder, read_run
from memorymaze.texts.corpus import Corpus


def _run(folder: Path, corpus: Corpus, **settings: Any) -> Path:
    """Run two episodes in this process, which is quicker than starting workers."""
    plan = plan_run(
        AgentSettings("guide"),
        corpus,
        with_choices(RunSettings(limit=2), settings),
    )
    code = CodeStamp(version="0", sha256="0", commit=None, python="3", packages={})
    record = RunRecord(plan.settings, code, "2026-01-01T00:00:00+00:00")
    told = {each.instruction.id: each.instruction for each in plan.episodes}
    with open_run_folder(
        folder,
        record,
        resume=False,
        sites=plan.sites.values(),
        instructions=told.values(),
    ) as run:
        for episode in plan.episodes:
            site = plan.sites[episode.instruction.site]
            arena = Arena(site, plan.settings.obstacles)
            agent = plan.ready.in_episode(episode)
            done = run_episode(agent, episode, arena, plan.settings)
            keep_trace(folder, episode.id, trace_content(done.trace))
            run.add(done.result)
    return folder


@pytest.fixture(scope="session")
def tiny_run(tmp_path_factory: pytest.TempPathFactory, tiny_corpus: Corpus) -> Path:
    """A run of two episodes by `guide`."""
    return _run(tmp_path_factory.mktemp("runs") / "tiny", tiny_corpus)


@pytest.fixture(scope="session")
def crowded_run(tmp_path_factory: pytest.TempPathFactory, tiny_corpus: Corpus) -> Path:
    """The same with things in the way and people."""
    return _run(
        tmp_path_factory.mktemp("runs") / "crowded",
        tiny_corpus,
        obstacles=parse_obstacles("heavy"),
    )


@pytest.fixture(scope="session")
def episode(tiny_run: Path) -> RecordedEpisode:
    """The first episode of the run."""
    return load_episode(tiny_run, episode_ids(tiny_run)[0])


@pytest.fixture(scope="session")
def crowded_episode(crowded_run: Path) -> RecordedEpisode:
    """The first episode of the run with people."""
    return load_episode(crowded_run, episode_ids(crowded_run)[0])


def episode_ids(run: Path) -> list[str]:
    return [result.episode_id for result in read_run(run)[1]]


@pytest.fixture
def keep(tmp_path: Path, record: RunRecord) -> Callable[..., Path]:
    """Write a run with settings of its own."""

    def write(name: str, results: list[EpisodeResult], **settings: Any) -> Path:
        changed = replace(record.settings, episodes=len(results), **settings)
        with open_run_folder(
            tmp_path / name, replace(record, settings=changed), resume=False
        ) as run:
            for each in results:
                run.add(each)
        return tmp_path / name

    return write
