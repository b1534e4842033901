"""Instruction files: reading and writing them (JSONL, CSV, Parquet).

Every record is checked; where some are bad the whole load is refused, with a message
that lists them.
"""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

from memorymaze.basics.errors import InstructionFileError
from memorymaze.basics.input_files import read_lines, refusal
from memorymaze.texts.corpus.record_format import (
    InstructionProblem,
    instruction_record,
    parse_line,
    warn_of_unknown,
    write_file,
)
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.corpus.spreadsheets import (
    TABLE_KINDS,
    read_rows,
    spreadsheet_kind,
)

BUILTIN_CORPUS = Path(str(files("memorymaze.texts.corpus") / "data/role_played.jsonl"))
"""The shipped corpus: 564 texts written by a language model (see its README)."""

TEXT_ENDINGS = (".jsonl", *TABLE_KINDS)
"""Of the names of instruction files."""

Findings = Iterator[tuple[Instruction, str]]
"""What is wrong with instructions, or odd about them, one by one."""


def instruction_place(instruction: Instruction) -> str:
    """Return where an instruction comes from: `file:line`, else its id."""
    return instruction.origin or f"instruction {instruction.id}"


def placed(*found: Findings) -> list[InstructionProblem]:
    """Return what was found, each with its place."""
    return [
        InstructionProblem(instruction_place(each), message)
        for findings in found
        for each, message in findings
    ]


def repeated_ids(instructions: Iterable[Instruction]) -> Findings:
    """Yield the instructions whose id an earlier one has."""
    first: dict[str, Instruction] = {}
    for each in instructions:
        earlier = first.setdefault(each.id, each)
        if earlier is not each:
            yield (
                each,
                f"field 'id': expected a new id, got {each.id!r}, which "
                f"{instruction_place(earlier)} has",
            )


def load_instructions(
    paths: Sequence[str | Path] | None = None,
) -> list[Instruction]:
    """Read instruction files, in order.

    A field the format does not know is left out, with a warning; where it looks like
    a misspelt optional field it is an error.

    Args:
        paths: JSONL files, or tables whose names end in `.csv` or `.parquet`; None for
            the shipped corpus.

    Raises:
        InstructionFileError: A file cannot be read, or has bad lines; lists them.
    """
    chosen = [BUILTIN_CORPUS] if paths is None else paths
    if not chosen:
        raise InstructionFileError(
            "no instruction files given: expected at least one file"
        )
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    for path in chosen:
        read, wrong = read_instruction_file(path)
        instructions += read
        problems += wrong
    problems += placed(repeated_ids(instructions))
    if problems:
        raise refusal(problems, InstructionFileError)
    return instructions


def read_instruction_file(
    path: str | Path,
) -> tuple[list[Instruction], list[InstructionProblem]]:
    """Read one file; return the good instructions and what is wrong with the others.

    UTF-8, with or without a byte order mark, any line ends; blank lines are allowed.
    Whether ids repeat is for the caller to see, who knows the other files.

    Raises:
        InstructionFileError: The file cannot be read, is not UTF-8, or is empty.
    """
    kind = spreadsheet_kind(path)
    if kind is not None:
        return read_rows(path, kind)
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    unknown: dict[str, str] = {}
    for place, line in read_lines(path, InstructionFileError):
        instruction, extra, wrong = parse_line(line, place)
        problems += [InstructionProblem(place, message) for message in wrong]
        if instruction is not None:
            instructions.append(instruction)
        for name in extra:
            unknown.setdefault(name, place)
    if not instructions and Path(path).suffix.lower() not in TEXT_ENDINGS:
        said = f"is read as JSONL; tables are files whose names end in {' or '.join(TABLE_KINDS)}"
        problems.insert(0, InstructionProblem(str(path), said))
    for name, place in unknown.items():
        warn_of_unknown(name, place)
    return instructions, problems


def write_instructions(path: str | Path, instructions: Iterable[Instruction]) -> None:
    """Write an instruction file.

    Raises:
        InstructionFileError: The file cannot be written.
    """
    write_file(path, lines(instruction_record(each) for each in instructions))


def lines(records: Iterable[Mapping[str, Any]]) -> bytes:
    """Return records as JSON, one per line."""
    texts = (json.dumps(record, ensure_ascii=False) + "\n" for record in records)
    return "".join(texts).encode()
