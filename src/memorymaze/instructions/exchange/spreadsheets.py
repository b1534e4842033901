"""Instructions as a table, CSV or Parquet: one row each, a column per field.

Needs pandas, and pyarrow for Parquet: the extra `tables`.
"""

import io
import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from memorymaze.errors import InstructionFileError
from memorymaze.extras import require_extra
from memorymaze.instructions.exchange.foreign_files import parsed
from memorymaze.instructions.files import (
    FIELDS,
    OPTIONAL,
    instruction_record,
    write_file,
)
from memorymaze.instructions.records import Instruction

if TYPE_CHECKING:
    import pandas

Kind = Literal["csv", "parquet"]

STRUCTURED = ("failures", "followers", "spans")
"""Columns that hold JSON."""


def instruction_frame(instructions: Iterable[Instruction]) -> "pandas.DataFrame":
    """Return a data frame with a row per instruction; lists and records are JSON.

    Raises:
        SettingsError: pandas is not installed.
    """
    pandas = _pandas()
    rows: list[dict[str, Any]] = []
    for each in instructions:
        record = instruction_record(each)
        for name in STRUCTURED:
            if name in record:
                record[name] = json.dumps(record[name], ensure_ascii=False)
        rows.append(record)
    return pandas.DataFrame(rows, columns=list(FIELDS))


def write_spreadsheet(
    path: str | Path, instructions: Iterable[Instruction], kind: Kind
) -> None:
    """Write a CSV file (UTF-8) or a Parquet file.

    Raises:
        InstructionFileError: The file cannot be written.
        SettingsError: A package is missing.
    """
    frame = instruction_frame(instructions)
    content = io.BytesIO()
    if kind == "csv":
        frame.to_csv(content, index=False, lineterminator="\n", encoding="utf-8")
    else:
        require_extra("tables", "pyarrow", purpose="Parquet")
        frame.to_parquet(content, index=False, engine="pyarrow")
    write_file(path, content.getvalue())


def read_spreadsheet(path: str | Path, kind: Kind) -> list[Instruction]:
    """Read what `write_spreadsheet` writes; columns may be in any order.

    Raises:
        InstructionFileError: The file cannot be read, or a row is wrong; names the row.
        SettingsError: A package is missing.
    """
    pandas = _pandas()
    if kind == "parquet":
        require_extra("tables", "pyarrow", purpose="Parquet")
    try:
        if kind == "csv":
            frame = pandas.read_csv(path, dtype=str, keep_default_na=False)
        else:
            frame = pandas.read_parquet(path, engine="pyarrow")
    except (OSError, ValueError) as error:
        raise InstructionFileError(f"{path}: cannot be read ({error})") from None
    records: list[dict[str, Any]] = frame.to_dict(orient="records")
    # The first row of a CSV file is on line 2, below the names of the columns.
    return [
        parsed(_record(row, f"{path}: row {number}"), f"{path}: row {number}")
        for number, row in enumerate(records, start=2)
    ]


def _record(row: dict[str, Any], place: str) -> dict[str, Any]:
    record = {name: value for name, value in row.items() if _has_value(name, value)}
    try:
        for name in STRUCTURED:
            if name in record:
                record[name] = json.loads(record[name])
        record["iteration"] = int(record.get("iteration", ""))
    except (TypeError, ValueError):
        raise InstructionFileError(
            f"{place}: expected `iteration` 1 or 2, and JSON in `failures` (such as []) "
            f"`followers` and `spans`, got {row.get('iteration')!r}, "
            f"{row.get('failures')!r}, {row.get('followers')!r} and {row.get('spans')!r}"
        ) from None
    return record


def _has_value(name: str, value: object) -> bool:
    missing = value is None or value != value  # NaN stands for nothing in a frame
    return not missing and not (name in OPTIONAL and value == "")


def _pandas() -> Any:
    require_extra("tables", "pandas", purpose="CSV and Parquet")
    import pandas

    return pandas
