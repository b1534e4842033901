"""Results, settings and runs for the tests of this room."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.evaluation.plan import RunPlan, plan_run
from memorymaze.evaluation.provenance import CodeStamp
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import RunRecord, open_run_folder
from memorymaze.evaluation.settings import (
    AgentSettings,
    FileStamp,
    RunDefinition,
    RunSettings,
    with_choices,
)
from memorymaze.instructions import load_corpus
from memorymaze.simulation import SimulationSettings

TINY_INSTRUCTIONS = Path(__file__).parents[1] / "tiny_instructions.jsonl"


@pytest.fixture
def result() -> Callable[..., EpisodeResult]:
    """Make the result of a successful episode; name the fields that differ."""

    def make(episode_id: str = "a-1", **changes: Any) -> EpisodeResult:
        right = EpisodeResult(
            episode_id=episode_id,
            instruction_id=episode_id,
            site="university",
            route="R1",
            reference_route="route_r1_reference",
            study="online",
            iteration=1,
            participant=episode_id.split("-")[0],
            source="llm",
            split="test",
            agent="rules",
            stopped_by="agent",
            success=True,
            oracle_success=True,
            spd=1.0,
            cls=0.5,
            spl=0.9,
            ndtw=0.8,
            sdtw=0.8,
            path_length=41.5,
            collisions=0,
            turns_in_order=1.0,
            duration_s=60.0,
            wall_s=0.5,
            api_calls=20,
            model_calls=0,
            tokens=0,
            cost_usd=0.0,
            error=None,
        )
        return replace(right, **changes)

    return make


@pytest.fixture
def settings() -> RunDefinition:
    """Settings of a run of two episodes."""
    return RunDefinition(
        agent=AgentSettings("rules"),
        instructions=(FileStamp("some.jsonl", "12ab"),),
        sites=(FileStamp("university", "34cd"),),
        seed=0,
        limit=None,
        episodes=2,
        success_distance=3.0,
        simulation=SimulationSettings(time_budget=529.0),
    )


@pytest.fixture
def record(settings: RunDefinition) -> RunRecord:
    """What `run.json` says of that run."""
    code = CodeStamp("0.1.0", "56ef", "0123456789abcdef", "3.11.0", {"numpy": "2.4"})
    return RunRecord(settings, code, "2026-01-01T00:00:00+00:00")


@pytest.fixture
def tiny_plan(tiny_sites_folder: Path) -> Callable[..., RunPlan]:
    """Plan a run of twelve instructions on three tiny sites."""

    def plan(agent: str, **options: Any) -> RunPlan:
        return plan_run(
            AgentSettings(agent),
            load_corpus([TINY_INSTRUCTIONS], sites=tiny_sites_folder),
            with_choices(RunSettings(), options),
        )

    return plan


@pytest.fixture
def write(tmp_path: Path, record: RunRecord) -> Callable[..., Path]:
    """Write a finished run folder."""

    def finished(
        name: str, results: Sequence[EpisodeResult], episodes: int = 0
    ) -> Path:
        settings = replace(record.settings, episodes=episodes or len(results))
        whole = replace(record, settings=settings)
        with open_run_folder(tmp_path / name, whole, resume=False) as run:
            for one in results:
                run.add(one)
        return tmp_path / name

    return finished
