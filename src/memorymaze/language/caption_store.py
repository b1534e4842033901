"""What vision models said of viewpoints, kept in a file, so that it is paid for once.

One SQLite file; several processes may write to it at once.
"""

import hashlib
import json
import sqlite3
from collections.abc import Generator, Sequence
from contextlib import closing, contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.language.model import Completion

_REPLIES = TypeAdapter(tuple[Completion, ...])

BUSY_TIMEOUT = 60.0
"""Seconds to wait while another process writes."""

TABLE = """
CREATE TABLE IF NOT EXISTS captions (
    scene TEXT NOT NULL,
    viewpoint TEXT NOT NULL,
    model TEXT NOT NULL,
    prompt TEXT NOT NULL,
    replies TEXT NOT NULL,
    PRIMARY KEY (scene, viewpoint, model, prompt)
)
"""


@dataclass(frozen=True, slots=True)
class CaptionKey:
    """What determines the captions of a viewpoint."""

    scene: str
    """Digest of the site plan."""
    viewpoint: str
    """Id in the navigation graph."""
    model: str
    """Name of the vision model."""
    prompt: str
    """Digest of what the model is asked, and of how its pictures are taken."""


class CaptionStore:
    """Replies by what determines them."""

    def __init__(self, path: Path | str) -> None:
        """Open or make the file.

        Raises:
            SettingsError: The file cannot be written, or is something else.
        """
        self._path = Path(path).absolute()
        try:
            with self._open(make=True) as database:
                database.execute(TABLE)
        except (sqlite3.Error, OSError) as error:
            raise SettingsError(
                f"{path}: expected a place for a file of captions ({error}); choose "
                "another one with --set caption_file=FILE"
            ) from error

    def find(self, key: CaptionKey) -> tuple[Completion, ...]:
        """Return the replies kept under a key, the last one usable; empty for none.

        Raises:
            LanguageModelError: The file cannot be read.
        """
        try:
            with self._open() as database:
                row = database.execute(
                    "SELECT replies FROM captions WHERE scene = ? AND viewpoint = ? "
                    "AND model = ? AND prompt = ?",
                    (key.scene, key.viewpoint, key.model, key.prompt),
                ).fetchone()
            return () if row is None else _REPLIES.validate_json(row[0])
        except (sqlite3.Error, ValidationError) as error:
            raise LanguageModelError(
                f"{self._path}: the captions cannot be read ({error})"
            ) from error

    def keep(
        self, key: CaptionKey, replies: Sequence[Completion]
    ) -> tuple[Completion, ...]:
        """Keep replies; return those that are kept, which another process may have.

        Raises:
            LanguageModelError: The file cannot be written.
        """
        text = json.dumps([asdict(each) for each in replies])
        try:
            with self._open() as database:
                database.execute(
                    "INSERT OR IGNORE INTO captions VALUES (?, ?, ?, ?, ?)",
                    (key.scene, key.viewpoint, key.model, key.prompt, text),
                )
        except sqlite3.Error as error:
            raise LanguageModelError(
                f"{self._path}: captions could not be kept ({error})"
            ) from error
        return self.find(key)

    @contextmanager
    def _open(self, *, make: bool = False) -> Generator[sqlite3.Connection]:
        """Open the file for one transaction; no connection outlives it."""
        address = f"{self._path.as_uri()}?mode={'rwc' if make else 'rw'}"
        connection = sqlite3.connect(address, timeout=BUSY_TIMEOUT, uri=True)
        with closing(connection), connection:
            yield connection


def digest(text: str | bytes) -> str:
    """Return the fingerprint of a text or of a file's bytes."""
    content = text.encode() if isinstance(text, str) else text
    return hashlib.sha256(content).hexdigest()
