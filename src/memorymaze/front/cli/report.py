"""`memorymaze report`: runs as a folder of pages that open in any browser."""

import argparse
import sys

from memorymaze.front.cli.verbs import (
    Verbs,
    add_exclude_dev,
    add_new_folder,
    given_path,
    shown_progress,
)


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "report",
        help="make pages that show runs: tables, walks on plans, every episode",
        description="Make a folder of HTML pages that show one run or several side by "
        "side: tables with intervals and tests, walks on the plans, where they leave "
        "the way, distributions, errors in instructions, and every episode with a "
        "replay. They open from the disk, without server or network.",
        epilog="example: memorymaze report runs/guide runs/mine --out report",
    )
    parser.add_argument(
        "runs", metavar="RUN", type=given_path, nargs="+", help="run folders"
    )
    add_new_folder(parser, "report")
    add_exclude_dev(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_new_folder
    from memorymaze.runs.report import REPORT_MARK, read_sources, write_report

    # Before the work rather than after it.
    check_new_folder(options.out, replaces=REPORT_MARK if options.overwrite else None)
    sources = read_sources(options.runs, exclude_dev=options.exclude_dev)
    with shown_progress("episode") as show:
        notes = write_report(
            sources, options.out, overwrite=options.overwrite, progress=show
        )
    for note in notes:
        print(f"memorymaze: note: {note}", file=sys.stderr)
    print(f"{options.out}/index.html")
