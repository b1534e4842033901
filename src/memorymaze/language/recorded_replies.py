"""A store of language models' replies, so that a finished run can be run again.

One SQLite file, keyed by all that determines a reply: the model's name and the whole
request. Several processes may write to it at once. Pictures count by their bytes; a
replay that finds no reply for the bytes looks for one to pictures of the same names,
because OpenGL draws slightly other pixels on other machines.
"""

import hashlib
import json
import sqlite3
import warnings
from collections.abc import Callable, Generator
from contextlib import closing, contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from memorymaze.errors import (
    LanguageModelError,
    RecordedPicturesWarning,
    SettingsError,
)
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    Picture,
    Usage,
    takes_grammar,
)

_BUSY_TIMEOUT = 60.0
"""Seconds to wait while another process writes."""

_TABLE = """
CREATE TABLE IF NOT EXISTS replies (
    key TEXT PRIMARY KEY,
    model TEXT NOT NULL,
    request TEXT NOT NULL,
    completion TEXT NOT NULL
)
"""

_NAMED_TABLE = """
CREATE TABLE IF NOT EXISTS replies_by_names (
    names_key TEXT NOT NULL,
    key TEXT NOT NULL,
    PRIMARY KEY (names_key, key)
)
"""


def request_key(model: str, request: CompletionRequest) -> str:
    """Return the key of a reply: a digest of the model's name and the request."""
    asked = json.dumps([model, _record(request)], sort_keys=True)
    return hashlib.sha256(asked.encode()).hexdigest()


def _names_key(model: str, request: CompletionRequest) -> str | None:
    """Return a key that takes pictures by their names; None where one has none."""
    shown = [each for message in request.messages for each in message.pictures]
    if not shown or any(picture.name is None for picture in shown):
        return None
    record = _record(request, lambda picture: {"name": picture.name})
    asked = json.dumps([model, record], sort_keys=True)
    return hashlib.sha256(asked.encode()).hexdigest()


def _digest(picture: Picture) -> dict[str, Any]:
    return {
        "media_type": picture.media_type,
        "bytes": len(picture.data),
        "sha256": hashlib.sha256(picture.data).hexdigest(),
    }


def _record(
    request: CompletionRequest, show: Callable[[Picture], dict[str, Any]] = _digest
) -> dict[str, Any]:
    """Return a request as JSON knows it; a picture by its digest.

    What a request does not use is left out, so that a request of text alone has the
    key it had before there were pictures and grammars.
    """
    record = asdict(request)
    if request.grammar is None:
        del record["grammar"]
    for message, shown in zip(record["messages"], request.messages, strict=True):
        del message["pictures"]
        if shown.pictures:
            message["pictures"] = [show(picture) for picture in shown.pictures]
    return record


class RecordingModel:
    """Asks a model and keeps its replies; what is kept already is not asked again."""

    def __init__(self, model: LanguageModel, path: Path | str) -> None:
        """Open or make the file.

        Raises:
            SettingsError: The file cannot be written, or is something else.
        """
        self._model = model
        self._path = Path(path)
        try:
            with _open(self._path, make=True) as database:
                database.execute(_TABLE)
                database.execute(_NAMED_TABLE)
        except (sqlite3.Error, OSError) as error:
            raise SettingsError(
                f"{self._path}: expected a place for a file of recorded replies ({error})"
            ) from error

    @property
    def name(self) -> str:
        """Name of the model asked."""
        return self._model.name

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the reply kept for a request, else ask, keep and return it.

        Where two processes ask the same at once, both return the reply that was kept.

        Raises:
            LanguageModelError: The model did not answer, or the file failed.
        """
        if not takes_grammar(self._model):
            # It does not determine the reply, so it is not in the key.
            request = replace(request, grammar=None)
        key = request_key(self.name, request)
        kept = _look_up(self._path, key)
        if kept is not None:
            return kept
        completion = self._model.complete(request)
        try:
            with _open(self._path) as database:
                database.execute(
                    "INSERT OR IGNORE INTO replies VALUES (?, ?, ?, ?)",
                    (
                        key,
                        self.name,
                        json.dumps(_record(request)),
                        json.dumps(asdict(completion)),
                    ),
                )
                database.execute(
                    "INSERT OR IGNORE INTO replies_by_names SELECT ?, ? WHERE ? NOTNULL",
                    (names := _names_key(self.name, request), key, names),
                )
        except sqlite3.Error as error:
            raise LanguageModelError(
                f"{self._path}: the reply could not be kept ({error})"
            ) from error
        return _look_up(self._path, key) or completion


class ReplayingModel:
    """Gives recorded replies and never asks a model."""

    def __init__(self, path: Path | str, *, name: str | None = None) -> None:
        """Look into the file.

        Args:
            path: File that a `RecordingModel` has written.
            name: Name of the model whose replies are wanted; None for the only one
                there is.

        Raises:
            SettingsError: There is no such file, it is something else, or which
                model is meant is not clear; the message names the models it has.
        """
        self._path = Path(path)
        if not self._path.is_file():
            raise SettingsError(f"{self._path}: there are no recorded replies here")
        try:
            with _open(self._path) as database:
                rows = database.execute("SELECT DISTINCT model FROM replies").fetchall()
        except sqlite3.Error as error:
            raise SettingsError(
                f"{self._path}: expected a file of recorded replies ({error})"
            ) from error
        models = sorted(str(model) for (model,) in rows)
        if name not in models and not (name is None and len(models) == 1):
            raise SettingsError(
                f"{self._path}: expected replies of {name or 'a single model'}, "
                f"got replies of {', '.join(models) or 'none'}"
            )
        self._name = name or models[0]
        self._warned = False

    @property
    def name(self) -> str:
        """Name of the model whose replies these are."""
        return self._name

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the recorded reply.

        Where none is recorded for these pictures but one for pictures of their names,
        that is returned, and a warning says so once.

        Raises:
            LanguageModelError: None is recorded for this request.
        """
        free = replace(request, grammar=None)
        kept = None
        # Whether the model recorded was held to a grammar, its replies tell.
        for each in dict.fromkeys((request, free)):
            kept = kept or _look_up(self._path, request_key(self._name, each))
        for each in dict.fromkeys((request, free)):
            kept = kept or self._by_names(each)
        if kept is None:
            key = request_key(self._name, free)
            raise LanguageModelError(
                f"{self._path}: no reply of {self._name} is recorded for this request "
                f"({key[:12]}); it differs from what was asked when recording"
            )
        return kept

    def _by_names(self, request: CompletionRequest) -> Completion | None:
        names = _names_key(self._name, request)
        key = None if names is None else _only_key(self._path, names)
        kept = None if key is None else _look_up(self._path, key)
        if kept is not None and not self._warned:
            self._warned = True
            warnings.warn(
                f"{self._path}: the pictures differ from those that {self._name} was "
                "shown, as they do when drawn by another OpenGL; its replies to the "
                "pictures of the same names are taken",
                RecordedPicturesWarning,
                stacklevel=3,
            )
        return kept


def _only_key(path: Path, names: str) -> str | None:
    """Return the key recorded for pictures of these names; None unless there is one."""
    try:
        with _open(path) as database:
            rows = database.execute(
                "SELECT key FROM replies_by_names WHERE names_key = ?", (names,)
            ).fetchall()
    except sqlite3.OperationalError:  # recorded before pictures had names
        return None
    return str(rows[0][0]) if len(rows) == 1 else None


def _look_up(path: Path, key: str) -> Completion | None:
    try:
        with _open(path) as database:
            row = database.execute(
                "SELECT completion FROM replies WHERE key = ?", (key,)
            ).fetchone()
        return None if row is None else _read(json.loads(row[0]))
    except (sqlite3.Error, ValueError, KeyError, TypeError) as error:
        raise LanguageModelError(
            f"{path}: the recorded replies cannot be read ({error})"
        ) from error


def _read(record: dict[str, Any]) -> Completion:
    usage = Usage(**record.pop("usage"))
    return Completion(usage=usage, **record)


@contextmanager
def _open(path: Path, *, make: bool = False) -> Generator[sqlite3.Connection]:
    """Open the file for one transaction.

    A connection lives no longer: none may be carried into another process. Reading too
    opens for writing where that is allowed, to undo what a killed process left half
    written.
    """
    address = f"{path.absolute().as_uri()}?mode={'rwc' if make else 'rw'}"
    connection = sqlite3.connect(address, timeout=_BUSY_TIMEOUT, uri=True)
    with closing(connection), connection:
        yield connection
