"""A process with a robot that somebody looks on at: messages to and fro, and its end.

A process, not a thread: the pages go on being served while it thinks or draws, it can
be ended at any moment, and what it opened (such as OpenGL) ends with it.
"""

import contextlib
import os
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.basics.processes import PROCESSES, begin_worker, main_left_out

Work = Callable[[Connection], None]
"""What a process does, with its end of the connection; pickled on the way there."""


class ProcessLost(Exception):
    """The last message of a process: it is gone, and why, in words for its user."""


class LiveProcess:
    """A process and the messages from it, which are told as they come."""

    def __init__(self, work: Work, hear: Callable[[Any], None]) -> None:
        """Start the process; `hear` is called in a thread, with a `ProcessLost` at the end."""
        self._connection, theirs = PROCESSES.Pipe()
        self._process = PROCESSES.Process(
            target=_live, args=(theirs, work), daemon=True
        )
        with main_left_out():
            self._process.start()
        theirs.close()
        self._telling = threading.Lock()
        threading.Thread(target=self._listen, args=(hear,), daemon=True).start()

    def tell(self, message: object) -> None:
        """Send it a message; one that is gone says so by its `ProcessLost`."""
        with self._telling, contextlib.suppress(OSError):
            self._connection.send(message)

    def end(self) -> None:
        """End it now, whatever it does."""
        self._process.kill()
        self._process.join()

    def _listen(self, hear: Callable[[Any], None]) -> None:
        last: object = None
        with contextlib.suppress(EOFError, OSError):
            while not isinstance(last, ProcessLost):
                last = self._connection.recv()
                hear(last)
        self.end()
        if not isinstance(last, ProcessLost):
            hear(ProcessLost("The robot was put away."))
        with self._telling:
            self._connection.close()


def _live(connection: Connection, work: Work) -> None:
    """Do the work; the life of a process."""
    begin_worker()
    with contextlib.suppress(OSError):
        os.dup2(2, 1)
    try:
        work(connection)
    except (EOFError, BrokenPipeError):
        return
    except MemoryMazeError as error:
        connection.send(ProcessLost(str(error)))
    except BaseException as error:
        connection.send(
            ProcessLost(f"The robot failed: {type(error).__name__}: {error}")
        )
        raise
