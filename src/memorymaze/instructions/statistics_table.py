"""The paper's Table I as text: measured numbers with the published ones beside them."""

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import groupby

from memorymaze.instructions.published import PublishedDescriptions, published_tables
from memorymaze.instructions.records import WRITTEN_BY, Instruction
from memorymaze.instructions.statistics import (
    CellStatistics,
    describe_corpus,
    distinct_words,
)
from memorymaze.sites.records import Site

__all__ = ["format_statistics"]

HEADINGS = ("Route", "iter.", "n", "mean", "median", "SD", "failures", "alternative")

WIDTHS = (18, 5, 4, 15, 15, 13, 17, 17)


def format_statistics(
    instructions: Sequence[Instruction], sites: Mapping[str, Site]
) -> str:
    """Write Table I for instructions whose sites and routes exist.

    Every number is followed by the published one in brackets where the paper has it.

    Raises:
        InstructionFileError: There are no instructions.
    """
    cells = describe_corpus(instructions, sites)
    published = {
        (row.study, row.site, row.route, row.iteration): row
        for row in published_tables().descriptions
    }
    lines = [
        "Table I: instructions, words per text; (published figures in brackets)",
        "",
    ]
    counts = Counter(instruction.source for instruction in instructions)
    lines += [f"{n} written by {WRITTEN_BY[source]}." for source, n in counts.items()]
    for study, of_study in groupby(cells, lambda cell: cell.study):
        lines += ["", f"{study} instructions", _line(HEADINGS)]
        lines.append("-" * len(lines[-1]))
        for cell in of_study:
            key = (cell.study, cell.site, cell.route, cell.iteration)
            lines.append(_line(_numbers(cell, published.get(key))))
    return "\n".join([*lines, "", *_vocabulary(instructions)]) + "\n"


def _numbers(cell: CellStatistics, paper: PublishedDescriptions | None) -> list[str]:
    place = f"{cell.site.replace('_', ' ').title()} {cell.route}"
    values = [place, str(cell.iteration), str(cell.instructions)]
    for name in ("words_mean", "words_median", "words_sd"):
        beside = f" ({getattr(paper, name):.1f})" if paper else ""
        values.append(f"{getattr(cell, name):.1f}{beside}")
    for name in ("failure_rate", "alternative_rate"):
        rate = getattr(paper, name, None)
        beside = "" if rate is None else f" ({100 * rate:.1f} %)"
        values.append(f"{100 * getattr(cell, name):.1f} %{beside}")
    return values


def _line(values: Sequence[str]) -> str:
    first, *others = [f"{v:<{w}}" for v, w in zip(values, WIDTHS, strict=True)]
    return " ".join([first, *others]).rstrip()


def _vocabulary(instructions: Sequence[Instruction]) -> list[str]:
    """Count distinct words per building and study, as far as the paper has them."""
    lines: list[str] = []
    for (building, study), count in published_tables().distinct_words.items():
        texts = [
            instruction.text
            for instruction in instructions
            if instruction.study == study and instruction.site.startswith(building)
        ]
        if texts:
            found = distinct_words(texts)
            lines.append(
                f"distinct words, {building}, {study}: {found} (published {count}, "
                "counting rule unknown)"
            )
    return lines
