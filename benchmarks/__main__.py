"""Run benchmarks and print their table."""

import argparse
import sys
from importlib import import_module

from benchmarks import BENCHMARKS
from benchmarks.measuring import Row

TITLES = ("benchmark", "ours", "baseline", "ratio", "target", "measured against")


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks",
        description="Measure the project and named baselines on this machine.",
        epilog="example: python -m benchmarks --only metrics",
    )
    parser.add_argument(
        "--only",
        metavar="NAME",
        action="append",
        choices=sorted(BENCHMARKS),
        help=f"run only this one, may be repeated ({', '.join(sorted(BENCHMARKS))})",
    )
    chosen = parser.parse_args().only or list(BENCHMARKS)
    rows: list[Row] = []
    for name in dict.fromkeys(chosen):
        print(f"running {name} ...", file=sys.stderr)
        rows += import_module(BENCHMARKS[name]).run()
    print_table(rows)
    return 0


def print_table(rows: list[Row]) -> None:
    lines = [TITLES, *(shown(row) for row in rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(TITLES))]
    for line in lines:
        cells = [line[0].ljust(widths[0])]
        cells += [
            cell.rjust(width)
            for cell, width in zip(line[1:5], widths[1:5], strict=True)
        ]
        print("  ".join([*cells, line[5]]).rstrip())


def shown(row: Row) -> tuple[str, ...]:
    """Return the cells of a row as text."""
    sign = ">=" if row.higher_is_better else "<="
    target = "" if row.target is None else f"{sign} {figure(row.target)} {row.unit}"
    return (
        row.name,
        f"{figure(row.ours)} {row.unit}",
        "" if row.baseline is None else f"{figure(row.baseline)} {row.unit}",
        "" if row.ratio is None else f"{figure(row.ratio)} x",
        target if row.meets_target else f"{target} MISSED",
        row.baseline_name,
    )


def figure(number: float) -> str:
    """Return a number with three figures, and no more than it has."""
    return f"{number:.0f}" if abs(number) >= 100 else f"{number:.3g}"


if __name__ == "__main__":
    sys.exit(main())
