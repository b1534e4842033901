"""Instruction files (JSONL): reading, refusing and writing them.

Every line is checked; where lines are bad the whole load is refused, with a message
that lists them.
"""

import json
import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, fields, replace
from importlib.resources import files
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from memorymaze.durable_files import write_whole
from memorymaze.errors import (
    InstructionFileError,
    InstructionFileWarning,
)
from memorymaze.input_files import (
    mistakes,
    parse_record,
    read_lines,
    refusal,
    unknown_fields,
)
from memorymaze.instructions.records import Instruction

BUILTIN_CORPUS = Path(str(files("memorymaze.instructions") / "data/role_played.jsonl"))
"""The shipped corpus: 564 texts written by a language model (see its README)."""
FIELDS = tuple(each.name for each in fields(Instruction) if each.name != "origin")
"""Names of what a line can have."""
OPTIONAL = ("original_text", "followers", "pair", "spans", "method")
"""Those that are not written where they say nothing."""
_INSTRUCTION = TypeAdapter(Instruction)


@dataclass(frozen=True, slots=True)
class InstructionProblem:
    """Something wrong in an instruction file."""

    place: str
    """`file`, or `file:line`."""
    message: str
    """What was expected and what came, naming the field."""

    def __str__(self) -> str:
        """Return one line: place and message."""
        return f"{self.place}: {self.message}"


def place_of(instruction: Instruction) -> str:
    """Return where an instruction comes from: `file:line`, else its id."""
    return instruction.origin or f"instruction {instruction.id}"


def repeated_ids(instructions: Iterable[Instruction]) -> list[InstructionProblem]:
    """List the instructions whose id an earlier one has."""
    first: dict[str, Instruction] = {}
    problems: list[InstructionProblem] = []
    for instruction in instructions:
        earlier = first.setdefault(instruction.id, instruction)
        if earlier is not instruction:
            message = (
                f"field 'id': expected a new id, got {instruction.id!r}, which "
                f"{place_of(earlier)} has"
            )
            problems.append(InstructionProblem(place_of(instruction), message))
    return problems


def load_instructions(
    paths: Sequence[str | Path] | None = None,
) -> list[Instruction]:
    """Read instruction files, in order.

    A field the format does not know is left out, with a warning; where it looks like
    a misspelt optional field it is an error.

    Args:
        paths: JSONL files; None for the shipped corpus.

    Raises:
        InstructionFileError: A file cannot be read, or has bad lines; lists them.
    """
    chosen = [BUILTIN_CORPUS] if paths is None else paths
    if not chosen:
        raise InstructionFileError(
            "no instruction files given: expected at least one JSONL file"
        )
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    for path in chosen:
        read, wrong = read_instruction_file(path)
        instructions += read
        problems += wrong
    problems += repeated_ids(instructions)
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
    for name, place in unknown.items():
        warn_of_unknown(name, place)
    return instructions, problems


def warn_of_unknown(name: str, place: str) -> None:
    """Warn of a field that is left out."""
    warnings.warn(
        f"{place}: field {name!r} is not part of the format and not used",
        InstructionFileWarning,
        stacklevel=4,
    )


def parse_line(
    line: str, place: str
) -> tuple[Instruction | None, list[str], list[str]]:
    """Read one line.

    Returns:
        The instruction, or None where something is wrong; the names of fields that
        the format does not know; and what is wrong, one entry per field.
    """
    try:
        return read_record(parse_record(line), place)
    except ValueError as error:
        return None, [], [str(error)]


def read_record(
    record: Mapping[str, Any], place: str
) -> tuple[Instruction | None, list[str], list[str]]:
    """Read one record from `file:line`; returns what `parse_line` does.

    An instruction without an id is called after file and line.
    """
    try:
        unknown = unknown_fields(record, FIELDS)
        known = {name: record[name] for name in FIELDS if name in record}
        name = known.setdefault("id", _name_of(place))
        known.setdefault("participant", name)
        read = _INSTRUCTION.validate_python({**known, "origin": place})
        _check_spans(read)
    except ValidationError as error:
        return None, [], [f"field {name!r}: {said}" for name, said in mistakes(error)]
    except ValueError as error:
        return None, [], [str(error)]
    return tidied(read), unknown, []


def tidied(instruction: Instruction) -> Instruction:
    """Return an instruction with the white space of its text in order.

    Spaces, tabs and their like become one space, and none stand at the ends of lines.
    Where words are labelled by their places the text stays as it is.
    """
    if instruction.spans:
        return instruction
    lines = re.split(r"\r\n?|\n", instruction.text)
    text = "\n".join(" ".join(line.split()) for line in lines).strip()
    return replace(instruction, text=re.sub(r"\n{3,}", "\n\n", text))


def _name_of(place: str) -> str:
    """Return `mine-3` for `folder/mine.jsonl:3`."""
    file, _, number = place.rpartition(":")
    return f"{Path(file).stem}-{number.removeprefix(' row ')}"


def _check_spans(instruction: Instruction) -> None:
    length = len(instruction.text)
    for number, span in enumerate(instruction.spans):
        if not span.start <= span.end <= length:
            raise ValueError(
                f"field 'spans[{number}]': expected start <= end <= {length}, the length "
                f"of the text, got {span.start} and {span.end}"
            )


def instruction_record(instruction: Instruction) -> dict[str, Any]:
    """Return the JSON record of an instruction, which `parse_line` reads back."""
    record = asdict(instruction)
    del record["origin"]
    for optional in OPTIONAL:
        if not record[optional] and record[optional] != "":
            del record[optional]
    for filled_in in ("id", "participant", "reference_route"):
        if not record[filled_in]:
            del record[filled_in]
    return record


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


def write_file(path: str | Path, content: bytes) -> None:
    """Write a file, and the folders it lies in; in full or not at all.

    Raises:
        InstructionFileError: It cannot be written.
    """
    path = Path(path)
    if not path.name or path.is_dir():
        raise InstructionFileError(f"{path}: expected a file to write, got a folder")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, content)
    except OSError as error:
        raise InstructionFileError(
            f"{path}: cannot be written ({error.strerror or error})"
        ) from None
