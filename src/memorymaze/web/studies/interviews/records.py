"""What a tablet sends of interviews: answers and recordings.

A tablet numbers what it sends, so that what comes twice is kept once, and tells when
things happened: it may send them much later. No pages.
"""

import re
import sqlite3
from dataclasses import dataclass
from typing import Literal

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import StudyError
from memorymaze.web.studies.schedule import StudyStep, cell_name, route_orders
from memorymaze.web.studies.store import RECORDINGS, State, Store

Receipt = Literal["kept", "known", "taken", "gone"]
"""Kept now; known from before; the step has another answer; nobody has that number."""

MEDIA_TYPES = {
    "audio/webm": "webm",
    "audio/mp4": "mp4",
    "audio/ogg": "ogg",
    "audio/wav": "wav",
}
"""What browsers record, and the ends of the files' names."""
VOICE = "voice."
"""Before the step of a description: its recording."""
PARTICIPANT = re.compile(r"p[0-9a-f]{10}")
RECORD = re.compile(r"[0-9a-z-]{8,64}")
TOLERANCE = 24 * 3600.0
"""Seconds that a tablet's clock may be ahead."""


@dataclass(frozen=True, slots=True)
class InterviewRecord:
    """A thing that a tablet sends, and when it came to be."""

    id: str
    participant: str
    step: StudyStep
    opened: float
    """Seconds since 1970 by the tablet, as `at`."""
    at: float


class Interviews:
    """The interviews in a store of answers."""

    def __init__(self, store: Store) -> None:
        """Take the store."""
        self.store = store

    # What a tablet sends ---------------------------------------------------------------

    def begin(self, record: InterviewRecord, cell: str, shown: str) -> Receipt:
        """Take in somebody who has consented, with a number that the tablet chose.

        Orders may be taken more often than wanted: whoever was asked already is kept.
        """
        self._check(record)
        orders = [cell_name(order) for order in route_orders(self.store.study.design)]
        if cell not in orders:
            raise StudyError(
                f"expected an order of routes among {orders}, got {cell!r}"
            )
        with self.store.writing():
            if self._state_of(record) == "gone":
                self.store.add_participant(
                    record.participant, record.id, cell, record.opened, record.at
                )
            return self.take(record, cell, shown)

    def take(
        self,
        record: InterviewRecord,
        text: str,
        shown: str = "",
        *,
        state: State = "active",
        reason: str = "",
    ) -> Receipt:
        """Keep an answer, with what was said to the person, and what they are with it."""
        self._check(record)
        with self.store.writing() as rows:
            taken = self._state_of(record)
            if taken == "kept":
                who, step, at = record.participant, record.step, record.at
                self._add_record(rows, record)
                self.store.add_answer(
                    who, step, text, shown, state=state, reason=reason, at=at
                )
                self.store.add_event(who, step, "opened", at=record.opened)
        return taken

    def take_recording(
        self, record: InterviewRecord, content: bytes, media_type: str, seconds: float
    ) -> Receipt:
        """Keep a recording; it is on the disk when this returns."""
        self._check(record)
        step = record.step.removeprefix(VOICE)
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

    def _check(self, record: InterviewRecord) -> None:
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

    def _state_of(self, record: InterviewRecord) -> Receipt:
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

    def _add_record(self, rows: sqlite3.Connection, record: InterviewRecord) -> None:
        rows.execute(
            "INSERT INTO records VALUES (?, ?, ?)",
            (record.id, record.participant, record.step),
        )
        self.store.touch(record.participant, record.at)
