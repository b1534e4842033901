"""Tables: rows of values, written as text, Markdown, LaTeX, HTML, CSV or a frame.

A table keeps values, not texts: people read them rounded and under headings; CSV,
Parquet and frames have them as they are, and have fields that nobody is shown.
"""

import csv
import io
import re
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape
from itertools import groupby
from typing import TYPE_CHECKING, Any, Literal

from memorymaze.basics.extras import require_extra, require_parquet

if TYPE_CHECKING:
    import pandas

Row = Mapping[str, Any]
"""Values by field. None is shown as `-`; of what is not there nothing is shown."""
TableFormat = Literal["text", "md", "latex", "csv", "parquet"]

TEXT_WIDTH = 118
"""Characters; columns that do not fit stand below the others."""
_ADDITION = re.compile(r" (?=[\[(])")
"""Before what stands behind a number: its interval, or what it is compared with."""
_NUMBER = re.compile(r"-|(< )?[-+]?\d[\d.,]*( ?%)?|\d{4}-\d\d-\d\d")
_LATEX = str.maketrans({
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    **{character: f"\\{character}" for character in "{}&%$#_"},
})


@dataclass(frozen=True, slots=True)
class Column:
    """What a table tells of each of its rows."""

    name: str
    """The field in rows, CSV and frames."""
    heading: str | None = None
    """What people read above it; None where only CSV and frames have it."""
    role: Literal["group", "label", "value"] = "value"
    """A label says what a row is about. A group stands above the rows that share it:
    the first one parts a table into blocks, further ones follow each other on a line."""
    digits: int | None = None
    """Decimals of a number as it is shown; None leaves it as it is."""
    signed: bool = False
    """Whether a plus is written too."""
    interval: tuple[str, str] | None = None
    """Fields of the ends between which the true value probably lies. Where they are None
    or equal, nothing can be told of that; the cell says so: `too few`, `no spread`. So it
    does where they differ by less than is shown: `within 0.01`."""
    better: Literal["higher", "lower"] | None = None
    """Which of two values is the better one; LaTeX sets the best in bold."""
    show: Callable[[Row], str] | None = None
    """Writes the cell where the field's value alone does not make it."""
    link: Callable[[Row], str | None] | None = None
    """Where the cell leads to on a page; None for nowhere."""
    plot: bool = False
    """Whether pages draw value and interval beside it, on a line from 0 to 1."""
    is_data: bool = True
    """Whether CSV and frames have it."""

    @property
    def fields(self) -> tuple[str, ...]:
        """What CSV and frames have of it."""
        return (self.name, *(self.interval or ())) if self.is_data else ()

    def cell(self, row: Row) -> str:
        """Return what is shown of a row."""
        if self.show is not None:
            return self.show(row)
        if self.name not in row:
            return ""
        shown = self._written(row[self.name])
        ends = [row[end] for end in self.interval or () if end in row]
        if not ends or row[self.name] is None:
            return shown
        if None in ends:
            return f"{shown} (too few)"
        if ends[0] == ends[1]:
            return f"{shown} (no spread)"
        low, high = map(self._written, ends)
        if low == high:
            return f"{shown} (within {10 ** -(self.digits or 0):g})"
        return f"{shown} [{low}, {high}]"

    def _written(self, value: Any) -> str:
        if value is None:
            return "-"
        if isinstance(value, bool):
            return "yes" if value else "no"
        if isinstance(value, str) or self.digits is None:
            return str(value)
        return f"{value:{'+' if self.signed else ''}.{self.digits}f}"


@dataclass(frozen=True, slots=True)
class Table:
    """Rows and what there is to tell of them.

    `str(table)` is its text; notebooks and page templates show it as HTML.
    """

    title: str
    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    notes: tuple[str, ...] = ()
    """What one must know to read it; further lines of a note stand indented."""
    name: str = ""
    """Short, for references: `table-ii`."""
    aside: Callable[[Row], bool] | None = None
    """Which rows are there to compare with: set apart on pages, never the best."""

    @property
    def fields(self) -> tuple[str, ...]:
        """The fields of CSV and frames, in order."""
        return tuple(field for column in self.columns for field in column.fields)

    def records(self) -> list[dict[str, Any]]:
        """Return all fields of the rows, unrounded; None for what is not there."""
        return [{field: row.get(field) for field in self.fields} for row in self.rows]

    def frame(self) -> "pandas.DataFrame":
        """Return the fields as a data frame; needs the extra `tables`."""
        require_extra("tables", "pandas", purpose="data frames")
        import pandas

        return pandas.DataFrame(self.records(), columns=list(self.fields))

    def csv(self) -> str:
        """Write the fields as CSV."""
        out = io.StringIO()
        writer = csv.DictWriter(out, self.fields, lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.records())
        return out.getvalue()

    def parquet(self) -> bytes:
        """Write the fields as a Parquet file; needs the extra `tables`."""
        require_parquet()
        import pyarrow
        import pyarrow.parquet

        out = io.BytesIO()
        pyarrow.parquet.write_table(pyarrow.Table.from_pylist(self.records()), out)
        return out.getvalue()

    def text(self, width: int = TEXT_WIDTH) -> str:
        """Write it in columns; those that do not fit stand below the others."""
        lines = [self.title, *([""] if self.notes else [])]
        for note in self.notes:
            for number, line in enumerate(note.split("\n")):
                first = "  " if number else ""
                lines += textwrap.wrap(
                    line, width, initial_indent=first, subsequent_indent="  "
                )
        sheet = _Sheet(self)
        indent = "  " if sheet.groups else ""
        for columns in sheet.beside_each_other(width - len(indent)):
            heading = indent + "  ".join(each.text_heading() for each in columns)
            for title, groups in sheet.blocks():
                head = ["", *([title] if title else []), heading, "-" * len(heading)]
                for group, rows in groups:
                    kept = [n for n in rows if any(c.tells_of(n) for c in columns)]
                    if kept:
                        lines += [*head, *([group] if group else [])]
                        head = []
                    for number in kept:
                        cells = (each.text(number) for each in columns)
                        lines.append(indent + "  ".join(cells))
        return "\n".join(line.rstrip() for line in lines) + "\n"

    __str__ = text

    def markdown(self) -> str:
        """Write it as Markdown."""
        sheet = _Sheet(self)
        columns = [*sheet.groups, *sheet.columns]
        lines = [f"### {_markdown(self.title)}", ""]
        lines += [_markdown(f"- {note}").replace("\n", "\n  ") for note in self.notes]
        for title, groups in sheet.blocks():
            lines += ["", *([f"**{_markdown(title)}**", ""] if title else [])]
            lines.append(_markdown_row([each.heading for each in columns]))
            marks = ("---:" if each.is_numeric else "---" for each in columns)
            lines.append("|" + "|".join(marks) + "|")
            lines += [
                _markdown_row([each.cells[number] for each in columns])
                for _, rows in groups
                for number in rows
            ]
        return "\n".join(lines) + "\n"

    def latex(self) -> str:
        """Write it as a `table*`, for the package booktabs; the notes are its caption.

        The best value of a group is bold, where there is a choice.
        """
        sheet = _Sheet(self)
        arrows = {"higher": r" $\uparrow$", "lower": r" $\downarrow$", None: ""}
        heads = [_latex(e.heading) + arrows[e.column.better] for e in sheet.columns]
        marks = ["r" if each.is_numeric else "l" for each in sheet.columns]
        across = rf"\multicolumn{{{len(heads)}}}{{l}}"
        lines = [
            r"\begin{table*}",
            r"\centering",
            rf"\begin{{tabular}}{{{''.join(marks)}}}",
            r"\toprule",
            " & ".join(heads) + r" \\",
        ]
        for title, groups in sheet.blocks():
            lines.append(r"\midrule")
            lines += [rf"{across}{{\textit{{{_latex(title)}}}}} \\"] if title else []
            for group, rows in groups:
                if group:
                    lines += [r"\addlinespace", rf"{across}{{{_latex(group)}}} \\"]
                for number in rows:
                    cells = [each.latex(number, rows) for each in sheet.columns]
                    indent = r"\quad " if group else ""
                    lines.append(indent + " & ".join(cells) + r" \\")
        caption = " ".join([f"{self.title}.", *self.notes]).replace("\n", " ")
        return "\n".join([
            *lines,
            r"\bottomrule",
            r"\end{tabular}",
            rf"\caption{{{_latex(caption)}}}",
            *([rf"\label{{tab:memorymaze-{self.name}}}"] if self.name else []),
            r"\end{table*}",
            "",
        ])

    def html(self, kind: str = "results") -> str:
        """Write it as HTML, without its notes: one table per block, of a class."""
        sheet = _Sheet(self)
        heads = "".join(each.html_heading() for each in sheet.columns)
        lines: list[str] = []
        for title, groups in sheet.blocks():
            caption = escape(": ".join(part for part in (self.title, title) if part))
            lines += [
                f'<div class="scroll" role="region" aria-label="{caption}" tabindex="0">',
                f'<table class="{kind}">',
                f"<caption>{caption}</caption>",
                f"<thead><tr>{heads}</tr></thead>",
            ]
            for group, rows in groups:
                lines.append("<tbody>")
                if group:
                    title_cell = sheet.groups[0].linked(rows[0], escape(group))
                    lines.append(
                        f'<tr class="group"><th scope="rowgroup" colspan="'
                        f'{heads.count("</t")}">{title_cell}</th></tr>'
                    )
                for number in rows:
                    cells = "".join(each.html(number) for each in sheet.columns)
                    opening = "<tr>"
                    if sheet.is_aside(number):
                        opening = '<tr class="published">'
                        # Pages sort the first body of a table alone.
                        lines += [] if group else ["</tbody>", "<tbody>"]
                    lines.append(f"{opening}{cells}</tr>")
                lines.append("</tbody>")
            lines += ["</table>", "</div>"]
        return "\n".join(lines) + "\n"

    __html__ = _repr_html_ = html


def write_tables(tables: Sequence[Table], style: TableFormat) -> bytes:
    """Write tables as the content of a file.

    Args:
        tables: At least one; for CSV and Parquet all with the same fields.
        style: CSV and Parquet hold the rows of all tables one after the other.

    Raises:
        SettingsError: `parquet` without the extra `tables`.
    """
    if style in {"csv", "parquet"}:
        rows = tuple(row for table in tables for row in table.rows)
        together = replace(tables[0], rows=rows)
        return together.csv().encode() if style == "csv" else together.parquet()
    write = {"text": Table.text, "md": Table.markdown, "latex": Table.latex}[style]
    return "\n".join(write(table) for table in tables).encode()


class _Sheet:
    """The cells of a table as people see them."""

    def __init__(self, table: Table) -> None:
        shown = [
            _Cells(each, table) for each in table.columns if each.heading is not None
        ]
        groups = [each for each in shown if each.column.role == "group"]
        self._table = table
        self._block = groups[0] if groups else None
        self.groups = groups[1:]
        """Those that do not part the table into blocks."""
        self.columns = [each for each in shown if each.column.role != "group"]

    def is_aside(self, number: int) -> bool:
        aside = self._table.aside
        return aside is not None and aside(self._table.rows[number])

    def blocks(self) -> Iterator[tuple[str, list[tuple[str, list[int]]]]]:
        """Yield titles of blocks, and in each the groups with the numbers of rows."""
        numbers = range(len(self._table.rows))
        block = self._block
        for title, rows in groupby(numbers, lambda n: block.cells[n] if block else ""):
            yield title, [(name, [*kept]) for name, kept in groupby(rows, self._group)]

    def _group(self, number: int) -> str:
        """Return the title of a row's group: `University R1  (n 2, arrived 1)`."""
        if not self.groups:
            return ""
        first, *others = self.groups
        told = ", ".join(f"{each.heading} {each.cells[number]}" for each in others)
        return first.cells[number] + (f"  ({told})" if told else "")

    def beside_each_other(self, width: int) -> Iterator[list["_Cells"]]:
        """Yield columns that fit side by side, each time behind the labels."""
        labels = [each for each in self.columns if each.column.role == "label"]
        waiting = [each for each in self.columns if each.column.role == "value"]
        while waiting:
            free = width - sum(each.width + 2 for each in labels) - waiting[0].width
            fitting = 1
            while fitting < len(waiting):
                free -= waiting[fitting].width + 2
                if free < 0:
                    break
                fitting += 1
            yield [*labels, *waiting[:fitting]]
            waiting = waiting[fitting:]


class _Cells:
    """A column as people see it: numbers aligned by their ends, words at the left."""

    def __init__(self, column: Column, table: Table) -> None:
        self.column = column
        self.heading = str(column.heading)
        self.cells = [column.cell(row) for row in table.rows]
        self._table = table
        parts = [_ADDITION.split(cell, 1) for cell in self.cells]
        numbers = [number for number, *_ in parts if number]
        is_value = column.role == "value"
        self.is_numeric = is_value and all(map(_NUMBER.fullmatch, numbers))
        self._parts = parts if self.is_numeric else [[cell] for cell in self.cells]
        self._number = max(map(len, numbers), default=0) if self.is_numeric else 0
        is_bare = all(len(parts) == 1 for parts in self._parts)
        self._mark = ">" if self.is_numeric and is_bare else "<"
        aligned = [self._aligned(number) for number in range(len(self.cells))]
        self.width = max(map(len, [self.heading, *aligned]))

    def tells_of(self, number: int) -> bool:
        return self.column.role == "value" and self.cells[number] != ""

    def text_heading(self) -> str:
        return f"{self.heading:{self._mark}{self.width}}"

    def text(self, number: int) -> str:
        return f"{self._aligned(number):{self._mark}{self.width}}"

    def _aligned(self, number: int) -> str:
        first, *addition = self._parts[number]
        return " ".join([first.rjust(self._number), *addition])

    def latex(self, number: int, group: Sequence[int]) -> str:
        first, *addition = map(_latex, self._parts[number])
        if self._is_best(number, group):
            first = rf"\textbf{{{first}}}"
        return " ".join([first, *(rf"{{\scriptsize {each}}}" for each in addition)])

    def _is_best(self, number: int, group: Sequence[int]) -> bool:
        """Tell whether no row of a group that may be best has a better value."""
        aside, rows = self._table.aside, self._table.rows
        choice = [n for n in group if aside is None or not aside(rows[n])]
        if self.column.better is None or number not in choice or len(choice) < 2:
            return False
        best = min if self.column.better == "lower" else max
        name = self.column.name
        values = [rows[n][name] for n in choice if rows[n][name] is not None]
        return bool(values) and rows[number][name] == best(values)

    def html_heading(self) -> str:
        plot = '<td class="plot"></td>' if self.column.plot else ""
        return f'<th scope="col"{self._class()}>{escape(self.heading)}</th>{plot}'

    def html(self, number: int) -> str:
        row = self._table.rows[number]
        shown, *addition = map(escape, self._parts[number])
        shown += "".join(f' <span class="interval">{each}</span>' for each in addition)
        shown = self.linked(number, shown)
        if self.column.role == "label":
            return f'<th scope="row">{shown}</th>'
        value = row.get(self.column.name)
        # Columns are sorted by their values, not by what is shown of them.
        data = f' data-value="{value}"' if isinstance(value, float) else ""
        return f"<td{self._class()}{data}>{shown}</td>{self._plot(row)}"

    def linked(self, number: int, shown: str) -> str:
        """Return what is shown of a row as a link, where it leads somewhere."""
        link = self.column.link
        target = link(self._table.rows[number]) if link else None
        return f'<a href="{escape(target)}">{shown}</a>' if target else shown

    def _plot(self, row: Row) -> str:
        if not self.column.plot:
            return ""
        value = row.get(self.column.name)
        if value is None:
            return '<td class="plot"></td>'
        low, high = (row.get(end) for end in self.column.interval or ("", ""))
        spread = ""
        if low is not None and high is not None:
            spread = f'<path class="range" d="M{100 * low:.5g} 7H{100 * high:.5g}"/>'
        return (
            '<td class="plot"><svg class="dots" viewBox="0 0 100 14" aria-hidden="true" '
            'focusable="false"><path class="axis" d="M0 7H100M0 3V11M50 5V9M100 3V11"/>'
            f'{spread}<circle cx="{100 * value:.5g}" cy="7" r="2.6"/></svg></td>'
        )

    def _class(self) -> str:
        return ' class="num"' if self.is_numeric else ""


def _markdown(text: str) -> str:
    return text.replace("|", "\\|")


def _markdown_row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(_markdown(cell) for cell in cells) + " |"


def _latex(text: str) -> str:
    return text.translate(_LATEX)
