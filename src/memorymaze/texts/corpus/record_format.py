"""The record of an instruction in a file: reading, refusing and writing one."""

import re
import warnings
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import InstructionFileError, InstructionFileWarning
from memorymaze.basics.input_files import mistakes, parse_record, unknown_fields
from memorymaze.texts.corpus.records import Instruction

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
