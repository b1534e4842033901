"""What a run on a cluster brings along, and what it refuses before it begins."""

import socket
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.errors import SettingsError
from memorymaze.evaluation.asking import AskingSettings
from memorymaze.evaluation.episode_worker import EpisodeDone, EpisodeTask
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.ray_cluster import open_ray_cluster
from memorymaze.evaluation.settings import AgentSettings, RunSettings
from memorymaze.evaluation.travelling_files import (
    TravellingWorker,
    check_can_travel,
    pack_files,
)
from memorymaze.language.spending import TokenPrice


@pytest.mark.parametrize(
    ("agent", "message"),
    [
        pytest.param(
            {"asking": AskingSettings(TokenPrice(1, 2), max_cost=5)},
            "--max-cost and --ray: .* set the limit at the server, or leave --ray out",
            id="cost",
        ),
        pytest.param(
            {"asking": AskingSettings(max_tokens_total=5)},
            "--max-tokens-total and --ray",
            id="tokens",
        ),
        pytest.param(
            {"asking": AskingSettings(max_requests=5)},
            "give --workers 5",
            id="requests",
        ),
        pytest.param(
            {"record": "replies.sqlite"}, "--record and --ray: one file", id="record"
        ),
        pytest.param(
            {"options": (("captions", "vision"),)}, "captions and --ray", id="captions"
        ),
        pytest.param(
            {"base_url": "http://localhost:8000/v1"},
            "on a cluster of 2 nodes this is every node itself",
            id="own address",
        ),
    ],
)
def test_what_several_machines_cannot_keep_together_is_refused(
    settings: RunSettings, agent: dict[str, Any], message: str
) -> None:
    asking = replace(settings, agent=AgentSettings("navgpt", **agent))
    with pytest.raises(SettingsError, match=message):
        check_can_travel(asking, nodes=2)


def test_an_address_of_ones_own_serves_a_cluster_of_one_node(
    settings: RunSettings,
) -> None:
    agent = AgentSettings("navgpt", base_url="http://localhost:8000/v1")
    check_can_travel(replace(settings, agent=agent), nodes=1)


AGENT = """
from memorymaze.agents import StopAgent

class Traveller(StopAgent):
    name = "traveller"
"""


def test_an_agents_file_is_needed_no_more_once_it_is_packed(
    tmp_path: Path, tiny_plan: Callable[..., RunPlan]
) -> None:
    file = tmp_path / "traveller.py"
    file.write_text(AGENT, encoding="utf-8")
    plan = tiny_plan(f"{file}:Traveller")
    prepare = TravellingWorker(plan.settings, plan.sites, pack_files(plan.settings))
    file.unlink()
    done = prepare()(EpisodeTask(plan.episodes[0]))
    assert isinstance(done, EpisodeDone)
    assert done.result.agent == "traveller"


def test_programs_and_recorded_replies_travel(
    tmp_path: Path, settings: RunSettings
) -> None:
    (tmp_path / "programs.jsonl").write_bytes(b"programs")
    (tmp_path / "replies.sqlite").write_bytes(b"replies")
    agent = AgentSettings(
        "code_generation",
        programs=str(tmp_path / "programs.jsonl"),
        replay=str(tmp_path / "replies.sqlite"),
    )
    assert pack_files(replace(settings, agent=agent)) == {
        "programs": ("programs.jsonl", b"programs"),
        "replay": ("replies.sqlite", b"replies"),
    }


def test_a_cluster_that_is_not_there_is_told_at_once() -> None:
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{unused.getsockname()[1]}"
        with (
            pytest.raises(SettingsError, match=f"--ray {address}: nothing answers"),
            open_ray_cluster(address),
        ):
            pass


@pytest.mark.parametrize("address", ["nonsense", "host:", ":6379", "host:port", "h:0"])
def test_what_is_no_address_is_refused(address: str) -> None:
    with (
        pytest.raises(SettingsError, match="--ray: expected auto, local, HOST:PORT"),
        open_ray_cluster(address),
    ):
        pass


def test_without_ray_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with (
        pytest.raises(SettingsError, match=r"pip install 'memorymaze\[ray\]'"),
        open_ray_cluster("auto"),
    ):
        pass
