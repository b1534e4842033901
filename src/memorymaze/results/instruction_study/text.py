"""The statistics as plain text."""

import textwrap

from memorymaze.results.instruction_study.study import InstructionStudy
from memorymaze.results.instruction_study.study_table import StudyTable
from memorymaze.results.instruction_study.tables import study_tables

WIDTH = 100


def format_study(study: InstructionStudy) -> str:
    """Write all tables, saying first who wrote the texts."""
    parts = ["\n".join(study.written)]
    parts += [_format(table) for table in study_tables(study)]
    return "\n\n".join(parts) + "\n"


def _format(table: StudyTable) -> str:
    widths = [
        max(len(row[column]) for row in (table.headings, *table.rows))
        for column in range(len(table.headings))
    ]
    lines = [table.title]
    for number, row in enumerate((table.headings, *table.rows)):
        cells = [
            f"{cell:<{width}}" if column < table.labels else f"{cell:>{width}}"
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(cells).rstrip())
        if number == 0:
            lines.append("-" * (sum(widths) + 2 * (len(widths) - 1)))
    for note in table.notes:
        lines += textwrap.wrap(
            note, WIDTH, initial_indent="  ", subsequent_indent="    "
        )
    return "\n".join(lines)
