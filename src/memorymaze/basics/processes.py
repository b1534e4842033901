"""Starting processes from whatever program is running; no word of what they do."""

import contextlib
import multiprocessing
import os
import sys
import threading
from collections.abc import Generator
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess


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
