"""A table of the statistics, as words."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StudyTable:
    """A table of words and numbers."""

    name: str
    """Short, such as `table_1`; the same in CSV."""
    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    labels: int
    """How many columns at the left say what a row is about."""
    notes: tuple[str, ...] = ()
    """Sentences: how it was counted."""


def place_title(place: str) -> str:
    """Return the title of a site or building.

    >>> place_title("museum_5f")
    'Museum 5F'
    """
    return place.replace("_", " ").title()
