"""Captions of viewpoints kept in a file, so that each is paid for once.

One SQLite file; several processes may write to it at once.
"""

import hashlib
import json
import sqlite3
from collections.abc import Generator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from memorymaze.errors import LanguageModelError, SettingsError

__all__ = ["CaptionKey", "CaptionStore", "Captions", "digest"]

BUSY_TIMEOUT = 60.0
"""Seconds to wait while another process writes."""

TABLE = """
CREATE TABLE IF NOT EXISTS captions (
    scene TEXT NOT NULL,
    viewpoint TEXT NOT NULL,
    model TEXT NOT NULL,
    prompt TEXT NOT NULL,
    captions TEXT NOT NULL,
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


@dataclass(frozen=True, slots=True)
class Captions:
    """What a vision model says of a viewpoint."""

    views: tuple[str, ...]
    """A sentence for each of eight directions, north first, then clockwise."""
    summary: str


class CaptionStore:
    """Captions by what determines them."""

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

    def find(self, key: CaptionKey) -> Captions | None:
        """Return the captions kept under a key; None where there are none.

        Raises:
            LanguageModelError: The file cannot be read.
        """
        try:
            with self._open() as database:
                row = database.execute(
                    "SELECT captions FROM captions WHERE scene = ? AND viewpoint = ? "
                    "AND model = ? AND prompt = ?",
                    (key.scene, key.viewpoint, key.model, key.prompt),
                ).fetchone()
            if row is None:
                return None
            record = json.loads(row[0])
            return Captions(tuple(map(str, record["views"])), str(record["summary"]))
        except (sqlite3.Error, ValueError, KeyError, TypeError) as error:
            raise LanguageModelError(
                f"{self._path}: the captions cannot be read ({error})"
            ) from error

    def keep(self, key: CaptionKey, captions: Captions) -> Captions:
        """Keep captions; return those that are kept, which another process may have.

        Raises:
            LanguageModelError: The file cannot be written.
        """
        text = json.dumps({"views": captions.views, "summary": captions.summary})
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
        return self.find(key) or captions

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
