"""A Ray cluster that does the episodes of a run; the driver alone writes its folder."""

import socket
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from memorymaze.errors import SettingsError
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.settings import RunSettings
from memorymaze.evaluation.travelling_files import (
    TravellingWorker,
    check_can_travel,
    pack_files,
)
from memorymaze.evaluation.workforce import EpisodePool, available_cores

ANSWER_TIME = 10.0
"""Seconds that the cluster's address has for taking a connection."""

OBJECT_STORE = 200_000_000
"""Bytes of shared memory of a cluster that is started here; its default is a third of
the machine's memory, and sites and traces are small."""


@dataclass(frozen=True, slots=True)
class RayWorkforce:
    """Workers on the cluster that this process is connected to."""

    workers: int
    """Each has one core to itself."""
    cores: int
    """Of the whole cluster."""
    nodes: int
    """Machines that are alive."""

    def __str__(self) -> str:
        """Say how many there are, and where."""
        numbers = (self.workers, "worker"), (self.nodes, "node"), (self.cores, "core")
        workers, nodes, cores = (f"{n} {what}{'s' * (n != 1)}" for n, what in numbers)
        return f"{workers} on a Ray cluster of {nodes} with {cores}"

    def check(self, settings: RunSettings) -> None:
        """Refuse what workers on several machines cannot keep together.

        Raises:
            SettingsError: Says what, and what to do instead.
        """
        check_can_travel(settings, self.nodes)

    def pool(
        self, plan: RunPlan, folder: Path, episodes: int, wall_limit: float
    ) -> EpisodePool:
        """Return workers for a plan; no more of them than there are episodes."""
        from memorymaze.evaluation.ray_pool import RayPool

        prepare = TravellingWorker(plan.settings, plan.sites, pack_files(plan.settings))
        return RayPool(prepare, min(self.workers, episodes), wall_limit)


@contextmanager
def open_ray_cluster(address: str, workers: int = 0) -> Generator[RayWorkforce]:
    """Connect to a Ray cluster, and leave it at the end.

    A connection that this process has already is used and kept.

    Args:
        address: `HOST:PORT` of a cluster's head, for a machine that belongs to it;
            `ray://HOST:PORT` for one that does not; `auto` for the cluster that this
            machine belongs to; `local` starts one on this machine, for this run only.
        workers: Workers, each with one core; 0 for one per core of the cluster.

    Raises:
        SettingsError: Ray is not installed, there is no such cluster, or it has fewer
            cores than there are to be workers.
    """
    ray = _ray()
    ours = not ray.is_initialized()
    if ours:
        _connect(ray, address, workers)
    try:
        cores = int(ray.cluster_resources().get("CPU", 0))
        nodes = sum(1 for node in ray.nodes() if node["Alive"])
        if cores < max(1, workers):
            raise SettingsError(
                f"--ray {address}: expected a cluster with at least {max(1, workers)} "
                f"cores, one for each worker, got {cores} on {nodes} node(s); "
                "give a smaller --workers, or add nodes with `ray start --address`"
            )
        yield RayWorkforce(workers or cores, cores, nodes)
    finally:
        if ours:
            ray.shutdown()


def _ray() -> ModuleType:
    try:
        import ray
    except ModuleNotFoundError:
        raise SettingsError(
            "--ray: needs the package ray: pip install 'memorymaze[ray]'"
        ) from None
    return ray


def _connect(ray: Any, address: str, workers: int) -> None:
    options: dict[str, Any] = {"log_to_driver": False, "logging_level": "ERROR"}
    if address == "local":
        options |= {
            "num_cpus": workers or available_cores(),
            "include_dashboard": False,
            "object_store_memory": OBJECT_STORE,
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
            "--ray: expected auto, local, HOST:PORT or ray://HOST:PORT, got "
            f"{address!r}"
        )
    try:
        socket.create_connection((host.strip("[]"), int(port)), ANSWER_TIME).close()
    except OSError as error:
        raise SettingsError(
            f"--ray {address}: nothing answers there ({error.strerror or error}); "
            "`ray start --head` on the cluster's head prints its address"
        ) from None
