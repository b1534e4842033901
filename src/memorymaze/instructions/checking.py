"""Everything that is wrong or looks odd in instruction files, all at once."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.corpus import site_problems
from memorymaze.instructions.duplicates import double_counts, odd_ids, repeated_texts
from memorymaze.instructions.files import (
    InstructionProblem,
    place_of,
    read_instruction_file,
    repeated_ids,
)
from memorymaze.instructions.label_notes import label_notes
from memorymaze.instructions.records import Instruction
from memorymaze.instructions.text_damage import invisible_characters, text_damage
from memorymaze.sites.records import Site

FOREIGN_SHARE = 0.3
"""Share of letters outside the Latin script from which a text is hardly English."""


@dataclass(frozen=True, slots=True)
class CheckReport:
    """What a check of instruction files found."""

    good: int
    """Instructions with nothing wrong; there may be notes on them."""
    errors: tuple[InstructionProblem, ...]
    """What keeps instructions from being used, or makes results wrong."""
    notes: tuple[InstructionProblem, ...]
    """What someone should look at, and may well be meant."""


def check_instruction_files(
    paths: Sequence[str | Path], sites: Mapping[str, Site]
) -> CheckReport:
    """Check files, also against the sites they speak of; never raises for content.

    Errors: what is not of the format, sites and routes that do not exist, ids that
    repeat, an instruction that is there twice, and texts whose encoding was damaged.
    Notes: equal or nearly equal texts, ids that name another site or route, labels that
    sit ill with the plan, invisible characters, another script than the language's.
    """
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    for path in paths:
        try:
            read, wrong = read_instruction_file(path)
        except InstructionFileError as error:
            place, _, message = str(error).partition(": ")
            problems.append(InstructionProblem(place, message))
        else:
            instructions += read
            problems += wrong
    unusable = repeated_ids(instructions) + site_problems(instructions, sites)
    unusable += double_counts(instructions) + _damaged(instructions)
    bad = {problem.place for problem in unusable}
    return CheckReport(
        good=sum(place_of(instruction) not in bad for instruction in instructions),
        errors=tuple(problems + unusable),
        notes=(
            *repeated_texts(instructions),
            *odd_ids(instructions, sites),
            *label_notes(instructions, sites),
            *_odd_characters(instructions),
        ),
    )


def _damaged(instructions: Sequence[Instruction]) -> list[InstructionProblem]:
    return [
        InstructionProblem(place_of(each), f"field {field!r}: {message}")
        for each in instructions
        for field, text in _texts(each)
        for message in text_damage(text)
    ]


def _texts(each: Instruction) -> list[tuple[str, str]]:
    texts = [("text", each.text), ("original_text", each.original_text or "")]
    for number, failure in enumerate(each.failures):
        texts.append((f"failures.{number}.where", failure.where))
        texts.append((f"failures.{number}.detail", failure.detail))
    return texts


def _odd_characters(instructions: Sequence[Instruction]) -> list[InstructionProblem]:
    notes: list[InstructionProblem] = []
    for each in instructions:
        hidden = invisible_characters(each.text)
        if hidden:
            message = f"field 'text': invisible characters ({', '.join(hidden)})"
            notes.append(InstructionProblem(place_of(each), message))
        letters = [character for character in each.text if character.isalpha()]
        foreign = sum(ord(character) > 0x24F for character in letters)
        if each.language.startswith("en") and foreign > FOREIGN_SHARE * len(letters):
            message = (
                f"field 'language': {each.language!r}, but {foreign} of {len(letters)} "
                "letters are not Latin"
            )
            notes.append(InstructionProblem(place_of(each), message))
    return notes
