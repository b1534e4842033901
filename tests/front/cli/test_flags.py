"""Settings as the command line takes them, and those of a language model."""

from argparse import ArgumentParser
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from memorymaze.front.cli.flags import add_flags
from memorymaze.robot.simulation.obstacles import ObstacleSettings, parse_obstacles
from memorymaze.runs.work.run_folder import read_run

Memorymaze = Callable[..., Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class IceSettings:
    """Settings, as a run has them."""

    obstacles: ObstacleSettings | None = field(
        default=None,
        metadata={"metavar": "KINDS", "alone": "medium", "reader": parse_obstacles},
    )
    """what lies on it; any kinds"""
    friction: float = field(default=0.5, metadata={"metavar": "SHARE"})
    """how well wheels hold, 0 to 1"""
    thaws: float = 0.0
    """No option of its own."""


def test_a_setting_with_a_metavar_becomes_an_option_with_its_help() -> None:
    parser = ArgumentParser()
    add_flags(parser.add_argument, IceSettings)

    said = " ".join(parser.format_help().split())
    assert "--friction SHARE how well wheels hold, 0 to 1 (default: 0.5)" in said
    assert said.endswith(
        "--obstacles [KINDS] what lies on it --friction SHARE how well wheels hold, 0 to 1 (default: 0.5)"
    )
    options = parser.parse_args(["--friction", "0.1", "--obstacles"])
    assert (options.friction, options.obstacles) == ("0.1", "medium")
    assert not hasattr(options, "thaws")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--seed", "x"], "--seed: expected a whole number, got 'x'"),
        (["--seed", "-1"], "seed: expected a whole number of at least 0, got -1"),
        (["--with", "signs=OCR"], "--with signs: expected truth or ocr, got 'OCR'"),
        (["--with", "turning_points=map"], "turning_points: expected annotated or"),
        (["--with", "detector=truht"], "did you mean 'truth'"),
        (["--obstacles", "few"], "obstacles: expected a level (light, medium, heavy)"),
        (["--with", "shard=9/8"], "shard: expected one from 1/8 to 8/8, got 9/8"),
        (["--with", "sings=ocr"], "got 'sings'; did you mean 'signs'?"),
        (["--with", "signs"], "--with: expected NAME=VALUE, got 'signs'"),
        (["--seed", "1", "--with", "seed=2"], "--with seed: given twice"),
    ],
)
def test_a_setting_without_meaning_is_wrong_usage(
    memorymaze: Memorymaze, options: list[str], message: str, tmp_path: Path
) -> None:
    said = memorymaze("evaluate", "--agent", "stop", *options, "--out", tmp_path / "x")
    assert said.code == 2
    assert message in said.err
    assert not (tmp_path / "x").exists()


@pytest.fixture
def server(chat_server: Callable[..., Any]) -> str:
    """Address of a server whose model always stops at once."""
    return chat_server(lambda _: "```\nstop()\n```", "fake-1", (900, 100))[0]


@pytest.mark.proof
def test_a_paid_run_is_estimated_ends_at_its_limit_and_goes_on(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path, server: str
) -> None:
    out = tmp_path / "paid"
    command = ["evaluate", "--agent", "code_generation", *tiny_files]
    command += ["--set", "parser=false"]
    command += ["--model", "m", "--base-url", server, "--workers", "1", "--out", out]
    command += ["--price", "1000,1000", "--with", "inference_time=1.5"]
    said = memorymaze(*command, "--max-cost", "1.5")
    assert said.code == 1
    assert "an ESTIMATE for 12 requests" in said.err
    assert "2.0000 USD are spent, of 1.5 allowed with --max-cost; raise it" in said.err
    assert "2 of 12 episodes are finished and kept" in said.err
    said = memorymaze(*command, "--resume")
    assert said.code == 0
    assert "12 calls, 12000 tokens, 12.0000 USD" in said.out
    assert "the user stands waiting 1.5 s per episode" in said.out
    record, results = read_run(out)
    assert record.settings.agent.language_model.shared_folder is None
    assert {one.standing_s for one in results} == {1.5}
    table = memorymaze("table", out).out
    assert "standing time per reply is 1.5 s, not the latency measured" in table


def test_navigate_says_what_the_model_took(
    memorymaze: Memorymaze, tmp_path: Path, server: str
) -> None:
    said = memorymaze(
        *("navigate", "university", "R1", "Stop at once.", "--out", tmp_path / "one"),
        *("--agent", "code_generation", "--set", "parser=false", "--model", "m"),
        *("--base-url", server, "--price", "10,20", "--with", "inference_time=2"),
    )
    assert said.code == 0
    assert "1 call, 1000 tokens, 0.0110 USD" in said.out
    assert "the user stands waiting 2.0 s" in said.out


@pytest.mark.parametrize(
    ("agent", "options", "message"),
    [
        ("guide", ["--price", "1,2"], "--price: the agent 'guide' asks no language"),
        (
            "stop",
            ["--with", "inference_time=2"],
            "--with inference_time: the agent 'stop' asks",
        ),
        (
            "oracle",
            ["--with", "max_requests=2"],
            "--with max_requests: the agent 'oracle' asks",
        ),
        (
            "code_generation",
            ["--max-cost", "1"],
            "give the server's prices with --price",
        ),
        ("code_generation", ["--price", "cheap"], "expected PROMPT,COMPLETION"),
        (
            "code_generation",
            ["--with", "inference_time=long"],
            "expected measured, none",
        ),
        (
            "code_generation",
            ["--with", "retries=-1"],
            "retries: expected a whole number of at least 0",
        ),
        ("code_generation", ["--model", "gguf:no.gguf"], "no.gguf cannot be read"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_what_has_no_meaning_is_wrong_usage(
    memorymaze: Memorymaze, agent: str, options: list[str], message: str, tmp_path: Path
) -> None:
    said = memorymaze("evaluate", "--agent", agent, *options, "--out", tmp_path / "x")
    assert said.code == 2
    assert message in said.err
    assert "Traceback" not in said.err
    assert not (tmp_path / "x").exists()
