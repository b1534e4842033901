"""Runs of the benchmark on a stand-in for CARLA."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.work.driver import run_plan
from memorymaze.texts.corpus import Corpus, load_corpus

ROBOT = str(Path(__file__).with_name("stand_in_robot.py"))
PROGRAMS = Path("examples/recorded/programs_without_parser.jsonl")


def outcomes(results: list[EpisodeResult]) -> dict[str, tuple[str, bool]]:
    return {each.episode_id: (each.stopped_by, each.success) for each in results}


def on_carla(plan: RunPlan, factory: str = "factory") -> RunPlan:
    settings = with_choices(plan.settings, {"robot": f"{ROBOT}:{factory}"})
    return replace(plan, settings=replace(plan.settings, robot=settings.robot))


@pytest.mark.proof
@pytest.mark.parametrize("agent", ["oracle", "guide"])
def test_episodes_end_in_carla_as_they_do_in_the_simulation(
    agent: str, tiny_plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    plan = tiny_plan(agent, limit=3)
    here = run_plan(plan, tmp_path / "here", workers=1)
    there = run_plan(on_carla(plan), tmp_path / "there")
    assert outcomes(there) == outcomes(here)
    assert not any(each.by_odometry for each in there)


def test_a_server_that_dies_costs_its_episode_and_not_the_run(
    tiny_plan: Callable[..., RunPlan], tmp_path: Path
) -> None:
    plan = tiny_plan("oracle", limit=3)
    results = run_plan(on_carla(plan, "second_dies"), tmp_path / "run")
    ends = [each.stopped_by for each in results]
    assert (ends.count("crash"), ends.count("agent")) == (1, 2)
    [lost] = [each for each in results if each.stopped_by == "crash"]
    assert "CARLA at localhost:2000" in (lost.error or "")


@pytest.mark.proof
def test_a_run_that_is_killed_is_resumed(tiny_files: list[str], tmp_path: Path) -> None:
    out = tmp_path / "run"
    command = [
        *(sys.executable, "-m", "memorymaze", "evaluate", "--agent", "oracle"),
        *("--robot", f"{ROBOT}:factory", *tiny_files, "--resume", "--out", str(out)),
    ]
    running = subprocess.Popen(command, start_new_session=True)
    while running.poll() is None:
        done = out / "episodes.jsonl"
        if done.exists() and done.read_bytes().count(b"\n") >= 3:
            os.killpg(running.pid, signal.SIGKILL)
            break
    assert running.wait() == -signal.SIGKILL
    subprocess.run(command, check=True)
    assert (out / "episodes.jsonl").read_bytes().count(b"\n") == 12


def texts_with_a_program(folder: Path) -> Corpus:
    """Return the shipped texts that the recorded programs were written for."""
    lines = PROGRAMS.read_text(encoding="utf-8").splitlines()
    wanted = {json.loads(line)["instruction_id"] for line in lines}
    told = [
        line
        for file in load_corpus().files
        for line in file.read_text(encoding="utf-8").splitlines()
        if json.loads(line)["id"] in wanted
    ]
    (folder / "texts.jsonl").write_text("\n".join(told), encoding="utf-8")
    return load_corpus([folder / "texts.jsonl"])


@pytest.mark.proof
@pytest.mark.parametrize(
    ("agent", "replay"), [("guide", None), ("code_generation", PROGRAMS)]
)
def test_of_24_shipped_texts_at_least_22_end_as_in_the_simulation(
    agent: str, replay: Path | None, tmp_path: Path
) -> None:
    model = ModelSettings(replay=None if replay is None else str(replay))
    plan = plan_run(
        AgentSettings(agent, language_model=model),
        texts_with_a_program(tmp_path),
        RunSettings(limit=24),
    )
    here = outcomes(run_plan(plan, tmp_path / "here"))
    there = outcomes(run_plan(on_carla(plan), tmp_path / "there"))
    assert sum(here[name] == there[name] for name in here) >= 22
