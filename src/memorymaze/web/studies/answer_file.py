"""The SQLite file that answers are in: its tables, opening it alone, what it is about."""

import sqlite3
import time
from collections.abc import Generator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path

from memorymaze.basics.durable_files import locked
from memorymaze.basics.errors import StudyError
from memorymaze.web.studies.schedule import cell_name, route_orders
from memorymaze.web.studies.study_file import Study

FILE = "answers.sqlite"
BUSY_TIMEOUT = 60.0
"""Seconds to wait while another process writes."""

SCHEMA = """
CREATE TABLE facts (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE designs (sha256 TEXT PRIMARY KEY, text TEXT NOT NULL, at REAL NOT NULL) STRICT;
CREATE TABLE participants (
    id TEXT PRIMARY KEY, key TEXT NOT NULL UNIQUE, cell TEXT NOT NULL,
    design TEXT NOT NULL REFERENCES designs, state TEXT NOT NULL, reason TEXT NOT NULL,
    started REAL NOT NULL, seen REAL NOT NULL, ended REAL
) STRICT;
CREATE TABLE platform_ids (
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    name TEXT NOT NULL, value TEXT NOT NULL, UNIQUE (name, value)
) STRICT;
CREATE TABLE answers (
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    step TEXT NOT NULL, text TEXT NOT NULL, shown TEXT NOT NULL, at REAL NOT NULL,
    PRIMARY KEY (participant, step)
) STRICT;
CREATE TABLE drafts (
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    step TEXT NOT NULL, text TEXT NOT NULL, at REAL NOT NULL,
    PRIMARY KEY (participant, step)
) STRICT;
CREATE TABLE events (
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    step TEXT NOT NULL, kind TEXT NOT NULL, value REAL NOT NULL, at REAL NOT NULL
) STRICT;
CREATE INDEX events_of ON events (participant, step);
CREATE TABLE exports (id INTEGER PRIMARY KEY, path TEXT NOT NULL, at REAL NOT NULL) STRICT;
CREATE TABLE exported (
    export INTEGER NOT NULL REFERENCES exports,
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE
) STRICT;
CREATE TABLE withdrawals (at REAL NOT NULL, exports TEXT NOT NULL) STRICT;
CREATE TABLE records (
    id TEXT PRIMARY KEY,
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    step TEXT NOT NULL, UNIQUE (participant, step)
) STRICT;
CREATE TABLE recordings (
    file TEXT PRIMARY KEY,
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    step TEXT NOT NULL, media_type TEXT NOT NULL, seconds REAL NOT NULL, at REAL NOT NULL,
    UNIQUE (participant, step)
) STRICT;
CREATE TABLE transcripts (
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    step TEXT NOT NULL, written_by TEXT NOT NULL, is_heard INTEGER NOT NULL,
    text TEXT NOT NULL, at REAL NOT NULL
) STRICT;
CREATE TABLE labels (
    participant TEXT NOT NULL REFERENCES participants ON DELETE CASCADE,
    step TEXT NOT NULL, annotator TEXT NOT NULL, settles INTEGER NOT NULL,
    label TEXT NOT NULL, places TEXT NOT NULL, at REAL NOT NULL,
    PRIMARY KEY (participant, step, annotator, settles)
) STRICT;
"""
FORMAT = 2


@contextmanager
def answer_file(study: Study, *, alone: bool) -> Generator[sqlite3.Connection]:
    """Open the file, and make it where one is alone with it."""
    folder = study.data_folder()
    if not alone and not (folder / FILE).is_file():
        raise StudyError(
            f"{folder}: there are no answers yet; expected those that `memorymaze study "
            f"serve {study.path}` gathers"
        )
    with ExitStack() as stack:
        if alone:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            stack.enter_context(locked(folder / "lock", _is_served))
        connection = stack.enter_context(
            closing(
                sqlite3.connect(
                    folder / FILE,
                    timeout=BUSY_TIMEOUT,
                    isolation_level=None,
                    check_same_thread=False,
                )
            )
        )
        try:
            _prepare(connection, study, folder)
            if alone:
                empty_log(connection, folder)
        except sqlite3.DatabaseError as error:
            raise StudyError(
                f"{folder / FILE}: cannot be used ({error}); restore it from a copy, or "
                "give the study file another name to begin anew"
            ) from None
        yield connection


def _prepare(connection: sqlite3.Connection, study: Study, folder: Path) -> None:
    for setting in (
        "journal_mode = WAL",
        "synchronous = FULL",
        "foreign_keys = ON",
        "secure_delete = ON",
        "temp_store = MEMORY",
    ):
        connection.execute(f"PRAGMA {setting}")
    connection.execute("BEGIN IMMEDIATE")
    try:
        [[version]] = connection.execute("PRAGMA user_version").fetchall()
        if version == 0:
            for statement in SCHEMA.split(";\n"):
                connection.execute(statement)
            connection.execute(f"PRAGMA user_version = {FORMAT}")
        elif version != FORMAT:
            raise StudyError(
                f"{folder / FILE}: expected answers of format {FORMAT}, got {version}, of "
                "another version of memorymaze"
            )
        _check_design(connection, study, folder)
    except BaseException:
        connection.execute("ROLLBACK")
        raise
    connection.execute("COMMIT")


def _check_design(connection: sqlite3.Connection, study: Study, folder: Path) -> None:
    """Refuse answers to another design; texts and quotas may change."""
    design = study.design
    wanted = {
        "kind": design.kind,
        "site": study.site.name,
        "orders": "; ".join(map(cell_name, route_orders(design))),
        "attention checks after": str([each.after_route for each in design.attention]),
    }
    found = dict(connection.execute("SELECT name, value FROM facts").fetchall())
    begun = connection.execute("SELECT 1 FROM participants LIMIT 1").fetchall()
    for name, value in wanted.items():
        if begun and found.get(name) != value:
            raise StudyError(
                f"{study.path}: expected the {name} {found.get(name)!r}, which people in "
                f"{folder} took part in, got {value!r}; undo the change, or copy the "
                "study file to another name to begin anew"
            )
    connection.executemany(
        "INSERT OR REPLACE INTO facts VALUES (?, ?)", list(wanted.items())
    )
    connection.execute(
        "INSERT OR IGNORE INTO designs VALUES (?, ?, ?)",
        (study.sha256, study.text, time.time()),
    )


def empty_log(connection: sqlite3.Connection, folder: Path) -> None:
    """Take the log over into the file and cut it to nothing."""
    deadline = time.monotonic() + 10
    while True:
        [[busy, *_]] = connection.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchall()
        if not busy:
            return
        if time.monotonic() > deadline:
            raise StudyError(
                f"{folder / FILE}: the rows are removed, but another program reads the "
                "file and keeps its log; end that program and start the server again"
            )
        time.sleep(0.05)


def _is_served(folder: Path, holder: str) -> StudyError:
    return StudyError(
        f"{folder}: these answers are being written already, by the process {holder}; "
        "end that server first (Ctrl-C), or use its pages"
    )
