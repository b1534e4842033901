"""Labelling in a spreadsheet: a CSV file to fill in, and reading it back."""

import csv
import io
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from memorymaze.basics.errors import LabelFileError
from memorymaze.basics.input_files import read_text, refusal
from memorymaze.texts.corpus.record_format import write_file
from memorymaze.texts.corpus.records import WRITTEN_BY, Failure
from memorymaze.texts.labels.labels import Label
from memorymaze.texts.labels.questions import (
    LabelQuestion,
    read_kind,
    read_way,
    read_yes_or_no,
    way_in_words,
)

GIVEN = (
    "instruction",
    "site",
    "route",
    "study",
    "iteration",
    "written_by",
    "text",
    "ways",
)
FAILURES = 3
"""Failures that a sheet has columns for; more may be added as `kind_4`, …"""
ASKED = (
    "way",
    "arrives",
    *(
        f"{name}_{number}"
        for number in range(1, FAILURES + 1)
        for name in ("kind", "where", "detail")
    ),
)
OF_A_FAILURE = re.compile(r"(kind|where|detail)_([1-9][0-9]*)")
"""Names of such columns."""
FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")
"""What spreadsheets run as a formula; an apostrophe in front keeps it a text."""


def write_label_sheet(path: str | Path, questions: Sequence[LabelQuestion]) -> None:
    """Write a sheet with a row per instruction, whose last columns are to be filled in.

    UTF-8 with a byte order mark, as spreadsheets expect it.
    """
    rows: list[dict[str, str]] = []
    for question in questions:
        told, site = question.instruction, question.site
        ways = site.ways(told.route)
        rows.append({
            "instruction": told.id,
            "site": told.site,
            "route": told.route,
            "study": told.study,
            "iteration": str(told.iteration),
            "written_by": WRITTEN_BY[told.source],
            "text": told.text,
            "ways": "\n".join(f"{way.id}: {way_in_words(site, way)}" for way in ways),
        })
    write_file(path, guarded_sheet((*GIVEN, *ASKED), rows))


def read_label_sheet(
    path: str | Path, questions: Sequence[LabelQuestion], annotator: str
) -> list[Label]:
    """Read the rows of a sheet that are filled in.

    Rows where nothing is filled in are left for later.
    """
    known = {question.instruction.id: question for question in questions}
    labels: dict[str, Label] = {}
    wrong: list[str] = []
    for number, row in enumerate(_rows(Path(path)), start=2):
        try:
            label = _label(row, known, annotator)
            if label is not None and label.instruction in labels:
                raise ValueError(
                    f"expected one filled row of a text, got a second one of "
                    f"{label.instruction!r}; empty one of them"
                )
        except ValueError as error:
            wrong.append(f"{path}: row {number}: {error}")
        else:
            labels |= {} if label is None else {label.instruction: label}
    if wrong:
        raise refusal(wrong, LabelFileError)
    return list(labels.values())


def _rows(path: Path) -> list[dict[str, str]]:
    text = read_text(path, LabelFileError)
    head = text.partition("\n")[0]
    separator = ";" if head.count(";") > head.count(",") else ","
    try:
        reader = csv.DictReader(io.StringIO(text, newline=""), delimiter=separator)
        table = list(reader)
    except csv.Error as error:
        raise LabelFileError(f"{path}: expected CSV ({error})") from None
    columns = reader.fieldnames or ()
    missing = {"instruction", "text", "way", "arrives"} - set(columns)
    if missing:
        raise LabelFileError(
            f"{path}: expected the columns of a sheet that `label --csv` wrote, "
            f"{', '.join(sorted(missing))} are missing"
        )
    unknown = [
        repr(name)
        for name in columns
        if name and name not in {*GIVEN, *ASKED} and not OF_A_FAILURE.fullmatch(name)
    ]
    if any("".join(row.get(None, ())) or row.get("") for row in table):
        unknown.append("cells beneath no name")
    if unknown:
        raise LabelFileError(
            f"{path}: expected the columns of a sheet that `label --csv` wrote, and for "
            "more failures kind_4, where_4, detail_4 and so on, got "
            f"{', '.join(unknown)}; name them so, or delete them"
        )
    return [
        {name: _unguarded(cell or "") for name, cell in row.items() if name}
        for row in table
    ]


def _label(
    row: Mapping[str, str], known: Mapping[str, LabelQuestion], annotator: str
) -> Label | None:
    if not any(cell.strip() for name, cell in row.items() if name not in GIVEN):
        return None
    question = known.get(row["instruction"])
    if question is None:
        raise ValueError(f"instruction {row['instruction']!r} is not in the file")
    if row["text"].split() != question.instruction.text.split():
        raise ValueError(
            f"the text of {row['instruction']!r} is not the one in the file"
        )
    if not row["way"].strip():
        raise ValueError(
            "column 'way': expected the way that the text describes, got nothing"
        )
    way = read_way(row["way"], question.ways)
    arrives = read_yes_or_no(row["arrives"])
    failures = _failures(row)
    if arrives and failures:
        raise ValueError(
            "column 'arrives': expected no where a failure is named, got yes"
        )
    if not arrives and not failures:
        raise ValueError("column 'kind_1': expected what is wrong, got nothing")
    return question.label(annotator, way, failures)


def _failures(row: Mapping[str, str]) -> list[Failure]:
    failures: list[Failure] = []
    numbers = sorted({
        int(column[2]) for name in row if (column := OF_A_FAILURE.fullmatch(name))
    })
    for number in numbers:
        kind, where, detail = (
            row.get(f"{name}_{number}", "").strip()
            for name in ("kind", "where", "detail")
        )
        if kind:
            failures.append(Failure(read_kind(kind), where, detail))
        elif where or detail:
            raise ValueError(
                f"column 'kind_{number}': expected what is wrong, got nothing"
            )
    return failures


def guarded_sheet(columns: Sequence[str], rows: Iterable[Mapping[str, Any]]) -> bytes:
    """Return a table for spreadsheets, as CSV; they must run no text as a formula."""
    sheet = io.StringIO()
    writer = csv.DictWriter(sheet, columns, restval="", lineterminator="\r\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({name: _guarded(str(cell)) for name, cell in row.items()})
    return sheet.getvalue().encode("utf-8-sig", "replace")


def _guarded(cell: str) -> str:
    return f"'{cell}" if cell.startswith((*FORMULA_STARTS, "'")) else cell


def _unguarded(cell: str) -> str:
    return cell[1:] if cell.startswith("'") else cell
