"""Lines of cells as aligned text or Markdown; the first line is the heading."""

from collections.abc import Sequence


def text_columns(lines: Sequence[Sequence[str]]) -> str:
    """Align cells below each other, two spaces apart, without a last line end.

    >>> print(text_columns([["kind", "n"], ["missing_turn", "4"]]))
    kind          n
    missing_turn  4
    """
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(c.ljust(w) for c, w in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )


def markdown_columns(lines: Sequence[Sequence[str]]) -> str:
    """Write cells as a Markdown table, without a last line end."""
    head, *rest = ("| " + " | ".join(line) + " |" for line in lines)
    return "\n".join([head, "|" + "---|" * len(lines[0]), *rest])
