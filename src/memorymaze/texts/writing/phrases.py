"""The phrases of the grammar, read once from `data/phrases.toml`."""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any


@cache
def _table() -> dict[str, Any]:
    data = files("memorymaze.texts.writing") / "data"
    return tomllib.loads((data / "phrases.toml").read_text(encoding="utf-8"))


@cache
def phrases(*names: str) -> tuple[str, ...]:
    """Return a list of phrases by the names of its tables and its own."""
    table = _table()
    for name in names:
        table = table[name]
    return tuple(table)


def words_for(name: str) -> Mapping[str, str]:
    """Return a table of words for categories, such as `plain_doors`."""
    return _table()[name]
