"""The kinds of errors that memory makes, and what speech is like besides."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Study = Literal["online", "onsite"]


@dataclass(frozen=True, slots=True)
class ErrorKind:
    """A significant error: who follows the text as it stands does not arrive."""

    name: str
    """As the shipped corpus calls it."""
    studies: tuple[Study, ...]
    """Where the paper found it."""
    paper: str
    """The paper's words for it, section "Benchmark Analysis and Statistics"."""
    meaning: str


ERROR_KINDS: tuple[ErrorKind, ...] = (
    ErrorKind(
        "wrong_direction",
        ("online",),
        "turning in the wrong direction",
        "left for right at a turn, or the reverse",
    ),
    ErrorKind(
        "wrong_turning_point",
        ("online",),
        "instructing a turn at the incorrect turning point",
        "the right turn, one opening too early or too late",
    ),
    ErrorKind(
        "extra_turn",
        ("online", "onsite"),
        "suggesting unnecessary extra turns",
        "a turn where the way goes straight on",
    ),
    ErrorKind(
        "incorrect_direction",
        ("onsite",),
        "directing to an incorrect direction",
        "sends off the wrong way at the start",
    ),
    ErrorKind(
        "wrong_destination",
        ("onsite",),
        "leading to a wrong destination",
        "ends at another place and takes it for the destination",
    ),
    ErrorKind(
        "missing_turn",
        ("onsite",),
        "lacking essential turn information",
        "no word of a turn where one has a choice",
    ),
    ErrorKind(
        "wrong_direction_at_turn",
        ("onsite",),
        "turning to incorrect directions at a turn",
        "left for right at a turn on the way",
    ),
    ErrorKind(
        "inaccurate_environment",
        ("onsite",),
        "containing inaccurate environmental details",
        "a turn hangs on a thing that is not there",
    ),
)

SURFACE_KINDS: Mapping[str, str] = {
    "filler": "um, uh, you know",
    "restart": "begins again, or says the wrong side and takes it back",
    "hedge": "I think, maybe, if I remember",
    "distance": "a stated distance more than a quarter off the true one",
    "merged_turns": "two turns in quick succession told as one",
    "skipped_corner": "a corner without a choice that is not told as a turn",
    "alternative_way": "another way than the reference route, which arrives, too",
}
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
