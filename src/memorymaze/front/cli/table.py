"""`memorymaze table`: the paper's Tables II and III from runs."""

import argparse

from memorymaze.front.cli.verbs import Verbs, add_exclude_dev, given_path


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    verbs.add_parser(
        "table",
        help="show runs as the paper's tables II and III",
        description="Show runs as the paper's Table II (methods) and Table III "
        "(iterations), beside the published figures; runs on SAIL by map, beside people who "
        "followed the same texts.",
        epilog="example: memorymaze table runs/guide runs/oracle --table both",
        options=_add_options,
    )


def _add_options(parser: argparse.ArgumentParser) -> None:
    from memorymaze.runs.tables import TABLES

    shown = [f"{name}: {question.shows}" for name, question in TABLES.items()]
    parser.add_argument(
        "runs", metavar="RUN", type=given_path, nargs="+", help="run folders"
    )
    parser.add_argument(
        "--table",
        choices=[*TABLES, "both"],
        default="II",
        help=f"which table (default: II): {'; '.join(shown)}; both: II and III",
    )
    parser.add_argument(
        "--format",
        choices=["text", "md", "latex", "csv", "parquet"],
        default="text",
        help="aligned text, Markdown, LaTeX, CSV, or Parquet, which needs the extra [tables] "
        "(default: text)",
    )
    parser.add_argument(
        "--out",
        metavar="FILE",
        type=given_path,
        help="write to a file (Parquet: needed)",
    )
    add_exclude_dev(parser)
    parser.add_argument(
        "--absent",
        metavar="METHOD=HOW",
        action="append",
        default=[],
        help="a row for a method that has no run, and how to get one; may be given "
        "several times",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_no_input, write_whole
    from memorymaze.basics.errors import SettingsError
    from memorymaze.basics.tables import write_tables
    from memorymaze.front.cli.agent_options import given_options
    from memorymaze.runs.tables import load_runs, run_tables

    if options.format == "parquet" and options.out is None:
        raise SettingsError("--format parquet: name the file to write with --out")
    if options.out is not None:
        check_no_input(options.out, [f for run in options.runs for f in run.glob("*")])
    absent = dict(given_options(options.absent, "--absent"))
    runs = load_runs(options.runs, exclude_dev=options.exclude_dev)
    content = write_tables(run_tables(runs, options.table, absent), options.format)
    if options.out is None:
        print(content.decode(), end="")
    else:
        write_whole(options.out, content)
        print(options.out)
