"""Instructions as a table, CSV or Parquet: one row each, a column per field."""

import csv
import io
import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Literal

from memorymaze.basics.errors import InstructionFileError
from memorymaze.basics.extras import require_parquet
from memorymaze.basics.input_files import parse_json, read_file, read_text, refusal
from memorymaze.basics.tables import Column, Table, write_tables
from memorymaze.texts.corpus.record_format import (
    FIELDS,
    InstructionProblem,
    instruction_record,
    read_record,
    warn_of_unknown,
    write_file,
)
from memorymaze.texts.corpus.records import Instruction

_Kind = Literal["csv", "parquet"]

TABLE_KINDS: dict[str, _Kind] = {".csv": "csv", ".parquet": "parquet"}
"""What files are by the ends of their names."""

STRUCTURED = ("failures", "followers", "spans")
"""Columns that hold JSON."""


def write_spreadsheet(
    path: str | Path, instructions: Iterable[Instruction], kind: _Kind
) -> None:
    """Write a CSV file (UTF-8) or a Parquet file.

    Raises:
        InstructionFileError: The file cannot be written.
        SettingsError: Parquet without the extra `tables`.
    """
    rows: list[dict[str, Any]] = []
    for each in instructions:
        record = instruction_record(each)
        for name in STRUCTURED:
            if name in record:
                record[name] = json.dumps(record[name], ensure_ascii=False)
        rows.append(record)
    table = Table("", tuple(Column(name) for name in FIELDS), tuple(rows))
    write_file(path, write_tables([table], kind))


def read_spreadsheet(path: str | Path, kind: _Kind) -> list[Instruction]:
    """Read what `write_spreadsheet` writes; columns may be in any order.

    Empty cells, and columns that are not there, have their defaults.

    Raises:
        InstructionFileError: The file cannot be read, or rows are wrong; lists them.
        SettingsError: Parquet without the extra `tables`.
    """
    instructions, problems = read_rows(path, kind)
    if problems:
        raise refusal(problems, InstructionFileError)
    return instructions


def spreadsheet_kind(path: str | Path) -> _Kind | None:
    """Return what a file is by its name; None for JSONL."""
    return TABLE_KINDS.get(Path(path).suffix.lower())


def read_rows(
    path: str | Path, kind: _Kind
) -> tuple[list[Instruction], list[InstructionProblem]]:
    """Read a table; return the good instructions and what is wrong with other rows.

    Raises:
        InstructionFileError: The file cannot be read, or is no table of instructions.
        SettingsError: Parquet without the extra `tables`.
    """
    columns, rows = _from_csv(path) if kind == "csv" else _from_parquet(path)
    for name in columns:
        if name not in FIELDS:
            warn_of_unknown(name, str(path))
    if not rows:
        raise InstructionFileError(
            f"{path}: expected a row per instruction, got the names of columns alone"
        )
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    # The first row of a CSV file is on line 2, below the names of the columns.
    for number, row in enumerate(rows, start=2):
        place = f"{path}: row {number}"
        instruction, wrong = _instruction(row, place)
        problems += [InstructionProblem(place, each) for each in wrong]
        instructions += [] if instruction is None else [instruction]
    return instructions, problems


def _check_columns(path: str | Path, columns: Sequence[str]) -> None:
    missing = [name for name in ("site", "route", "text") if name not in columns]
    if not missing:
        return
    said = f"its columns are {', '.join(map(repr, columns))}"
    if not columns:
        said = "the file is empty"
    elif len(columns) == 1 and ";" in columns[0]:
        said = f"its only column is {columns[0]!r}: separate columns by commas"
    raise InstructionFileError(
        f"{path}: expected columns site, route and text, got none called "
        f"{', '.join(missing)}; {said}"
    )


def _instruction(
    row: dict[str, Any], place: str
) -> tuple[Instruction | None, list[str]]:
    record = {
        name: value
        for name, value in row.items()
        if name in FIELDS and value is not None
    }
    for name in STRUCTURED:
        if isinstance(record.get(name), str):
            try:
                record[name] = parse_json(record[name])
            except ValueError as error:
                return None, [f"column {name!r}: {error}"]
    if isinstance(record.get("iteration"), str) and record["iteration"].isdecimal():
        record["iteration"] = int(record["iteration"])
    instruction, _, wrong = read_record(record, place)
    return instruction, wrong


def _from_csv(path: str | Path) -> tuple[Sequence[str], list[dict[str, Any]]]:
    text = io.StringIO(read_text(path, InstructionFileError), newline="")
    try:
        columns, *lines = list(csv.reader(text, strict=True)) or [[]]
    except csv.Error as error:
        raise InstructionFileError(f"{path}: expected CSV ({error})") from None
    _check_columns(path, columns)
    for name in columns:
        if columns.count(name) > 1:
            raise InstructionFileError(f"{path}: expected column {name!r} once")
    rows: list[dict[str, Any]] = []
    for number, cells in enumerate(lines, start=2):
        if len(cells) > len(columns):
            raise InstructionFileError(
                f"{path}: row {number}: expected at most {len(columns)} cells, got "
                f"{len(cells)}"
            )
        named = zip(columns, cells, strict=False)
        rows += [{name: cell for name, cell in named if cell}] if cells else []
    return columns, rows


def _from_parquet(path: str | Path) -> tuple[Sequence[str], list[dict[str, Any]]]:
    require_parquet()
    # Imported here: it takes longer than all else of a command.
    import pyarrow.parquet

    content = io.BytesIO(read_file(path, InstructionFileError))
    try:
        table = pyarrow.parquet.read_table(content)
        columns, rows = table.column_names, table.to_pylist()
    except (OSError, ValueError) as error:
        raise InstructionFileError(f"{path}: cannot be read ({error})") from None
    _check_columns(path, columns)
    return columns, rows
