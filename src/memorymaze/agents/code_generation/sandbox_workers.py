"""The interpreter processes that programs run in, kept warm between programs.

Each host process has a pool of its own. The pool's threads do not survive a fork, so
a process forked after its parent has used the sandbox is refused, rather than hang.
"""

import atexit
import functools
import os
import signal
import threading
from collections.abc import Generator
from contextlib import contextmanager
from datetime import UTC, datetime

from pydantic_monty import Monty, MontySession, ResourceLimits

from memorymaze.agents.code_generation.program_execution import LONGEST_COMPUTING_TIME
from memorymaze.basics.errors import SettingsError

GRACE = 0.5
"""Seconds after its time limit at which an interpreter that hangs is killed."""

LONGEST_TURN = 2 * LONGEST_COMPUTING_TIME
"""Seconds after which a worker that does not answer is killed, whatever the limits."""

_MOST_WORKERS = 64
_FROZEN_CLOCK = datetime(2000, 1, 1, tzinfo=UTC)


def open_session(limits: ResourceLimits, type_stub: str) -> MontySession:
    """Return an empty interpreter session, to be entered with `with`.

    It has a worker process to itself. Its clock stands still, sleeping takes no
    time, and unseeded random numbers are the same each time, so that a program does
    the same whenever it is run.
    """
    if _process_of_the_pool() != os.getpid():
        raise SettingsError(
            "the program sandbox cannot be used in a process forked from one that "
            "has used it; start worker processes with multiprocessing's spawn method"
        )
    return _pool().checkout(
        limits=limits,
        type_check=True,
        type_check_stubs=type_stub,
        type_check_format="jsonlines",
        os_policy={
            "datetime": _FROZEN_CLOCK,
            "sleep": "zero",
            "random_start": {"seed": 0},
        },
    )


@functools.cache
def _pool() -> Monty:
    """Return this process's pool, started on first use."""
    try:
        pool = Monty(
            max_processes=_MOST_WORKERS,
            checkout_timeout=LONGEST_TURN,
            request_timeout=LONGEST_TURN,
            feed_duration_limit_grace=GRACE,
        )
        with _interrupts_ignored():
            pool.__enter__()
    except FileNotFoundError as error:
        raise SettingsError(
            f"the program sandbox has no interpreter ({error}); "
            "install it with: pip install pydantic-monty"
        ) from error
    atexit.register(_close, pool, _process_of_the_pool())
    return pool


@functools.cache
def _process_of_the_pool() -> int:
    """Return the process that first asked for the pool; a forked child inherits it."""
    return os.getpid()


@contextmanager
def _interrupts_ignored() -> Generator[None]:
    """Have processes that are started here take no notice of Ctrl-C.

    It reaches every process of the terminal; what it means is ours to decide. Only a
    main thread can see to that; elsewhere an interrupted worker ends like ours does.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _close(pool: Monty, process: int) -> None:
    if os.getpid() == process:
        pool.__exit__(None, None, None)
