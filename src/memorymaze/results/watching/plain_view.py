"""An episode as plain lines, for logs and pipes."""

from typing import TextIO

from memorymaze.results.replay.current_step import CurrentStep
from memorymaze.results.watching.present import Present


class PlainView:
    """Prints every event once, and every new step."""

    period = 0.2

    def __init__(self, stream: TextIO) -> None:
        """Print to a stream."""
        self._stream = stream
        self._step: CurrentStep | None = None

    def show(self, present: Present) -> None:
        """Print what is new."""
        for event in present.fresh:
            self._say(f"{event.time:7.1f} s  {event.text}")
        if present.step != self._step and present.step.heading:
            self._step = step = present.step
            line = step.lines[step.current or 0] if step.lines else ""
            self._say(f"{present.time:7.1f} s  {step.heading}: {line}")

    def finish(self, words: str) -> None:
        """Leave it to the command line, which says how it ended."""

    def _say(self, text: str) -> None:
        print(" ".join(text.splitlines()), file=self._stream, flush=True)
