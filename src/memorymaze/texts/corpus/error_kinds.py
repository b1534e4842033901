"""The kinds of errors that memory makes, and what speech is like besides."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

from memorymaze.texts.corpus.published import PublishedStudy


@dataclass(frozen=True, slots=True)
class ErrorKind:
    """A significant error: who follows the text as it stands does not arrive."""

    name: str
    """As the shipped corpus calls it."""
    studies: tuple[PublishedStudy, ...]
    """Where the paper found it."""
    paper: str
    """The paper's words for it, section "Benchmark Analysis and Statistics"."""
    meaning: str


_KINDS: dict[str, Any] = tomllib.loads(
    (files("memorymaze.texts.corpus") / "data/error_kinds.toml").read_text("utf-8")
)
ERROR_KINDS: tuple[ErrorKind, ...] = tuple(
    ErrorKind(name, tuple(row["studies"]), row["paper"], row["meaning"])
    for name, row in _KINDS["error"].items()
)
SURFACE_KINDS: Mapping[str, str] = _KINDS["surface"]
"""What does not make a text wrong."""


def kinds_of(study: str) -> tuple[str, ...]:
    """Return the names of the kinds that the paper found in a study."""
    return tuple(kind.name for kind in ERROR_KINDS if study in kind.studies)


def meaning_of(name: str) -> str:
    """Return what a kind means, in plain words; the name where it is not known."""
    for kind in ERROR_KINDS:
        if kind.name == name:
            return kind.meaning
    return SURFACE_KINDS.get(name, name)
