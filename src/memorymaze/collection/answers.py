"""Checking what annotators answer, typed or in a sheet."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from memorymaze.collection.labels import KINDS, NO_WAY, Label, text_stamp
from memorymaze.collection.ways import ways_of
from memorymaze.errors import did_you_mean
from memorymaze.instructions.records import Failure, Instruction
from memorymaze.sites.records import Site

YES, NO = ("yes", "y", "1", "true"), ("no", "n", "0", "false")


@dataclass(frozen=True)
class Question:
    """An instruction that waits for a label."""

    instruction: Instruction
    site: Site

    @property
    def ways(self) -> list[str]:
        """Ids of the ways that it can describe, the reference first."""
        return [way.id for way in ways_of(self.site, self.instruction.route)]

    def label(self, annotator: str, way: str, failures: Sequence[Failure]) -> Label:
        """Return the answer as a label."""
        told = self.instruction
        stamp = text_stamp(told.text)
        return Label(told.id, stamp, annotator, way, tuple(failures))


def questions(
    instructions: Sequence[Instruction],
    sites: Mapping[str, Site],
    done: Collection[str] = (),
) -> list[Question]:
    """Return the instructions without a label, in their order."""
    return [
        Question(each, sites[each.site]) for each in instructions if each.id not in done
    ]


def read_yes_or_no(answer: str) -> bool:
    """Return whether an answer is yes.

    Raises:
        ValueError: It is neither yes nor no.
    """
    said = answer.strip().casefold()
    if said in YES:
        return True
    if said in NO:
        return False
    raise ValueError(f"expected yes or no, got {answer!r}")


def read_way(answer: str, ways: Sequence[str]) -> str:
    """Return the way of an answer: its id, its number from 1, or 0 or `none`.

    Raises:
        ValueError: There is no such way.
    """
    return _choice(answer, (NO_WAY, *ways), "a way")


def read_kind(answer: str) -> str:
    """Return the kind of failure of an answer: its name, or its number from 0.

    Raises:
        ValueError: There is no such kind.
    """
    return _choice(answer.replace(" ", "_"), tuple(KINDS), "a kind of failure")


def _choice(answer: str, choices: Sequence[str], what: str) -> str:
    said = answer.strip().strip("_").casefold()
    if said.isdecimal() and int(said) < len(choices):
        return choices[int(said)]
    for choice in choices:
        if said == choice.casefold():
            return choice
    raise ValueError(
        f"expected {what} (0 to {len(choices) - 1}, or {', '.join(choices)}), got "
        f"{answer!r}{did_you_mean(said, choices)}"
    )
