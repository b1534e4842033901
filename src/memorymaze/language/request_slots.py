"""A limit on how many requests are under way at once, over all processes of a run."""

import fcntl
import time
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    takes_grammar,
)

LOOKING_PERIOD = 0.02
"""Seconds between looks for a free place."""


class QueuedModel:
    """A model that is asked only while fewer requests than a limit are under way.

    The places are locks on single bytes of one file, which the system gives back when
    a process ends, however it ends. Waiting for a place is no part of the latency.
    """

    def __init__(self, model: LanguageModel, path: Path | str, places: int) -> None:
        """Prepare to queue.

        Args:
            model: Asked when there is a place.
            path: File whose bytes are the places, the same for all processes.
            places: Requests under way at most.
        """
        self._model = model
        self._path = Path(path)
        self._places = places

    @property
    def name(self) -> str:
        """Name of the model asked."""
        return self._model.name

    @property
    def takes_grammar(self) -> bool:
        """Whether the model asked is held to a request's grammar."""
        return takes_grammar(self._model)

    def complete(self, request: CompletionRequest) -> Completion:
        """Wait for a place and ask.

        Raises:
            LanguageModelError: No usable answer came.
        """
        with self._place():
            return self._model.complete(request)

    @contextmanager
    def _place(self) -> Generator[None]:
        with self._path.open("ab") as file:
            while not any(
                _taken(file.fileno(), place) for place in range(self._places)
            ):
                time.sleep(LOOKING_PERIOD)
            # Closing the file gives the place back.
            yield


def _taken(handle: int, place: int) -> bool:
    """Take a place if it is free."""
    try:
        fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, place)
    except (BlockingIOError, PermissionError):
        return False
    return True
