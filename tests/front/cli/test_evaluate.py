import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.runs.episodes.agent_catalogue import agent_names
from memorymaze.runs.work.run_folder import read_run

Memorymaze = Callable[..., Any]


def test_oracle_and_stop_run_from_files_to_tables(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    for agent in ("oracle", "stop"):
        said = memorymaze(
            "evaluate", "--agent", agent, *tiny_files, "--out", tmp_path / agent
        )
        assert said.code == 0
        assert "12 written by people" in said.out
        assert "12 of 12 episodes" in said.err
        assert "way described (at most 119 s)" in said.err
    rates = [
        {result.success for result in read_run(tmp_path / agent)[1]}
        for agent in ("oracle", "stop")
    ]
    assert rates == [{True}, {False}]
    summary = json.loads((tmp_path / "oracle/summary.json").read_text(encoding="utf-8"))
    assert summary["mean"]["success"] == 1.0
    assert len(list((tmp_path / "oracle/traces").iterdir())) == 12
    said = memorymaze(
        "table", tmp_path / "oracle", tmp_path / "stop", "--table", "both"
    )
    assert said.code == 0
    assert "Corridor R1, iteration 2" in said.out
    assert said.err == ""


def test_a_shard_to_which_no_episode_falls_is_done(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    some = ["--limit", "1", "--with", "shard=2/2", "--out", tmp_path / "run"]
    said = memorymaze("evaluate", "--agent", "stop", *tiny_files, *some)
    assert said.code == 0
    assert "no episode falls to this shard" in said.out


def test_a_limit_spreads_over_the_files_and_can_be_resumed_only_as_it_was(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    command = ["evaluate", "--agent", "stop", *tiny_files, "--out", str(tmp_path)]
    assert memorymaze(*command, "--limit", "3", "--workers", "1").code == 0
    assert {result.site for result in read_run(tmp_path)[1]} == {
        "corridor",
        "loop",
        "t_junction",
    }
    said = memorymaze(*command, "--limit", "4", "--resume")
    assert said.code == 1
    assert "limit: 3 there, 4 here" in said.err
    said = memorymaze(*command, "--limit", "3")
    assert said.code == 1
    assert "add --resume" in said.err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        pytest.param(["--agent", "rulez"], "expected one of", id="agent"),
        pytest.param(["--workers", "-1"], "--workers: expected 0", id="workers"),
        pytest.param(["--seed", "-1"], "seed: expected a whole number", id="seed"),
        pytest.param(["--limit", "0"], "limit: expected", id="limit"),
        pytest.param(["--with", "time_budget=0"], "time_budget", id="time"),
        pytest.param(["--with", "call_budget=0"], "call_budget", id="calls"),
        pytest.param(
            ["--with", "success_distance=nan"], "success_distance", id="distance"
        ),
        pytest.param(["--resume"], "--resume: name the run's folder", id="resume"),
        pytest.param(["--model", "gpt"], "asks no language model", id="model"),
    ],
)
def test_an_option_without_meaning_gives_code_2_and_one_message(
    memorymaze: Memorymaze,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = memorymaze("evaluate", "--agent", "stop", *arguments)
    assert done.code == 2
    assert done.out == ""
    assert said in done.err
    assert done.err.startswith("memorymaze: ")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("option", "content", "said"),
    [
        pytest.param("--instructions", "{bad", ":1: expected JSON", id="line"),
        pytest.param("--sites", "x", "got a file", id="sites"),
    ],
)
def test_a_bad_file_gives_code_1_and_its_name(
    memorymaze: Memorymaze, tmp_path: Path, option: str, content: str, said: str
) -> None:
    path = tmp_path / "bad"
    path.write_text(content, encoding="utf-8")
    out = tmp_path / "out"
    done = memorymaze("evaluate", "--agent", "stop", option, path, "--out", out)
    assert done.code == 1
    assert str(path) in done.err
    assert said in done.err
    assert not out.exists()


def test_the_help_says_where_every_agent_is_listed(memorymaze: Memorymaze) -> None:
    assert "`memorymaze agents`" in memorymaze("evaluate", "--help").out
    text = memorymaze("agents").out
    assert all(f"\n{name}: " in f"\n{text}" for name in agent_names())


def test_the_source_of_turning_points_is_a_setting_of_a_run(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    command = ["evaluate", "--agent", "stop", *tiny_files, "--limit", "2"]
    command += ["--workers", "1", "--out", tmp_path / "run", "--with"]
    wrong = memorymaze(*command, "turning_points=radar")
    assert wrong.code == 2
    assert "annotated or lidar" in wrong.err
    assert "'radar'" in wrong.err
    said = memorymaze(*command, "turning_points=lidar")
    assert said.code == 0
    assert "TURNING POINTS BY LIDAR" in said.out
    simulation = read_run(tmp_path / "run")[0].settings.simulation
    assert simulation.turning_points == "lidar"
    refused = memorymaze(*command, "turning_points=annotated", "--resume")
    assert "simulation.turning_points: 'lidar' there, 'annotated' here" in refused.err


def test_obstacles_are_settings_of_a_run(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    command = ["evaluate", "--agent", "stop", *tiny_files, "--limit", "2"]
    command += ["--workers", "1", "--obstacles"]
    said = memorymaze(*command, "--out", tmp_path / "bare")
    assert said.code == 0
    assert "TRACK WITH OBSTACLES AND PEOPLE" in said.out
    assert memorymaze(*command, "people=1,seed=3", "--out", tmp_path / "own").code == 0
    bare, own = (
        read_run(tmp_path / name)[0].settings.obstacles for name in ("bare", "own")
    )
    assert bare is not None
    assert own is not None
    assert (bare.things_per_100m, bare.seed) == (4.0, 0)
    assert (own.people, own.seed) == (1, 3)
    said = memorymaze(*command, "many", "--out", tmp_path / "none")
    assert "light, medium, heavy" in said.err
    assert said.code != 0


def test_the_help_begins_with_what_most_runs_need(memorymaze: Memorymaze) -> None:
    text = memorymaze("evaluate", "--help").out
    flags = [line.split()[0] for line in text.splitlines() if line.startswith("  --")]
    assert flags[:5] == ["--agent", "--limit", "--out", "--resume", "--workers"]
    for group in ("what is followed:", "language model:", "how episodes are run:"):
        assert f"\n{group}\n" in text


def test_turns_that_are_refused_show_in_the_summary(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    own = tmp_path / "own.py"
    own.write_text(
        "class Mine:\n"
        "    name = 'mine'\n\n"
        "    def follow(self, instruction, robot, journal, rng):\n"
        "        robot.turn('leftish')\n",
        encoding="utf-8",
    )
    out = tmp_path / "out"
    done = memorymaze(
        "evaluate",
        "--agent",
        f"{own}:Mine",
        "--limit",
        "1",
        "--workers",
        "1",
        "--out",
        out,
    )
    assert "1 turn refused" in done.out


def test_an_option_without_a_meaning_is_the_agents_fault(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    own = tmp_path / "own.py"
    own.write_text(
        "from dataclasses import dataclass\n\n"
        "@dataclass(frozen=True)\n"
        "class Options:\n"
        "    stride: float = 0.5\n\n"
        "class Mine:\n"
        "    name = 'mine'\n"
        "    Options = Options\n",
        encoding="utf-8",
    )
    done = memorymaze("agents", f"{own}:Mine")
    assert done.code == 2
    assert "Options.stride: expected a default and a string beneath" in done.err
    assert "fault of memorymaze" not in done.err
