"""The tables of this room: word lists and outlines in `data/`, read and checked once."""

from importlib.resources import files
from typing import TypeVar

from pydantic import TypeAdapter

T = TypeVar("T")


def read_table(name: str, kind: type[T]) -> T:
    """Return what a file of `data/` holds, checked to be of a kind."""
    text = (files("memorymaze.world.looks") / "data" / name).read_text(encoding="utf-8")
    return TypeAdapter(kind).validate_json(text)
