"""Tables II and III in every format."""

from collections.abc import Sequence
from typing import Literal

from memorymaze.results.tables.latex import latex_table
from memorymaze.results.tables.markdown import markdown_table
from memorymaze.results.tables.records import csv_tables
from memorymaze.results.tables.rows import MeasuredRun, TableName, table_rows
from memorymaze.results.tables.text import text_table

TableFormat = Literal["text", "md", "latex", "csv"]


def format_tables(
    runs: Sequence[MeasuredRun], tables: Sequence[TableName], style: TableFormat
) -> str:
    """Write tables, with all that one must know to read them.

    Args:
        runs: From `load_runs`; at least one.
        tables: Which of the paper's tables.
        style: Text of at most 118 columns, Markdown, LaTeX, or one CSV with unrounded
            numbers. Parquet is not text: `records.parquet_tables`.
    """
    if style == "csv":
        return csv_tables(runs, tables)
    write = {"text": text_table, "md": markdown_table, "latex": latex_table}[style]
    return "\n".join(write(table_rows(runs, table), runs, table) for table in tables)
