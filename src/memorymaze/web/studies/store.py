"""What participants answer, in an SQLite file beside the study file.

An answer is on the disk when `Store.add_answer` returns. No pages, no export.
"""

import json
import secrets
import sqlite3
import threading
import time
from collections.abc import Callable, Generator, Iterable, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any, Literal, NamedTuple, cast

from memorymaze.basics.errors import StudyError
from memorymaze.web.studies.answer_file import answer_file, empty_log
from memorymaze.web.studies.schedule import StudyStep, cell_name, route_orders
from memorymaze.web.studies.study_file import Study

RECORDINGS = "recordings"
MOST_EVENTS = 5000
"""Of one participant; nobody plays a video so often."""

State = Literal["active", "complete", "excluded"]
Refusal = Literal["full", "known"]


@dataclass(frozen=True, slots=True)
class Participant:
    """Somebody who has consented."""

    id: str
    """Random; what exports say."""
    cell: str
    state: State
    reason: str
    """Why somebody was excluded; else empty."""
    started: float
    """Seconds since 1970, as all times here."""
    seen: float
    ended: float | None

    @property
    def order(self) -> tuple[str, ...]:
        """The routes of the cell, in order."""
        return tuple(self.cell.split(", "))


@dataclass(frozen=True, slots=True)
class SentAnswer:
    """What somebody sent, for good."""

    text: str
    shown: str
    """The text that was shown with it and matters, such as the treatment; of an attention
    check the right answer."""
    at: float


class Taken(NamedTuple):
    """What is kept of a form that is as it should be."""

    text: str
    shown: str = ""
    excluded: str = ""
    """Why somebody cannot go on; empty where they can."""


@dataclass(frozen=True, slots=True)
class PageEvent:
    """Something that somebody did on a page."""

    step: str
    kind: str
    value: float
    """Such as seconds of the video; 0 where there is nothing to say."""
    at: float


@dataclass(frozen=True, slots=True)
class Export:
    """A file that was made of the answers."""

    path: str
    at: float


@dataclass(frozen=True, slots=True)
class Withdrawal:
    """That somebody withdrew, but not who: nothing of them is left."""

    at: float
    exports: tuple[str, ...]
    """Files made before, which still hold their texts."""


@dataclass(frozen=True, slots=True)
class CellProgress:
    """How far an order of routes is."""

    name: str
    complete: int
    active: int
    left: int
    """Who began and has not gone on for long; their place is free again."""
    excluded: int


class Store:
    """The answers of one study; all threads may use it at once."""

    def __init__(
        self,
        connection: sqlite3.Connection,
        folder: Path,
        study: Study,
        clock: Callable[[], float] = time.time,
    ) -> None:
        """Take an open file; `open_store` is the way to one."""
        self.folder = folder
        self.study = study
        self.now = clock
        self._connection = connection
        self._lock = threading.RLock()

    # Participants ----------------------------------------------------------------------

    def begin(
        self, key: str, platform_ids: Mapping[str, str] | None = None
    ) -> Participant | Refusal:
        """Take in somebody who consented, for the order of routes that the fewest have.

        `key` is what their browser is known by; whoever sends it again is the same one.
        Refused where all places are taken, or somebody came with one of the ids before.
        """
        with self.writing() as rows:
            known = self.known_by(key)
            if known is not None:
                return known
            if self._has_platform_id(platform_ids or {}):
                return "known"
            cell = self._emptiest_cell()
            if cell is None:
                return "full"
            name, now = f"p{secrets.token_hex(5)}", self.now()
            self.add_participant(name, _hidden(key), cell, now, now)
            rows.executemany(
                "INSERT INTO platform_ids VALUES (?, ?, ?)",
                [(name, *each) for each in (platform_ids or {}).items()],
            )
        return Participant(name, cell, "active", "", now, now, None)

    def add_participant(
        self, name: str, key: str, cell: str, started: float, seen: float
    ) -> None:
        """Take in somebody of an id and an order of routes, whoever has places."""
        with self.writing() as rows:
            rows.execute(
                "INSERT INTO participants VALUES (?, ?, ?, ?, 'active', '', ?, ?, NULL)",
                (name, key, cell, self.study.sha256, started, seen),
            )

    def _emptiest_cell(self) -> str | None:
        progress = self.progress()
        free = [
            cell
            for cell in progress
            if cell.complete + cell.active < self.study.design.quota
        ]
        if not free:
            return None
        return min(free, key=lambda cell: cell.complete + cell.active).name

    def _has_platform_id(self, ids: Mapping[str, str]) -> bool:
        query = "SELECT 1 FROM platform_ids WHERE name = ? AND value = ?"
        return any(self.rows(query, *each) for each in ids.items())

    def known_by(self, key: str) -> Participant | None:
        """Return the participant whose browser has a key."""
        return self._one("key = ?", _hidden(key))

    def participant(self, name: str) -> Participant | None:
        """Return a participant by id."""
        return self._one("id = ?", name)

    def participants(self) -> list[Participant]:
        """Return all, in the order they began."""
        return [_participant(row) for row in self.rows(f"{_SELECT} ORDER BY started")]

    def platform_ids(self, participant: str) -> dict[str, str]:
        """Return the ids that somebody came with; for the experimenter's eyes only."""
        query = "SELECT name, value FROM platform_ids WHERE participant = ?"
        return dict(self.rows(query, participant))

    def find(self, text: str) -> Participant | None:
        """Return the participant with an id, ours or a platform's."""
        query = "SELECT participant FROM platform_ids WHERE value = ?"
        return self.participant(text) or next(
            (self.participant(name) for (name,) in self.rows(query, text)), None
        )

    def _one(self, condition: str, value: str) -> Participant | None:
        rows = self.rows(f"{_SELECT} WHERE {condition}", value)
        return _participant(rows[0]) if rows else None

    # What they send --------------------------------------------------------------------

    def add_answer(
        self,
        participant: str,
        step: str,
        text: str,
        shown: str = "",
        *,
        state: State = "active",
        reason: str = "",
        at: float | None = None,
    ) -> bool:
        """Keep an answer for good; False where the step is answered already.

        `state` is what somebody is with this answer, and `reason` why they are excluded.
        It was given `at` a time; None for now.
        """
        now = self.now() if at is None else at
        with self.writing() as rows:
            added = rows.execute(
                "INSERT INTO answers VALUES (?, ?, ?, ?, ?) ON CONFLICT DO NOTHING",
                (participant, step, text, shown, now),
            ).rowcount
            if added and state != "active":
                rows.execute(
                    "UPDATE participants SET state = ?, reason = ?, ended = ? "
                    "WHERE id = ?",
                    (state, reason, now, participant),
                )
            rows.execute(
                "DELETE FROM drafts WHERE participant = ? AND step = ?",
                (participant, step),
            )
            self.touch(participant, now)
        return bool(added)

    def answers(self, participant: str) -> dict[StudyStep, SentAnswer]:
        """Return somebody's answers by step, in the order they came."""
        query = (
            "SELECT step, text, shown, at FROM answers WHERE participant = ? "
            "ORDER BY rowid"
        )
        rows = self.rows(query, participant)
        return {StudyStep(step): SentAnswer(*answer) for step, *answer in rows}

    def keep_draft(self, participant: str, step: str, text: str) -> bool:
        """Keep an unfinished text; False where the step is answered already."""
        with self.writing() as rows:
            kept = rows.execute(
                "INSERT INTO drafts SELECT ?1, ?2, ?3, ?4 WHERE NOT EXISTS (SELECT 1 "
                "FROM answers WHERE participant = ?1 AND step = ?2) ON CONFLICT "
                "(participant, step) DO UPDATE SET text = ?3, at = ?4",
                (participant, step, text, self.now()),
            ).rowcount
            self.touch(participant, self.now())
        return bool(kept)

    def draft(self, participant: str, step: str) -> str:
        """Return an unfinished text; empty where there is none."""
        query = "SELECT text FROM drafts WHERE participant = ? AND step = ?"
        rows = self.rows(query, participant, step)
        return rows[0][0] if rows else ""

    def add_event(
        self,
        participant: str,
        step: str,
        kind: str,
        value: float = 0.0,
        at: float | None = None,
    ) -> bool:
        """Note what somebody did; False where there are too many events already."""
        now = self.now() if at is None else at
        with self.writing() as rows:
            added = rows.execute(
                "INSERT INTO events SELECT ?1, ?2, ?3, ?4, ?5 WHERE (SELECT count(*) "
                "FROM events WHERE participant = ?1) < ?6",
                (participant, step, kind, value, now, MOST_EVENTS),
            ).rowcount
            self.touch(participant, now)
        return bool(added)

    def events(self, participant: str, step: str | None = None) -> list[PageEvent]:
        """Return what somebody did, in order; on all pages or one."""
        query = (
            "SELECT step, kind, value, at FROM events WHERE participant = ?1 AND "
            "(?2 IS NULL OR step = ?2) ORDER BY rowid"
        )
        return [PageEvent(*row) for row in self.rows(query, participant, step)]

    def touch(self, participant: str, at: float) -> None:
        """Note that somebody was there at a time."""
        with self.writing() as rows:
            rows.execute(
                "UPDATE participants SET seen = max(seen, ?) WHERE id = ?",
                (at, participant),
            )

    # What experimenters do -------------------------------------------------------------

    def progress(self) -> list[CellProgress]:
        """Return how far each order of routes is."""
        held_since = self.now() - 60 * self.study.design.held_minutes
        counts = {
            (cell, state, bool(held)): count
            for cell, state, held, count in self.rows(
                "SELECT cell, state, seen > ?, count(*) FROM participants GROUP BY 1, 2, 3",
                held_since,
            )
        }

        def number(cell: str, state: State, *held: bool) -> int:
            return sum(counts.get((cell, state, each), 0) for each in held)

        return [
            CellProgress(
                cell,
                number(cell, "complete", True, False),
                number(cell, "active", True),
                number(cell, "active", False),
                number(cell, "excluded", True, False),
            )
            for cell in map(cell_name, route_orders(self.study.design))
        ]

    def withdraw(self, participant: str) -> Withdrawal:
        """Remove everything of somebody, also from the bytes of the files.

        Returns which exports were made before, to be cleaned by hand.
        """
        found = self.rows(
            "SELECT path FROM exports JOIN exported ON exports.id = export "
            "WHERE participant = ? ORDER BY exports.id",
            participant,
        )
        withdrawal = Withdrawal(self.now(), tuple(path for (path,) in found))
        with self._lock:
            with self.writing() as rows:
                removed = rows.execute(
                    "DELETE FROM participants WHERE id = ?", (participant,)
                ).rowcount
                if not removed:
                    raise StudyError(
                        f"{self.folder}: there is no participant {participant!r}; the "
                        "experimenter's page lists those there are"
                    )
                rows.execute(
                    "INSERT INTO withdrawals VALUES (?, ?)",
                    (withdrawal.at, json.dumps(withdrawal.exports)),
                )
            for recording in (self.folder / RECORDINGS).glob(f"{participant}-*"):
                recording.unlink()
            # The log holds what was written before, and the file its free pages.
            self._connection.execute("VACUUM")
            empty_log(self._connection, self.folder)
        return withdrawal

    def withdrawals(self) -> list[Withdrawal]:
        """Return that people withdrew, in order."""
        rows = self.rows("SELECT at, exports FROM withdrawals ORDER BY rowid")
        return [Withdrawal(at, tuple(json.loads(paths))) for at, paths in rows]

    def add_export(self, path: Path, participants: Iterable[str]) -> None:
        """Note that a file was made, and of whose answers."""
        with self.writing() as rows:
            number = rows.execute(
                "INSERT INTO exports (path, at) VALUES (?, ?)",
                (str(path.absolute()), self.now()),
            ).lastrowid
            rows.executemany(
                "INSERT INTO exported VALUES (?, ?)",
                [(number, each) for each in participants],
            )

    def exports(self) -> list[Export]:
        """Return the files that were made, in order."""
        rows = self.rows("SELECT path, at FROM exports ORDER BY id")
        return [Export(*row) for row in rows]

    # The file --------------------------------------------------------------------------

    @contextmanager
    def writing(self) -> Generator[sqlite3.Connection]:
        """Begin and commit; what fails leaves nothing.

        What writes inside of it is a part of it.
        """
        with self._lock:
            if self._connection.in_transaction:
                yield self._connection
                return
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
            except BaseException:
                self._connection.execute("ROLLBACK")
                raise
            self._connection.execute("COMMIT")

    def rows(self, query: str, *values: object) -> list[tuple[Any, ...]]:
        """Return what a query finds."""
        with self._lock:
            return self._connection.execute(query, cast(Any, values)).fetchall()


@contextmanager
def open_store(
    study: Study,
    *,
    alone: bool = True,
    clock: Callable[[], float] = time.time,
) -> Generator[Store]:
    """Open the answers of a study.

    Alone is who serves pages or removes people: a second one is refused. Without it the
    file must be there, such as for an export while the pages are served.
    """
    with answer_file(study, alone=alone) as connection:
        yield Store(connection, study.data_folder(), study, clock)


def _hidden(key: str) -> str:
    """Return what is kept of a browser's key: whoever reads the file cannot use it."""
    return sha256(key.encode()).hexdigest()


_SELECT = "SELECT id, cell, state, reason, started, seen, ended FROM participants"


def _participant(row: tuple[Any, ...]) -> Participant:
    return Participant(*row)
