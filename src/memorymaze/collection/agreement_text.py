"""Agreement and consensus as plain text."""

from collections.abc import Sequence

from memorymaze.collection.agreement import Agreement
from memorymaze.collection.consensus import Consensus

HEADINGS = ("label", "n", "answers", "agreement", "statistic", "kappa", "95 % interval")


def format_agreement(found: Sequence[Agreement], annotators: Sequence[str]) -> str:
    """Write agreement as a table."""
    rows: list[tuple[str, ...]] = [HEADINGS]
    for each in found:
        kappa = each.kappa.value
        ends = (each.low, each.high)
        rows.append((
            each.question,
            str(each.items),
            str(each.answers),
            f"{100 * each.kappa.agreement:.1f} %",
            each.statistic,
            "-" if kappa is None else f"{kappa:.3f}",
            "-" if None in ends else f"[{ends[0]:.3f}, {ends[1]:.3f}]",
        ))
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEADINGS))]
    lines = [f"{len(annotators)} annotators: {', '.join(annotators)}", ""]
    for number, row in enumerate(rows):
        cells = [f"{cell:<{width}}" for cell, width in zip(row, widths, strict=True)]
        lines.append("  ".join(cells).rstrip())
        if number == 0:
            lines.append("-" * (sum(widths) + 2 * (len(widths) - 1)))
    if any(each.kappa.value is None for each in found):
        lines.append(
            "  -: everyone always gave the same answer, so kappa is not defined"
        )
    return "\n".join(lines) + "\n"


def format_open(agreed: Sequence[Consensus]) -> str:
    """List what has no majority; empty where there is nothing."""
    lines = [
        f"{each.instruction}: no consensus on {'; '.join(each.open)}"
        for each in agreed
        if each.open
    ]
    return "".join(f"{line}\n" for line in lines)
