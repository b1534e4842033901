import math
import os

import pytest

from memorymaze.basics.errors import MemoryMazeError, SettingsError
from memorymaze.texts.datasets.workers import done_by_processes
from memorymaze.world.sites import load_site


@pytest.mark.parametrize("workers", [1, 2])
def test_results_come_in_the_order_of_the_tasks(workers: int) -> None:
    done = done_by_processes(math.factorial, [2000, 1, 2], workers)
    assert list(done) == [math.factorial(2000), 1, 2]


@pytest.mark.parametrize("workers", [1, 2])
def test_what_is_wrong_in_a_worker_is_said_as_it_is(workers: int) -> None:
    with pytest.raises(SettingsError, match="no such file"):
        list(done_by_processes(load_site, ["nowhere", "nowhere"], workers))


def test_a_worker_that_is_killed_is_no_riddle() -> None:
    with pytest.raises(MemoryMazeError, match="fewer --workers"):
        list(done_by_processes(os._exit, [1, 1], 2))
