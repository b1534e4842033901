"""Read instruction files (JSONL).

Every line is checked; where lines are bad the whole load is refused, with a message
that lists them.
"""

import warnings
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from memorymaze.errors import InstructionFileError, InstructionFileWarning
from memorymaze.instructions.line_format import parse_line
from memorymaze.instructions.problems import (
    InstructionProblem,
    refusal,
    repeated_ids,
)
from memorymaze.instructions.records import Instruction

BUILTIN_CORPUS = Path(str(files("memorymaze.instructions") / "data/role_played.jsonl"))
"""The shipped corpus: 564 texts written by a language model (see its README)."""


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
    chosen = [BUILTIN_CORPUS] if paths is None else [Path(path) for path in paths]
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
        raise refusal(problems)
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
    path = Path(path)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise InstructionFileError(
            f"{path}: cannot be read ({error.strerror or error})"
        ) from None
    except UnicodeDecodeError as error:
        raise InstructionFileError(
            f"{path}: expected UTF-8, got byte {error.object[error.start]:#04x} at "
            f"offset {error.start}; save the file as UTF-8"
        ) from None
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    unknown: dict[str, int] = {}
    for number, line in enumerate(text.split("\n"), start=1):
        if not line.strip():
            continue
        instruction, extra, wrong = parse_line(line, f"{path}:{number}")
        problems += wrong
        if instruction is not None:
            instructions.append(instruction)
        for name in extra:
            unknown.setdefault(name, number)
    if not instructions and not problems:
        raise InstructionFileError(
            f"{path}: expected one JSON record per line, the file is empty"
        )
    for name, number in unknown.items():
        warnings.warn(
            f"{path}:{number}: field {name!r} is not part of the format and not used",
            InstructionFileWarning,
            stacklevel=3,
        )
    return instructions, problems
