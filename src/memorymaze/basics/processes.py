"""Starting processes from whatever program is running; no word of what they do."""

import contextlib
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Generator
from multiprocessing import forkserver, resource_tracker
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess

PROCESSES = multiprocessing.get_context("forkserver")
"""What processes that work for this one are started with."""
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def available_cores() -> int:
    """Return how many processor cores this process may use."""
    return len(os.sched_getaffinity(0))


@contextlib.contextmanager
def main_left_out() -> Generator[None]:
    """Keep processes that are started here from running the user's script once more.

    They need nothing of it: what is defined there comes pickled, with its code.
    """
    main = sys.modules["__main__"]
    hidden = {name: vars(main).pop(name, None) for name in ("__file__", "__spec__")}
    main.__spec__ = None
    try:
        yield
    finally:
        vars(main).update({
            name: value for name, value in hidden.items() if value is not None
        })


def start_server(*modules: str) -> None:
    """Start the server of worker processes where none runs; it imports modules first.

    Workers hold no locks or threads of this process's libraries, and begin with what the
    server has imported once for all of them.
    """
    PROCESSES.set_forkserver_preload([*modules])
    # Ctrl-C reaches every process of the terminal; the parent decides what it means.
    # A blocked signal stays blocked in the server that this starts, and its children;
    # what tracks resources would unblock it if it was started only then.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        with main_left_out(), _one_thread_each():
            forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextlib.contextmanager
def _one_thread_each() -> Generator[None]:
    """Have linear algebra in the processes started here take one core, unless told otherwise.

    Workers share the cores already; their threads would wait for each other. It holds
    where the library is loaded, in the server; what agents load later sees nothing of it.
    """
    unset = [name for name in _THREADS if name not in os.environ]
    os.environ.update(dict.fromkeys(unset, "1"))
    try:
        yield
    finally:
        for name in unset:
            del os.environ[name]


def begin_worker() -> None:
    """Have this process ignore Ctrl-C, and end when the one that started it is gone."""
    # Ctrl-C reaches every process of the terminal; the parent decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    die_with_parent()


def die_with_parent() -> None:
    """Have this process end when the one that started it is gone, however that came.

    A thread waits for that, on every platform; code that never lets go of the
    interpreter's lock holds it up.
    """
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_after, args=(parent,), daemon=True).start()


def _end_after(parent: BaseProcess) -> None:
    wait([parent.sentinel])
    os._exit(1)
