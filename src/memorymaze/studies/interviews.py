"""What a tablet sends of interviews: answers, recordings, and what was said in them.

A tablet numbers what it sends, so that what comes twice is kept once, and tells when
things happened: it may send them much later. No pages.
"""

import re
import sqlite3
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from memorymaze.durable_files import write_whole
from memorymaze.errors import StudyError
from memorymaze.studies.schedule import cell_name, route_orders
from memorymaze.studies.store import RECORDINGS, State, Store

Taken = Literal["kept", "known", "taken", "gone"]
"""Kept now; known from before; the step has another answer; nobody has that number."""

MEDIA_TYPES = {
    "audio/webm": "webm",
    "audio/mp4": "mp4",
    "audio/ogg": "ogg",
    "audio/wav": "wav",
}
"""What browsers record, and the ends of the files' names."""
PARTICIPANT = re.compile(r"p[0-9a-f]{10}")
RECORD = re.compile(r"[0-9a-f-]{8,64}")
TOLERANCE = 24 * 3600.0
"""Seconds that a tablet's clock may be ahead."""


@dataclass(frozen=True, slots=True)
class Record:
    """A thing that a tablet sends, and when it came to be."""

    id: str
    participant: str
    step: str
    opened: float
    """Seconds since 1970 by the tablet, as `at`."""
    at: float


@dataclass(frozen=True, slots=True)
class Recording:
    """A file with somebody's voice."""

    file: str
    participant: str
    step: str
    media_type: str
    seconds: float


@dataclass(frozen=True, slots=True)
class Transcript:
    """A version of what was said in a recording."""

    written_by: str
    is_heard: bool
    """Whether a recogniser wrote it."""
    text: str
    at: float


@dataclass(frozen=True, slots=True)
class Told:
    """A description, as far as it is known."""

    participant: str
    step: str
    """`tell.R1` or `retell.R1`."""
    recording: Recording | None
    versions: tuple[Transcript, ...]
    """What was typed first, then the others in the order they came."""

    @property
    def text(self) -> str:
        """What a person wrote last, else a recogniser; empty where nobody has yet."""
        by_people = [each for each in self.versions if not each.is_heard]
        latest = by_people or list(self.versions)
        return latest[-1].text if latest else ""

    @property
    def first_text(self) -> str:
        """The version before all corrections."""
        return self.versions[0].text if self.versions else ""

    @property
    def route(self) -> str:
        """The route it is about."""
        return self.step.partition(".")[2]


class Interviews:
    """The interviews in a store of answers."""

    def __init__(self, store: Store) -> None:
        """Take the store."""
        self.store = store

    # What a tablet sends ---------------------------------------------------------------

    def begin(self, record: Record, cell: str, shown: str) -> Taken:
        """Take in somebody who has consented, with a number that the tablet chose.

        Orders may be taken more often than wanted: whoever was asked already is kept.
        """
        self._check(record)
        orders = [cell_name(order) for order in route_orders(self.store.study.design)]
        if cell not in orders:
            raise StudyError(
                f"expected an order of routes among {orders}, got {cell!r}"
            )
        with self.store.writing() as rows:
            taken = self._state_of(record)
            if taken != "gone":
                return taken
            rows.execute(
                "INSERT INTO participants VALUES (?, ?, ?, ?, 'active', '', ?, ?, NULL)",
                (
                    record.participant,
                    record.id,
                    cell,
                    self.store.study.sha256,
                    record.opened,
                    record.at,
                ),
            )
            self._add(rows, record, cell, shown)
        return "kept"

    def take(
        self,
        record: Record,
        text: str,
        shown: str = "",
        *,
        state: State = "active",
        reason: str = "",
    ) -> Taken:
        """Keep an answer, with what was said to the person, and what they are with it."""
        self._check(record)
        with self.store.writing() as rows:
            taken = self._state_of(record)
            if taken == "kept":
                self._add(rows, record, text, shown)
                if state != "active":
                    rows.execute(
                        "UPDATE participants SET state = ?, reason = ?, ended = ? "
                        "WHERE id = ?",
                        (state, reason, record.at, record.participant),
                    )
        return taken

    def take_recording(
        self, record: Record, content: bytes, media_type: str, seconds: float
    ) -> Taken:
        """Keep a recording; it is on the disk when this returns."""
        self._check(record)
        step = record.step.removeprefix("voice.")
        name = f"{record.participant}-{record.id}.{MEDIA_TYPES[media_type]}"
        # Whoever withdraws meanwhile waits: the file would be left behind.
        with self.store.writing() as rows:
            taken = self._state_of(record)
            if taken == "kept":
                self._add_record(rows, record)
                rows.execute(
                    "INSERT INTO recordings VALUES (?, ?, ?, ?, ?, ?)",
                    (name, record.participant, step, media_type, seconds, record.at),
                )
                folder = self.store.folder / RECORDINGS
                folder.mkdir(mode=0o700, exist_ok=True)
                write_whole(folder / name, content)
        return taken

    def _check(self, record: Record) -> None:
        if not PARTICIPANT.fullmatch(record.participant):
            raise StudyError(
                f"expected a participant's number such as p0123456789, got "
                f"{record.participant!r}"
            )
        if not RECORD.fullmatch(record.id):
            raise StudyError(f"expected a record's number, got {record.id!r}")
        if not 0 < record.opened <= record.at <= self.store.now() + TOLERANCE:
            raise StudyError(
                "the clock of the tablet seems to be wrong; set it, and send again"
            )

    def _state_of(self, record: Record) -> Taken:
        """Return what is to be done with a record; kept where it is new."""
        query = "SELECT participant, step FROM records WHERE id = ?"
        known = self.store.rows(query, record.id)
        if known:
            is_same = known == [(record.participant, record.step)]
            return "known" if is_same else "taken"
        if self.store.participant(record.participant) is None:
            return "gone"
        query = "SELECT 1 FROM records WHERE participant = ? AND step = ?"
        if self.store.rows(query, record.participant, record.step):
            return "taken"
        return "kept"

    def _add(
        self, rows: sqlite3.Connection, record: Record, text: str, shown: str
    ) -> None:
        self._add_record(rows, record)
        rows.execute(
            "INSERT INTO answers VALUES (?, ?, ?, ?, ?)",
            (record.participant, record.step, text, shown, record.at),
        )
        rows.execute(
            "INSERT INTO events VALUES (?, ?, 'opened', 0, ?)",
            (record.participant, record.step, record.opened),
        )

    def _add_record(self, rows: sqlite3.Connection, record: Record) -> None:
        rows.execute(
            "INSERT INTO records VALUES (?, ?, ?)",
            (record.id, record.participant, record.step),
        )
        rows.execute(
            "UPDATE participants SET seen = max(seen, ?) WHERE id = ?",
            (record.at, record.participant),
        )

    # What was said ---------------------------------------------------------------------

    def recordings(self) -> list[Recording]:
        """Return all recordings, in the order they came."""
        query = "SELECT file, participant, step, media_type, seconds FROM recordings"
        return [Recording(*row) for row in self.store.rows(f"{query} ORDER BY rowid")]

    def path_of(self, recording: Recording) -> Path:
        """Return where a recording lies."""
        return self.store.folder / RECORDINGS / recording.file

    def add_transcript(
        self, participant: str, step: str, written_by: str, text: str, *, is_heard: bool
    ) -> bool:
        """Keep a version of what was said; False where the person has withdrawn."""
        with self.store.writing() as rows:
            return bool(
                rows.execute(
                    "INSERT INTO transcripts SELECT ?1, ?2, ?3, ?4, ?5, ?6 WHERE EXISTS "
                    "(SELECT 1 FROM participants WHERE id = ?1)",
                    (participant, step, written_by, is_heard, text, self.store.now()),
                ).rowcount
            )

    def told(self, participant: str | None = None) -> list[Told]:
        """Return all descriptions, or those of one participant, typed or recorded."""
        recordings = {(each.participant, each.step): each for each in self.recordings()}
        versions: dict[tuple[str, str], list[Transcript]] = {}
        for who, step, text, at in self.store.rows(
            "SELECT participant, step, text, at FROM answers WHERE (step LIKE 'tell.%' "
            "OR step LIKE 'retell.%') AND (?1 IS NULL OR participant = ?1) "
            "ORDER BY rowid",
            participant,
        ):
            typed = [Transcript("", False, text, at)] if text else []
            versions[who, step] = typed
        for who, step, *row in self.store.rows(
            "SELECT participant, step, written_by, is_heard, text, at FROM transcripts "
            "ORDER BY rowid"
        ):
            if (who, step) in versions:
                by, is_heard, text, at = row
                versions[who, step].append(Transcript(by, bool(is_heard), text, at))
        return [
            Told(*key, recordings.get(key), tuple(some))
            for key, some in versions.items()
        ]
