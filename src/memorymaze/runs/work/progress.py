"""How far a run is, on stderr: a bar with the time left, or plain lines in a log."""

import sys
import time
from typing import NoReturn, TextIO

from tqdm import tqdm

from memorymaze.runs.episodes.results import EpisodeResult

SECONDS_BETWEEN_LINES = 15.0


class Progress:
    """Shows how many episodes are done; use it in a `with`."""

    def __init__(
        self,
        total: int,
        done: int,
        stream: TextIO | None = None,
        *,
        successes: float = 0.0,
    ) -> None:
        """Begin the clock, with what was done before, and how much of it succeeded."""
        self._stream = sys.stderr if stream is None else stream
        self._total, self._before, self._done = total, done, done
        self._successes = successes
        self._began = self._said = time.monotonic()
        self._bar: tqdm[NoReturn] | None = None
        if self._stream.isatty():
            self._bar = tqdm(
                total=total, initial=done, unit="episode", file=self._stream
            )

    def __enter__(self) -> "Progress":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the last state standing."""
        if self._bar is not None:
            self._bar.close()

    def count(self, result: EpisodeResult) -> None:
        """Count an episode that ended."""
        self._done += 1
        self._successes += result.success
        if self._bar is not None:
            self._bar.set_postfix_str(f"success {self._rate():.2f}", refresh=False)
            self._bar.update()
            return
        now = time.monotonic()
        if self._done == self._total or now - self._said >= SECONDS_BETWEEN_LINES:
            self._said = now
            print(self._line(now), file=self._stream, flush=True)

    def _rate(self) -> float:
        return self._successes / self._done

    def _line(self, now: float) -> str:
        spent = now - self._began
        left = spent / (self._done - self._before) * (self._total - self._done)
        return (
            f"{self._done} of {self._total} episodes, success {self._rate():.2f}, "
            f"{_clock(spent)} spent, {_clock(left)} left"
        )


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
