"""`memorymaze table`: the paper's Tables II and III from runs."""

import argparse

from memorymaze.cli.verbs import Verbs

__all__ = ["add_parser"]


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "table",
        help="show runs as the paper's tables II and III",
        description="Show runs as the paper's Table II (methods) and Table III "
        "(iterations), beside the published figures.",
        epilog="example: memorymaze table runs/rules runs/oracle --table both",
    )
    parser.add_argument("runs", metavar="RUN", nargs="+", help="run folders")
    parser.add_argument(
        "--table",
        choices=["II", "III", "both"],
        default="II",
        help="which table (default: II)",
    )
    parser.add_argument(
        "--format",
        choices=["text", "md", "csv"],
        default="text",
        help="aligned text, Markdown, or CSV (default: text)",
    )
    parser.add_argument(
        "--exclude-dev",
        action="store_true",
        help="leave out the instructions that prompts may be built from (split dev)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.evaluation.table_formats import format_tables
    from memorymaze.evaluation.tables import load_runs

    runs = load_runs(options.runs, exclude_dev=options.exclude_dev)
    names = ("II", "III") if options.table == "both" else (options.table,)
    print(format_tables(runs, names, options.format), end="")
    return 0
