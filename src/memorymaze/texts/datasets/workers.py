"""Work done by several processes of this machine, its results in order."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import TypeVar

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.basics.processes import (
    PROCESSES,
    available_cores,
    begin_worker,
    main_left_out,
    start_server,
)

Task = TypeVar("Task")
_Result = TypeVar("_Result")


def done_by_processes(
    do: Callable[[Task], _Result], tasks: Sequence[Task], workers: int
) -> Iterator[_Result]:
    """Do tasks; with one worker in this process.

    Args:
        do: A function that other processes can import, with arguments they can get.
        tasks: What it is called with.
        workers: Processes; 0 for one per core.
    """
    workers = min(workers or available_cores(), len(tasks))
    if workers <= 1:
        yield from map(do, tasks)
        return
    start_server("memorymaze.texts.datasets")
    pool = ProcessPoolExecutor(workers, PROCESSES, initializer=begin_worker)
    try:
        with main_left_out():
            results = [pool.submit(do, task) for task in tasks]
        for result in results:
            yield result.result()
    except BrokenProcessPool:
        raise MemoryMazeError(
            "a worker process was killed; with little memory, try fewer --workers"
        ) from None
    finally:
        pool.shutdown(cancel_futures=True)
