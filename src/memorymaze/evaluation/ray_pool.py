"""Workers on a Ray cluster that work through tasks, and may die doing so.

The counterpart of `worker_pool.py`: a worker is an actor, which Ray puts where a core is
free. It knows nothing of episodes. Needs the extra `ray`.
"""

import math
import pickle
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any, Generic, TypeVar

import ray
from ray.exceptions import RayError

from memorymaze.errors import MemoryMazeError, SettingsError
from memorymaze.evaluation.provenance import code_stamp
from memorymaze.evaluation.worker_pool import LEAVING_TIME, LOOKING_PERIOD, STARTS, Lost

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

STARTING_TIME = 300.0
"""Seconds to wait for the first worker, which a busy cluster may have no core for."""

DIED = "the worker process died on the cluster, or its node did"
"""All that is said of it in results, which must not depend on names of nodes."""


@dataclass
class _Worker(Generic[Task]):
    actor: Any
    reply: Any
    """Reference to what it was asked for last; None while it has nothing to do."""
    deaths: int
    """Actors in this place that died in a row before they were ready."""
    ready: bool = False
    task: Task | None = None
    began: float = 0.0
    """When it was given its task, by the monotonic clock."""


class RayPool(Generic[Task, Outcome]):
    """Some workers, each with its own working function; use it in a `with`.

    This process must be connected to the cluster (`ray_cluster.py`). Workers must run
    the same code as this process; the run ends where one does not.

    Args:
        prepare: Called once in every worker, and makes the function that does tasks
            there; must be picklable. A `MemoryMazeError` it raises ends the run.
        count: Number of workers; 0 where there is nothing to do.
        patience: Real seconds a task may take; then its worker is ended.
    """

    def __init__(
        self,
        prepare: Callable[[], Callable[[Task], Outcome]],
        count: int,
        patience: float = math.inf,
    ) -> None:
        """Remember what to start; workers start in `run`."""
        self._prepare = prepare
        self._count = count
        self._patience = patience
        self._workers: dict[int, _Worker[Task]] = {}
        self._host: Any = None
        self._packed: Any = None

    def __enter__(self) -> "RayPool[Task, Outcome]":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End all workers: those with a task at once, idle ones in their own way."""
        leaving: list[Any] = []
        for worker in self._workers.values():
            if worker.reply is None:
                leaving.append(worker.actor.__ray_terminate__.remote())
            else:
                ray.kill(worker.actor)
        if leaving:
            ray.wait(leaving, num_returns=len(leaving), timeout=LEAVING_TIME)
        self._workers.clear()

    def run(
        self, choose: Callable[[int], Task | None]
    ) -> Iterator[tuple[Task, Outcome | Lost]]:
        """Work until no worker has a task and there is none to give.

        Args:
            choose: Gives the next task for a worker (numbered from 0), or None when
                there is none now. It is asked again after every outcome.

        Yields:
            Every task given, once, with what came of it, in the order of completion.

        Raises:
            MemoryMazeError: Workers could not be started or prepared.
            SettingsError: One runs other code.
        """
        if not self._count:
            return
        self._host = ray.remote(_host_class())
        # Once for the whole cluster; each node fetches it when it is first needed.
        self._packed = ray.put(pickle.dumps(self._prepare))
        for number in range(self._count):
            self._start(number, deaths=0)
        latest = time.monotonic()
        while self._set_to_work(choose):
            replies = [w.reply for w in self._workers.values() if w.reply is not None]
            there, _ = ray.wait(replies, num_returns=1, timeout=LOOKING_PERIOD)
            for number, worker in list(self._workers.items()):
                if worker.reply in there:
                    yield from self._receive(number, worker)
                elif self._is_overdue(worker):
                    reason = f"took longer than the {self._patience:g} s a task may"
                    lost = Lost(f"the worker process {reason}", overdue=True)
                    yield from self._replace(number, worker, lost)
            if any(worker.ready for worker in self._workers.values()):
                latest = time.monotonic()
            elif time.monotonic() - latest > STARTING_TIME:
                raise MemoryMazeError(
                    f"no worker could be started on the cluster in {STARTING_TIME:g} s; "
                    "see with `ray status` whether cores are free"
                )

    def _set_to_work(self, choose: Callable[[int], Task | None]) -> bool:
        """Give tasks to all who are free; tell whether there is anything to wait for.

        A task is only given to a worker that is there: others may wait long for a core.
        """
        nothing_left = False
        for number, worker in self._workers.items():
            if worker.ready and worker.task is None:
                worker.task = choose(number)
                if worker.task is None:
                    nothing_left = True
                else:
                    worker.reply = worker.actor.do.remote(worker.task)
                    worker.began = time.monotonic()
        busy = any(worker.task is not None for worker in self._workers.values())
        return busy or not nothing_left

    def _is_overdue(self, worker: _Worker[Task]) -> bool:
        waiting = worker.task is not None
        return waiting and time.monotonic() - worker.began > self._patience

    def _start(self, number: int, deaths: int) -> None:
        actor = self._host.options(num_cpus=1, max_restarts=0).remote()
        reply = actor.prepare.remote(asdict(code_stamp()), self._packed)
        self._workers[number] = _Worker[Task](actor, reply, deaths)

    def _receive(
        self, number: int, worker: _Worker[Task]
    ) -> Iterator[tuple[Task, Outcome | Lost]]:
        """Read what a worker says: that it is ready or cannot be, or an outcome."""
        try:
            said, content = ray.get(worker.reply)
        except RayError:
            yield from self._replace(number, worker, Lost(DIED))
            return
        task, worker.task, worker.reply = worker.task, None, None
        if said == "refused":
            raise SettingsError(content)
        worker.ready = True
        if task is not None:
            yield task, content

    def _replace(
        self, number: int, worker: _Worker[Task], lost: Lost
    ) -> Iterator[tuple[Task, Outcome | Lost]]:
        """Put another worker in the place of one that died or is to."""
        ray.kill(worker.actor)
        if not worker.ready and worker.deaths + 1 == STARTS:
            raise MemoryMazeError(
                f"workers do not start on the cluster: the last {STARTS} of one place "
                "ended early; Ray's logs on the nodes (/tmp/ray) say why. With little "
                "memory, try fewer --workers"
            )
        self._start(number, deaths=0 if worker.ready else worker.deaths + 1)
        if worker.task is not None:
            yield worker.task, lost


def _host_class() -> type:
    """Return the class of the actors.

    It is made in here so that it travels as code: a node's own memorymaze is imported
    inside of it only, where it can be told that it is missing or another one.
    """

    class EpisodeHost:
        def prepare(
            self, driver_stamp: dict[str, Any], packed: bytes
        ) -> tuple[str, str | None]:
            import os
            import pickle

            import ray

            # What is printed while working is no result of the driver's.
            os.dup2(2, 1)
            there = f"the cluster's node {ray.util.get_node_ip_address()}"
            try:
                from memorymaze.evaluation.provenance import CodeStamp, code_stamp

                unlike = code_stamp().differences(CodeStamp(**driver_stamp))
            except Exception as error:
                unlike = [f"memorymaze cannot be used there ({error!r})"]
            if unlike:
                return "refused", (
                    f"{there} has other code than this machine:\n  "
                    + "\n  ".join(unlike)
                    + "\nInstall the same version of memorymaze on every node, with its "
                    "constraints.txt"
                )
            from memorymaze.errors import MemoryMazeError

            try:
                self.function = pickle.loads(packed)()
            except MemoryMazeError as error:
                return "refused", f"on {there}: {error}"
            return "ready", None

        def do(self, task: Any) -> tuple[str, Any]:
            from memorymaze.evaluation.agent_failures import failure_line
            from memorymaze.evaluation.worker_pool import Lost

            try:
                return "done", self.function(task)
            except BaseException as error:
                return "done", Lost(failure_line(error))

    return EpisodeHost
