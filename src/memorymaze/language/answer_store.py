"""A store of language models' answers, so that a finished run can be run again.

One SQLite file. An answer is found by all that determines it, the model's name and the
whole request, or by its question: instruction, stage, number and version of the prompt.
Several processes may write to it at once. Pictures count by their bytes; where there is no
answer to the bytes, one to pictures of the same names can be had, because OpenGL draws
slightly other pixels on other machines.
"""

import hashlib
import json
import sqlite3
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

from memorymaze.durable_files import open_database
from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    Picture,
    Question,
    Usage,
)

TABLES = (
    """
    CREATE TABLE IF NOT EXISTS replies (
        key TEXT PRIMARY KEY,
        model TEXT NOT NULL,
        request TEXT NOT NULL,
        completion TEXT NOT NULL
    )
    """,
    """
    CREATE TABLE IF NOT EXISTS replies_by_names (
        names_key TEXT NOT NULL,
        key TEXT NOT NULL,
        PRIMARY KEY (names_key, key)
    )
    """,
    """
    CREATE TABLE IF NOT EXISTS questions (
        instruction TEXT NOT NULL,
        stage TEXT NOT NULL,
        number INTEGER NOT NULL,
        prompt TEXT NOT NULL,
        key TEXT NOT NULL,
        PRIMARY KEY (instruction, stage, number, prompt, key)
    )
    """,
    """
    CREATE TABLE IF NOT EXISTS requests (
        id TEXT PRIMARY KEY,
        model TEXT NOT NULL,
        key TEXT NOT NULL,
        request TEXT NOT NULL
    )
    """,
    "CREATE TABLE IF NOT EXISTS models (name TEXT PRIMARY KEY)",
)
"""Answers, by their requests, by pictures' names and by questions; requests written for
others to answer; and the models they were written for. Stores of older versions have the
first, or the first two; their answers are found by the whole request."""


def request_key(model: str, request: CompletionRequest) -> str:
    """Return the key of an answer: a digest of the model's name and the request."""
    return _digest([model, _record(request)])


class AnswerStore:
    """The answers in one file."""

    def __init__(self, path: Path | str, *, make: bool = False) -> None:
        """Open the file, or make it."""
        self.path = Path(path)
        if not make and not self.path.is_file():
            raise SettingsError(f"{self.path}: there are no recorded replies here")
        try:
            with open_database(self.path, make=make) as database:
                for table in TABLES if make else ():
                    database.execute(table)
                rows = database.execute("SELECT DISTINCT model FROM replies").fetchall()
        except (sqlite3.Error, OSError) as error:
            expected = "a place for a file" if make else "a file"
            raise SettingsError(
                f"{self.path}: expected {expected} of recorded replies ({error})"
            ) from error
        rows += self._rows("SELECT name FROM models")
        self.models = sorted({str(model) for (model,) in rows})

    def find(self, model: str, request: CompletionRequest) -> Completion | None:
        """Return the answer to exactly this request."""
        return self._completion(request_key(model, request))

    def find_by_names(
        self, model: str, request: CompletionRequest
    ) -> Completion | None:
        """Return the one answer to this request with pictures of the same names."""
        names = _names_key(model, request)
        if names is None:
            return None
        rows = self._rows("SELECT key FROM replies_by_names WHERE names_key = ?", names)
        return self._completion(str(rows[0][0])) if len(rows) == 1 else None

    def find_by_question(self, model: str, question: Question) -> Completion | None:
        """Return the answer to a question under the last other version of its prompt.

        Under the same version it is found by its request, or was given to another one:
        to another text, or in another place. None too where there are several answers.
        """
        rows = self._rows(
            "SELECT q.prompt, q.key FROM questions q JOIN replies r ON q.key = r.key "
            "WHERE r.model = ? AND q.instruction = ? AND q.stage = ? AND q.number = ? "
            "ORDER BY r.rowid",
            *(model, question.instruction, question.stage, question.number),
        )
        if any(prompt == question.prompt for prompt, _ in rows):
            return None
        keys = [key for prompt, key in rows if prompt == rows[-1][0]]
        return self._completion(keys[0]) if len(keys) == 1 else None

    def stages(self, model: str) -> dict[tuple[str, str], set[str | None]]:
        """Return the versions of prompts that there are answers to.

        By instruction and stage; empty for stores of older versions.
        """
        found: dict[tuple[str, str], set[str | None]] = {}
        for instruction, stage, prompt in self._rows(
            "SELECT DISTINCT q.instruction, q.stage, q.prompt FROM questions q JOIN "
            "replies r ON q.key = r.key WHERE r.model = ?",
            model,
        ):
            found.setdefault((instruction, stage), set()).add(prompt)
        return found

    def keep(
        self, model: str, request: CompletionRequest, completion: Completion
    ) -> Completion:
        """Keep an answer; return the one that is kept, which another process may have."""
        key = request_key(model, request)
        names = _names_key(model, request)
        record = json.dumps(_record(request))
        with self._writing() as database:
            database.execute(
                "INSERT OR IGNORE INTO replies VALUES (?, ?, ?, ?)",
                (key, model, record, json.dumps(asdict(completion))),
            )
            if names is not None:
                database.execute(
                    "INSERT OR IGNORE INTO replies_by_names VALUES (?, ?)", (names, key)
                )
            _keep_question(database, request.question, key)
        return self._completion(key) or completion

    def expect(self, model: str) -> None:
        """Take note that a model is to answer."""
        with self._writing() as database:
            database.execute("INSERT OR IGNORE INTO models VALUES (?)", (model,))

    def ask(self, model: str, request: CompletionRequest) -> str:
        """Keep a request that somebody else is to answer; return its id.

        Questions that are asked in the same words are one request.
        """
        key = request_key(model, request)
        question = request.question
        named = key if question is None else f"{question.stage}/{question.instruction}"
        identifier = f"{named}/{key[:12]}"
        record = json.dumps(_record(request))
        with self._writing() as database:
            asked = database.execute("SELECT id FROM requests WHERE key = ?", (key,))
            known = asked.fetchone()
            if known is None:
                row = (identifier, model, key, record)
                database.execute("INSERT INTO requests VALUES (?, ?, ?, ?)", row)
            _keep_question(database, question, key)
        return identifier if known is None else str(known[0])

    def answer(self, identifier: str, completion: Completion) -> None:
        """Keep the answer to a request that was kept before."""
        rows = self._rows(
            "SELECT key, model, request FROM requests WHERE id = ?", identifier
        )
        if not rows:
            raise ValueError(
                f"{self.path} has not asked {identifier!r}; give the store that "
                "`memorymaze answers requests` wrote the request to"
            )
        key, model, record = rows[0]
        kept = self._completion(key)
        if kept is None:
            with self._writing() as database:
                database.execute(
                    "INSERT OR IGNORE INTO replies VALUES (?, ?, ?, ?)",
                    (key, model, record, json.dumps(asdict(completion))),
                )
        elif kept.text != completion.text:
            raise ValueError(
                f"{self.path} has another answer to {identifier!r} already; choose "
                "another store to compare them"
            )

    def _completion(self, key: str) -> Completion | None:
        rows = self._rows("SELECT completion FROM replies WHERE key = ?", key)
        if not rows:
            return None
        try:
            record: dict[str, Any] = json.loads(rows[0][0])
            usage = Usage(**record.pop("usage"))
            return Completion(usage=usage, **record)
        except (ValueError, KeyError, TypeError) as error:
            raise self._unreadable(error) from error

    def _rows(self, query: str, *values: object) -> list[tuple[Any, ...]]:
        try:
            with open_database(self.path) as database:
                return database.execute(query, values).fetchall()
        except sqlite3.OperationalError as error:
            # Recorded before pictures had names, or requests were questions.
            if "no such table" in str(error):
                return []
            raise self._unreadable(error) from error
        except sqlite3.Error as error:
            raise self._unreadable(error) from error

    def _unreadable(self, error: Exception) -> LanguageModelError:
        return LanguageModelError(
            f"{self.path}: the recorded replies cannot be read ({error})"
        )

    @contextmanager
    def _writing(self) -> Generator[sqlite3.Connection]:
        try:
            with open_database(self.path) as database:
                yield database
        except sqlite3.Error as error:
            raise LanguageModelError(
                f"{self.path}: the reply could not be kept ({error})"
            ) from error


def _keep_question(
    database: sqlite3.Connection, question: Question | None, key: str
) -> None:
    if question is not None and question.instruction:
        row = (question.instruction, question.stage, question.number, question.prompt)
        database.execute(
            "INSERT OR IGNORE INTO questions VALUES (?, ?, ?, ?, ?)", (*row, key)
        )


def _digest(content: object) -> str:
    asked = json.dumps(content, sort_keys=True)
    return hashlib.sha256(asked.encode()).hexdigest()


def _names_key(model: str, request: CompletionRequest) -> str | None:
    """Return a key that takes pictures by their names; None where one has none."""
    shown = [each for message in request.messages for each in message.pictures]
    if not shown or any(picture.name is None for picture in shown):
        return None
    return _digest([model, _record(request, lambda picture: {"name": picture.name})])


def _fingerprint(picture: Picture) -> dict[str, Any]:
    return {
        "media_type": picture.media_type,
        "bytes": len(picture.data),
        "sha256": hashlib.sha256(picture.data).hexdigest(),
    }


def _record(
    request: CompletionRequest,
    show: Callable[[Picture], dict[str, Any]] = _fingerprint,
) -> dict[str, Any]:
    """Return a request as JSON knows it; a picture by its digest.

    What does not determine the answer or is not used is left out, so that a request of
    text alone has the key it had before there were pictures, grammars and questions.
    """
    record = asdict(request)
    del record["question"]
    if request.grammar is None:
        del record["grammar"]
    for message, shown in zip(record["messages"], request.messages, strict=True):
        del message["pictures"]
        if shown.pictures:
            message["pictures"] = [show(picture) for picture in shown.pictures]
    return record
