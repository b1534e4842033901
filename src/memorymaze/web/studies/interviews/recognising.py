"""Recordings made into text by a recogniser of one's own: a command of the study file."""

import shlex
import subprocess
import sys
import threading
from collections.abc import Generator
from contextlib import contextmanager

from memorymaze.web.studies.store import Store
from memorymaze.web.studies.tellings import Recording, StudyTellings

PATIENCE = 600.0
"""Seconds for one recording."""
NAME = "the recogniser"


class Recogniser:
    """Hears recordings one after the other, in a thread, as they come."""

    def __init__(self, store: Store, tellings: StudyTellings) -> None:
        """Take the store, whose study says which command there is, and what is told."""
        interview = store.study.design.interview
        command = None if interview is None else interview.recogniser
        self._command = shlex.split(command or "")
        self._folder = store.study.path.absolute().parent
        self._tellings = tellings
        self._news = threading.Event()
        self._is_over = False
        self.problems: dict[tuple[str, str], str] = {}
        """Why there is no text, by participant and step."""

    @property
    def is_there(self) -> bool:
        """Whether the study has one."""
        return bool(self._command)

    def hear_new(self) -> None:
        """Say that there may be recordings it has not heard."""
        self._news.set()

    @contextmanager
    def hearing(self) -> Generator[None]:
        """Hear what comes, beginning with what an earlier server left unheard."""
        if not self.is_there:
            yield
            return
        self._news.set()
        thread = threading.Thread(target=self._hear_all, daemon=True)
        thread.start()
        try:
            yield
        finally:
            self._is_over = True
            self._news.set()
            # What it hears now is heard again by the next server.
            thread.join(timeout=2)

    def _hear_all(self) -> None:
        while self._news.wait() and not self._is_over:
            self._news.clear()
            for recording in self.unheard():
                if self._is_over:
                    return
                self._hear(recording)

    def unheard(self) -> list[Recording]:
        """Return the recordings that it should hear."""
        return [
            told.recording
            for told in self._tellings.told()
            if told.recording is not None
            and not any(each.is_heard for each in told.versions)
            and (told.participant, told.step) not in self.problems
        ]

    def _hear(self, recording: Recording) -> None:
        about = (recording.participant, recording.step)
        path = self._tellings.path_of(recording).absolute()
        try:
            done = subprocess.run(
                [*self._command, str(path)],
                cwd=self._folder,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                errors="replace",
                timeout=PATIENCE,
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            self._complain(about, str(error))
            return
        text = done.stdout.strip()
        if done.returncode or not text:
            last = (done.stderr.strip().splitlines() or ["it said nothing"])[-1]
            self._complain(about, f"code {done.returncode}: {last}")
            return
        self._tellings.add_transcript(*about, NAME, text, is_heard=True)

    def _complain(self, about: tuple[str, str], why: str) -> None:
        self.problems[about] = why
        print(
            f"memorymaze: {' '.join(about)}: the recogniser gave no text ({why}); type "
            "it by hand, or mend the command and start the server again",
            file=sys.stderr,
        )
