"""Starting processes from whatever program is running; no word of what they do."""

import contextlib
import ctypes
import signal
import sys
from collections.abc import Generator

_PR_SET_PDEATHSIG = 1


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
    """Have this process killed when the one that started it ends, however it does."""
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
