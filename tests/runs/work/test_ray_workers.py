"""Runs on a Ray cluster, what they bring along, and what they refuse."""

import os
import secrets
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import memorymaze
from memorymaze.basics.errors import SettingsError
from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.language.models.spending import TokenPrice
from memorymaze.runs.episodes.bodies import BodySettings
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace import trace_path
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.episode_worker import EpisodeDone, EpisodeTask, EpisodeWorker
from memorymaze.runs.work.ray_workers import (
    RayWorker,
    RayWorkforce,
    TravellingWorker,
    open_ray_cluster,
    pack_files,
)
from memorymaze.runs.work.run_folder import read_run
from memorymaze.texts.corpus import Corpus

Plan = Callable[..., RunPlan]

# Walks, but first does what a file named after the text's last word says.
OBEDIENT_AGENT = """
import os, pathlib, signal, threading

ORDERS = pathlib.Path({orders!r})

class Obedient:
    name = "obedient"

    def follow(self, instruction, robot, journal, rng):
        robot.move_forward(3 + 8 * rng.random())
        order = ORDERS / instruction.split()[-1].strip(".")
        if order.exists():
            what = order.read_text().split()
            if "always" not in what:
                order.unlink()
            if "interrupt" in what:
                os.kill(int(what[1]), signal.SIGINT)
            if "hang" in what or "interrupt" in what:
                threading.Event().wait()
            os.kill(os.getpid(), signal.SIGKILL)
"""

RAY_START = [
    *("-m", "ray.scripts.scripts", "start", "--head", "--block"),
    *("--num-cpus=2", "--include-dashboard=false", "--disable-usage-stats"),
    "--object-store-memory=100000000",
]
FOREIGN_CODE = """
import sys
from dataclasses import replace
from memorymaze.front.cli.main import run_command_line
from memorymaze.runs.work import ray_workers

stamp = ray_workers.code_stamp()
ray_workers.code_stamp = lambda: replace(stamp, sha256="0" * 64)
sys.exit(run_command_line())
"""


class Cluster(NamedTuple):
    address: str
    environment: dict[str, str]


@pytest.fixture(scope="module")
def cluster() -> Iterator[Cluster]:
    """A Ray cluster of one node with two cores; leaves no process and no file."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    token = secrets.token_hex(32)
    environment = {**os.environ, "RAY_AUTH_MODE": "token", "RAY_AUTH_TOKEN": token}
    # Paths of its sockets must be short.
    folder = tempfile.mkdtemp(prefix="ray", dir="/tmp")
    command = [*RAY_START, f"--port={port}", f"--temp-dir={folder}"]
    head = subprocess.Popen(
        [sys.executable, *command],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        assert head.stdout is not None
        assert any("runtime started" in line for line in head.stdout)
        yield Cluster(f"127.0.0.1:{port}", environment)
    finally:
        head.terminate()
        head.communicate(timeout=60)
        shutil.rmtree(folder, ignore_errors=True)
    assert wait_until_none_has(token) == []


def wait_until_none_has(token: str) -> list[str]:
    """Give processes with a token in their environment ten seconds to end."""
    left: list[str] = []
    for _ in range(100):
        left = []
        for process in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                if token.encode() in (process / "environ").read_bytes():
                    left.append((process / "cmdline").read_text())
        if not left:
            break
        time.sleep(0.1)
    return left


@pytest.fixture
def obedient(tmp_path: Path) -> str:
    """Name of an agent that obeys files in `orders`."""
    (tmp_path / "orders").mkdir()
    path = tmp_path / "obedient.py"
    code = OBEDIENT_AGENT.format(orders=str(tmp_path / "orders"))
    path.write_text(code, encoding="utf-8")
    return f"{path}:Obedient"


def timeless(results: Sequence[EpisodeResult]) -> list[EpisodeResult]:
    return [replace(result, wall_s=0.0) for result in results]


def evaluating(
    cluster: Cluster,
    agent: str,
    files: list[str],
    out: Path,
    *more: str,
    code: str = "",
) -> subprocess.Popen[str]:
    options = [*files, "--out", str(out), "--ray", cluster.address]
    start = ["-c", code] if code else ["-m", "memorymaze"]
    command = [*start, "evaluate", "--agent", agent, *options, *more]
    return subprocess.Popen(
        [sys.executable, *command],
        env=cluster.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


@pytest.mark.proof
def test_a_run_interrupted_and_then_robbed_of_a_worker_equals_the_local_one(
    cluster: Cluster,
    tmp_path: Path,
    obedient: str,
    tiny_plan: Plan,
    tiny_files: list[str],
) -> None:
    whole = run_plan(tiny_plan(obedient), tmp_path / "local", workers=2)
    out = tmp_path / "cluster"
    run = evaluating(cluster, obedient, tiny_files, out)
    (tmp_path / "orders/block").write_text(f"interrupt {run.pid}", encoding="utf-8")
    _, err = run.communicate()
    assert run.returncode == 1
    assert f"--out {out} --ray {cluster.address} --resume" in err
    assert "Traceback" not in err
    assert len(read_run(out)[1]) < len(whole)

    (tmp_path / "orders/block").write_text("die", encoding="utf-8")
    run = evaluating(cluster, obedient, tiny_files, out, "--resume")
    _, err = run.communicate()
    assert run.returncode == 0, err
    assert "2 workers on a Ray cluster of 1 node with 2 cores" in err
    assert not list((tmp_path / "orders").iterdir())
    assert timeless(read_run(out)[1]) == timeless(whole)
    for result in whole:
        one, other = (
            trace_path(tmp_path / name, result.episode_id).read_bytes()
            for name in ("local", "cluster")
        )
        assert one == other


@pytest.mark.proof
def test_episodes_that_hang_or_kill_every_worker_are_recorded_as_crashes(
    cluster: Cluster, tmp_path: Path, obedient: str, tiny_files: list[str]
) -> None:
    (tmp_path / "orders/block").write_text("always die", encoding="utf-8")
    (tmp_path / "orders/once").write_text("always hang", encoding="utf-8")
    out = tmp_path / "run"
    run = evaluating(cluster, obedient, tiny_files, out, "--with", "wall_limit=3")
    assert run.communicate()[0].startswith(f"run {out}\n")
    results = {each.episode_id: each for each in read_run(out)[1]}
    assert len(results) == 12
    crashes = {
        name: each.error for name, each in results.items() if each.stopped_by == "crash"
    }
    lost = "WorkerLost: the worker process"
    assert crashes == {
        "p6-1": f"{lost} died on the cluster, or its node did",
        "p6-2": f"{lost} took longer than the 3 s a task may",
    }


@pytest.mark.proof
def test_workers_with_other_code_are_refused(
    cluster: Cluster, tmp_path: Path, tiny_files: list[str]
) -> None:
    run = evaluating(cluster, "stop", tiny_files, tmp_path / "run", code=FOREIGN_CODE)
    _, err = run.communicate()
    assert run.returncode == 2
    said = f"has other code than this machine:\n  memorymaze's code: {memorymaze.__version__}"
    assert said in err
    assert "files 000000000000 here" in err
    assert "Traceback" not in err


@pytest.mark.proof
def test_more_workers_than_the_cluster_has_cores_are_refused(
    cluster: Cluster, tmp_path: Path, tiny_files: list[str]
) -> None:
    out = tmp_path / "run"
    run = evaluating(cluster, "stop", tiny_files, out, "--workers", "3")
    _, err = run.communicate()
    assert run.returncode == 2
    assert "at least 3 cores, one for each worker, got 2 on 1 node;" in err
    assert not out.exists()


@pytest.mark.parametrize(
    ("agent", "message"),
    [
        pytest.param(
            {"language_model": ModelSettings(price=TokenPrice(1, 2), max_cost=5)},
            "--max-cost and --ray: .* what all have spent; leave --ray out",
            id="cost",
        ),
        pytest.param(
            {"language_model": ModelSettings(max_tokens_total=5)},
            "max_tokens_total and --ray",
            id="tokens",
        ),
        pytest.param(
            {"language_model": ModelSettings(max_requests=5)},
            "give --workers 5",
            id="requests",
        ),
        pytest.param(
            {"language_model": ModelSettings(base_url="http://localhost:8000/v1")},
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
        RayWorkforce(workers=2, cores=4, nodes=2).check(asking)


def test_an_address_of_ones_own_serves_a_cluster_of_one_node(
    settings: RunSettings,
) -> None:
    agent = AgentSettings(
        "navgpt", language_model=ModelSettings(base_url="http://localhost:8000/v1")
    )
    RayWorkforce(2, cores=4, nodes=1).check(replace(settings, agent=agent))


AGENT = """
from names_of_travellers import NAME
from memorymaze.agents.stop import StopAgent

class Traveller(StopAgent):
    name = NAME
"""


def test_an_agents_files_are_needed_no_more_once_they_are_packed(
    tmp_path: Path, tiny_plan: Plan, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    file, beside = tmp_path / "traveller.py", tmp_path / "names_of_travellers.py"
    file.write_text(AGENT, encoding="utf-8")
    beside.write_text("NAME = 'traveller'", encoding="utf-8")
    plan = tiny_plan(f"{file}:Traveller")
    worker = EpisodeWorker.of(plan)
    prepare = TravellingWorker(worker, pack_files(plan.settings))
    file.unlink()
    beside.unlink()
    monkeypatch.delitem(sys.modules, "names_of_travellers")
    done, recorded = prepare()(EpisodeTask(plan.episodes[0]))
    assert recorded == b""
    assert isinstance(done, EpisodeDone)
    assert done.result.agent == "traveller"


def test_code_of_ones_own_travels_whatever_its_role(
    tmp_path: Path, tiny_plan: Plan
) -> None:
    """A robot's body and a detector too, each beside a file of the same name."""
    code = "class Finder:\n    def find(self, rgb, query):\n        return []\n"
    for role in ("robot", "detector"):
        (tmp_path / role).mkdir()
        (tmp_path / role / "mine.py").write_text(code, encoding="utf-8")
    file = tmp_path / "detector" / "mine.py"
    plan = tiny_plan("stop", detector=f"{file}:Finder")
    robot = BodySettings(f"{tmp_path / 'robot' / 'mine.py'}:Finder")
    packed = pack_files(replace(plan.settings, robot=robot, looks=None))
    assert packed == dict.fromkeys(("robot/mine.py", "detector/mine.py"), code.encode())
    prepare = TravellingWorker(EpisodeWorker.of(plan), pack_files(plan.settings))
    file.unlink()
    done, _ = prepare()(EpisodeTask(plan.episodes[0]))
    assert isinstance(done, EpisodeDone)


def test_a_file_of_answers_travels(tmp_path: Path, settings: RunSettings) -> None:
    (tmp_path / "answers.jsonl").write_bytes(b"answers")
    agent = AgentSettings(
        "code_generation",
        language_model=ModelSettings(replay=str(tmp_path / "answers.jsonl")),
    )
    assert pack_files(replace(settings, agent=agent)) == {
        "replay/answers.jsonl": b"answers",
    }


def test_answers_recorded_on_other_machines_come_back_and_are_not_asked_for_again(
    tmp_path: Path, tiny_corpus: Corpus, monkeypatch: pytest.MonkeyPatch
) -> None:
    models: list[ScriptedLanguageModel] = []

    def server(*_: object) -> ScriptedLanguageModel:
        models.append(ScriptedLanguageModel(lambda _: "stop()", name="m"))
        return models[-1]

    monkeypatch.setattr("memorymaze.language.models.building._server", server)
    record = tmp_path / "answers.jsonl"
    plan = plan_run(
        AgentSettings(
            "code_generation",
            options=(("parser", "false"),),
            language_model=ModelSettings(model="m", record=str(record)),
        ),
        tiny_corpus,
    )
    # What Ray brings is what an actor returned.
    monkeypatch.setattr("ray.get", lambda reply: ("done", reply))
    tasks = [EpisodeTask(episode) for episode in plan.episodes[:2]]
    for task in (*tasks, tasks[0]):
        files = pack_files(plan.settings)
        there = TravellingWorker(EpisodeWorker.of(plan), files)()
        done = RayWorker(None, there(task), record).receive()
        assert isinstance(done, EpisodeDone)
        assert done.result.model_calls == 1

    asked = {each.episode.instruction.id for each in tasks}
    assert {name for name, _ in AnswerFile(record).stages()} == asked
    assert len(record.read_text(encoding="utf-8").splitlines()) == 2
    assert sum(len(model.requests) for model in models) == 2


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
