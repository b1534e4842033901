"""Workers on a Ray cluster, and the files that travel to them; needs the extra `ray`.

No file system has to be shared: files that a run names are read where it is driven and
written into a folder of each worker. The driver alone writes the run folder.
"""

import atexit
import pickle
import shutil
import socket
import tempfile
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal

import ray
from ray.exceptions import RayError

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.own_code import own_files
from memorymaze.basics.processes import available_cores
from memorymaze.basics.wording import counted
from memorymaze.language.models.answer_files import append_answers
from memorymaze.runs.episodes.provenance import code_stamp
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.runs.work.episode_worker import (
    EpisodeOutcome,
    EpisodeTask,
    EpisodeWorker,
)
from memorymaze.runs.work.worker_pool import LEAVING_TIME, WorkerDied
from memorymaze.world.looks import file_of_looks

ANSWER_TIME = 10.0
"""Seconds that the cluster's address has for taking a connection."""

LOOPBACK = ("//localhost", "//127.", "//[::1]")


@contextmanager
def open_ray_cluster(address: str, workers: int = 0) -> Generator["RayWorkforce"]:
    """Connect to the cluster at `HOST:PORT`, `ray://HOST:PORT` or `auto`; leave at the end.

    `local` starts one on this machine, for this run only. Workers have one core each; 0
    stands for one per core of the cluster. A connection that this process has already
    is used and kept.
    """
    ours = not ray.is_initialized()
    if ours:
        _connect(address, workers)
    try:
        cores = int(ray.cluster_resources().get("CPU", 0))
        nodes = sum(1 for node in ray.nodes() if node["Alive"])
        if cores < max(1, workers):
            raise SettingsError(
                f"--ray {address}: expected a cluster with at least {max(1, workers)} "
                f"cores, one for each worker, got {cores} on {counted(nodes, 'node')}; "
                "give a smaller --workers, or add nodes with `ray start --address`"
            )
        yield RayWorkforce(workers or cores, cores, nodes)
    finally:
        if ours:
            ray.shutdown()


def _connect(address: str, workers: int) -> None:
    options: dict[str, Any] = {"log_to_driver": False, "logging_level": "ERROR"}
    if address == "local":
        options |= {
            "num_cpus": workers or available_cores(),
            "include_dashboard": False,
            # Its default is a third of the memory, and sites and traces are small.
            "object_store_memory": 200_000_000,
        }
    elif address != "auto":
        _check_answers(address)
    try:
        ray.init(address=address, **options)
    except (Exception, SystemExit) as error:
        # Ray ends the process where it finds something else than a cluster.
        said = str(error).partition("\n")[0].strip("0123456789.")
        raise SettingsError(
            f"--ray {address}: cannot be used as a Ray cluster"
            f"{f' ({said})' if said else ''}. See on its head with `ray status` whether "
            "it runs; Ray and Python must be of the same versions here and there, and a "
            "cluster that asks for a token needs RAY_AUTH_MODE=token and RAY_AUTH_TOKEN"
        ) from None


def _check_answers(address: str) -> None:
    """See whether anything listens there; Ray itself would try for minutes."""
    host, colon, port = address.removeprefix("ray://").rpartition(":")
    if not (host and colon and port.isdigit() and 0 < int(port) < 65536):
        raise SettingsError(
            f"--ray: expected auto, local, HOST:PORT or ray://HOST:PORT, got {address!r}"
        )
    try:
        socket.create_connection((host.strip("[]"), int(port)), ANSWER_TIME).close()
    except OSError as error:
        raise SettingsError(
            f"--ray {address}: nothing answers there ({error.strerror or error}); "
            "`ray start --head` on the cluster's head prints its address"
        ) from None


@dataclass(frozen=True, slots=True)
class RayWorkforce:
    """Workers, with one core each, on the cluster that this process is connected to."""

    workers: int
    cores: int
    nodes: int

    def __str__(self) -> str:
        """Say how many there are, and where."""
        workers, nodes = counted(self.workers, "worker"), counted(self.nodes, "node")
        cores = counted(self.cores, "core")
        return f"{workers} on a Ray cluster of {nodes} with {cores}"

    def check(self, settings: RunDefinition) -> None:
        """Refuse settings that only processes of one machine can keep together."""
        model = settings.agent.language_model
        here = "leave --ray out: workers on this machine (--workers N) keep it together"
        limit = f"workers on several machines do not know what all have spent; {here}"
        requests = (
            f"every worker has one under way; give --workers {model.max_requests}"
        )
        for option, given, reason in (
            ("--max-cost", model.max_cost is not None, limit),
            ("max_tokens_total", model.max_tokens_total is not None, limit),
            ("max_requests", model.max_requests is not None, requests),
        ):
            if given:
                raise SettingsError(f"{option} and --ray: {reason}")
        for option, url in (
            ("--base-url", model.base_url),
            ("detector", settings.detector.options),
        ):
            own = any(part in (url or "") for part in LOOPBACK)
            if own and self.nodes > 1:
                raise SettingsError(
                    f"{option} {url}: on a cluster of {self.nodes} nodes this is every node "
                    "itself; give the server's address in the network"
                )

    def source(
        self, prepare: EpisodeWorker, folder: Path, episodes: int
    ) -> "RaySource":
        """Return where workers come from; no more of them than there are episodes."""
        settings = prepare.settings
        travelling = TravellingWorker(prepare, pack_files(settings))
        record = settings.agent.language_model.record
        return RaySource(travelling, min(self.workers, episodes), record)


class RaySource:
    """Starts actors that prepare themselves in the same way, with the driver's code."""

    starting_limit = 300.0
    advice = "see with `ray status` whether cores are free; logs on the nodes: /tmp/ray"

    def __init__(
        self, prepare: "TravellingWorker", count: int, record: str | None
    ) -> None:
        """Lay down once, for the whole cluster, what each node fetches."""
        self.count = count
        self._record = None if record is None else Path(record)
        self._host = ray.remote(_host_class()).options(num_cpus=1, max_restarts=0)
        self._packed = ray.put(pickle.dumps(prepare))

    def start(self) -> "RayWorker":
        """Start an actor, which Ray puts where a core is free."""
        actor = self._host.remote()
        reply = actor.prepare.remote(asdict(code_stamp()), self._packed)
        return RayWorker(actor, reply, self._record)

    def wait(self, workers: Sequence["RayWorker"], seconds: float) -> list["RayWorker"]:
        """Return those whose reply is there."""
        there = ray.wait([worker.reply for worker in workers], timeout=seconds)[0]
        return [worker for worker in workers if worker.reply in there]


@dataclass(eq=False)
class RayWorker:
    """An actor, and the reference to what it was asked for last."""

    actor: Any
    reply: Any
    record: Path | None = None
    """Where answers go that were recorded for the episode."""

    def send(self, task: EpisodeTask) -> None:
        """Ask for the outcome of a task."""
        self.reply = self.actor.do.remote(task)

    def receive(self) -> EpisodeOutcome | Literal["ready"]:
        """Take the reply that is there."""
        try:
            said, content = ray.get(self.reply)
        except RayError:
            # No more than this: results must not depend on names of nodes.
            reason = "the worker process died on the cluster, or its node did"
            raise WorkerDied(reason) from None
        if said == "refused":
            raise SettingsError(content)
        if said == "ready":
            return "ready"
        outcome, recorded = content
        if recorded and self.record is not None:
            append_answers(self.record, recorded)
        return outcome

    def end(self, *, at_once: bool) -> None:
        """End the actor, wherever it is."""
        if at_once:
            ray.kill(self.actor)
        else:
            self.reply = self.actor.__ray_terminate__.remote()

    def join(self) -> None:
        """Wait for its end, which fails what it was asked for."""
        ray.wait([self.reply], timeout=LEAVING_TIME)


def _host_class() -> type:
    """Return the class of the actors.

    It is made in here so that it travels as code: a node's own memorymaze is imported
    inside of it only, where it can be told that it is missing or another one.
    """

    class EpisodeHost:
        def prepare(self, driver_stamp: dict[str, Any], packed: bytes) -> Any:
            import os

            # What is printed while working is no result of the driver's.
            os.dup2(2, 1)
            there = f"the cluster's node {ray.util.get_node_ip_address()}"
            try:
                from memorymaze.runs.episodes.provenance import CodeStamp, code_stamp

                unlike = code_stamp().differences(CodeStamp(**driver_stamp))
            except Exception as error:
                unlike = [f"memorymaze cannot be used there ({error!r})"]
            if unlike:
                return "refused", (
                    "\n  ".join([f"{there} has other code than this machine:", *unlike])
                    + "\nInstall the same version on every node, with its constraints.txt"
                )
            from memorymaze.basics.errors import MemoryMazeError

            try:
                self.function = pickle.loads(packed)()
            except MemoryMazeError as error:
                return "refused", f"on {there}: {error}"
            return "ready", "ready"

        def do(self, task: Any) -> Any:
            return "done", self.function(task)

    return EpisodeHost


@dataclass(frozen=True, slots=True)
class TravellingWorker:
    """An `EpisodeWorker` that brings along the files that its settings name."""

    worker: EpisodeWorker
    files: dict[str, bytes]
    """Contents by place: `agent/…`, `robot/…`, `detector/…`, `looks/…`, `replay/…`,
    `record/…`."""

    def __call__(self) -> Callable[[EpisodeTask], tuple[EpisodeOutcome, bytes]]:
        """Write the files, see that this machine has what the run needs, and prepare.

        The function gives, with each outcome, the lines of answers recorded for it.
        """
        folder = Path(tempfile.mkdtemp(prefix="memorymaze-"))
        # Not earlier: recorded replies are read as long as there are episodes.
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        for name, content in self.files.items():
            place = folder / name
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
        settings = self.worker.settings
        agent = settings.agent
        # The one core that a worker is given.
        model = replace(agent.language_model, threads=1)
        if model.replay is not None:
            model = replace(model, replay=f"{folder}/replay/{Path(model.replay).name}")
        recorded: Path | None = None
        if model.record is not None:
            recorded = folder / "record" / Path(model.record).name
            model = replace(model, record=str(recorded))
        looks = settings.looks
        if file_of_looks(looks) is not None:
            looks = f"{folder}/looks/{Path(str(looks)).name}"
        settings = replace(
            settings, agent=replace(agent, language_model=model), looks=looks
        )
        brought = {
            role: replace(
                getattr(settings, role), name=f"{folder}/{role}/{Path(name).name}"
            )
            for role, name in _in_files(settings).items()
        }
        follow = replace(self.worker, settings=replace(settings, **brought))()

        def run(task: EpisodeTask) -> tuple[EpisodeOutcome, bytes]:
            known = 0 if recorded is None else recorded.stat().st_size
            outcome = follow(task)
            return outcome, b"" if recorded is None else recorded.read_bytes()[known:]

        return run


def pack_files(settings: RunDefinition) -> dict[str, bytes]:
    """Read the files that the settings of a run name, and those beside users' own code."""
    model = settings.agent.language_model
    files = {
        f"{role}/{name}": path.read_bytes()
        for role, own in _in_files(settings).items()
        for name, path in own_files(own).items()
    }
    looks = file_of_looks(settings.looks)
    if looks is not None:
        files[f"looks/{looks.name}"] = looks.read_bytes()
    if model.replay is not None:
        files[f"replay/{Path(model.replay).name}"] = Path(model.replay).read_bytes()
    if model.record is not None:
        kept = Path(model.record)
        files[f"record/{kept.name}"] = kept.read_bytes() if kept.exists() else b""
    return files


def _in_files(settings: RunDefinition) -> dict[str, str]:
    """Return the names of users' own code that lies in files, by the setting."""
    given = {role: getattr(settings, role) for role in ("agent", "robot", "detector")}
    return {role: own.name for role, own in given.items() if own and ".py:" in own.name}
