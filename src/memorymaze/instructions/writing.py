"""Write instruction files (JSONL), as `corpus.py` reads them."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.records import Instruction


def instruction_record(instruction: Instruction) -> dict[str, Any]:
    """Return the JSON record of an instruction, which `parse_line` reads back."""
    record = asdict(instruction)
    del record["origin"]
    for optional in ("original_text", "followers", "pair", "spans", "method"):
        if not record[optional] and record[optional] != "":
            del record[optional]
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
    unfinished = path.with_name(path.name + ".unfinished")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished.write_bytes(content)
        unfinished.replace(path)
    except OSError as error:
        unfinished.unlink(missing_ok=True)
        raise InstructionFileError(
            f"{path}: cannot be written ({error.strerror or error})"
        ) from None
