"""`memorymaze compare`: two runs on the same instructions."""

import argparse

from memorymaze.front.cli.verbs import Verbs, add_exclude_dev, given_path


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "compare",
        help="compare runs on the same instructions, with a paired test",
        description="Compare two runs on the episodes that both have, route by route: "
        "differences with paired bootstrap intervals and a test. Of more runs, the "
        "success of each beside that of the first.",
        epilog="example: memorymaze compare runs/guide runs/mine",
    )
    parser.add_argument(
        "first", metavar="A", type=given_path, help="run folder: the baseline"
    )
    parser.add_argument(
        "others",
        metavar="B",
        type=given_path,
        nargs="+",
        help="run folders: what is compared with it",
    )
    parser.add_argument(
        "--format",
        choices=["text", "md", "latex", "csv"],
        default="text",
        help="aligned text, Markdown, LaTeX or CSV (default: text)",
    )
    parser.add_argument(
        "--equal-metres",
        action="store_true",
        help="on texts with errors, by kind of error: success within 1, 1.5, 2 and 3 times "
        "the way described",
    )
    add_exclude_dev(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.basics.tables import write_tables
    from memorymaze.runs.tables import (
        COMPARISON,
        EQUAL_METRES,
        OVERVIEW,
        load_runs,
        paired_table,
    )

    folders = [options.first, *options.others]
    runs = load_runs(folders, exclude_dev=options.exclude_dev)
    if options.equal_metres:
        tables = [paired_table([runs[0], other], EQUAL_METRES) for other in runs[1:]]
    else:
        tables = [paired_table(runs, COMPARISON if len(runs) == 2 else OVERVIEW)]
    print(write_tables(tables, options.format).decode(), end="")
