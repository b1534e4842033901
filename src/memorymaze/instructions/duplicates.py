"""Texts that stand in instruction files twice, and ids that do not fit."""

import re
import unicodedata
from collections.abc import Iterable, Mapping

from memorymaze.instructions.files import InstructionProblem, place_of
from memorymaze.instructions.records import Instruction
from memorymaze.sites.records import Site

_NO_WORD = re.compile(r"[\W_]+")


def normalised(text: str) -> str:
    """Return a text's letters and numbers, in small letters, single spaces between.

    >>> normalised("Turn LEFT,  then \u2013 stop!")
    'turn left then stop'
    """
    plain = unicodedata.normalize("NFKC", text).casefold()
    return _NO_WORD.sub(" ", plain).strip()


def double_counts(instructions: Iterable[Instruction]) -> list[InstructionProblem]:
    """List instructions that another one repeats in everything but its id."""
    first: dict[tuple[object, ...], Instruction] = {}
    problems: list[InstructionProblem] = []
    for each in instructions:
        earlier = first.setdefault((*_given(each), each.text), each)
        if earlier is not each and earlier.id != each.id:
            problems.append(
                InstructionProblem(
                    place_of(each),
                    f"expected a new instruction, got {each.id!r}, which is "
                    f"{earlier.id!r} ({place_of(earlier)}) under another id; remove one",
                )
            )
    return problems


def repeated_texts(instructions: Iterable[Instruction]) -> list[InstructionProblem]:
    """List texts that stand elsewhere too, word for word or but for punctuation.

    Short texts of different people can be the same by chance; long ones hardly.
    """
    told = list(instructions)
    first: dict[str, Instruction] = {}
    cells: dict[tuple[object, ...], Instruction] = {}
    notes: list[InstructionProblem] = []
    for each in told:
        earlier = first.setdefault(normalised(each.text), each)
        counted_twice = _given(earlier) == _given(each) and earlier.text == each.text
        if earlier is not each and not counted_twice and not _paired(earlier, each):
            alike = (
                "the same text" if earlier.text == each.text else "nearly the same text"
            )
            notes.append(
                InstructionProblem(
                    place_of(each),
                    f"{each.id!r} has {alike} as {earlier.id!r} ({place_of(earlier)})",
                )
            )
        other = cells.setdefault(_given(each), each)
        if other.text != each.text and not _paired(other, each):
            notes.append(
                InstructionProblem(
                    place_of(each),
                    f"{each.id!r} and {other.id!r} ({place_of(other)}) are both of "
                    f"participant {each.participant!r} for {each.site} {each.route}, "
                    f"iteration {each.iteration}",
                )
            )
    return notes


def _paired(one: Instruction, other: Instruction) -> bool:
    """Tell whether a generator made one text from the other."""
    return one.pair is not None and one.pair == other.pair


def _given(each: Instruction) -> tuple[object, ...]:
    return each.study, each.participant, each.site, each.route, each.iteration


def odd_ids(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> list[InstructionProblem]:
    """List ids that name another site or route, or are hard to tell apart."""
    notes: list[InstructionProblem] = []
    folded: dict[str, Instruction] = {}
    studies: dict[str, Instruction] = {}
    for each in instructions:
        place = place_of(each)
        for field, got in (("id", each.id), ("participant", each.participant)):
            if got != got.strip() or not got.isprintable():
                notes.append(
                    InstructionProblem(
                        place,
                        f"field {field!r}: spaces at an end or control characters: {got!r}",
                    )
                )
            notes += [
                InstructionProblem(place, f"field {field!r}: {got!r} names {what}")
                for what in _contradictions(each, got, sites)
            ]
        alike = folded.setdefault(each.id.casefold(), each)
        if alike.id != each.id:
            notes.append(
                InstructionProblem(
                    place,
                    f"field 'id': {each.id!r} and {alike.id!r} differ in capitals only; "
                    "some disks take their traces for the same file",
                )
            )
        before = studies.setdefault(each.participant, each)
        if before.study != each.study:
            notes.append(
                InstructionProblem(
                    place,
                    f"field 'participant': {each.participant!r} is in study "
                    f"{each.study!r} here and {before.study!r} at {place_of(before)}",
                )
            )
    return notes


def _contradictions(
    each: Instruction, name: str, sites: Mapping[str, Site]
) -> list[str]:
    """Say which other site or route an id names, part by part."""
    parts = re.split(r"[-./: ]", name.casefold())
    found: list[str] = []
    others = {site.casefold() for site in sites} - {each.site.casefold()}
    if each.site.casefold() not in parts:
        found += [
            f"site {part!r}, not {each.site!r}" for part in parts if part in others
        ]
    site = sites.get(each.site)
    routes = {route.route.casefold() for route in site.routes} if site else set[str]()
    if each.route.casefold() not in parts:
        found += [
            f"route {part!r}, not {each.route!r}" for part in parts if part in routes
        ]
    return found
