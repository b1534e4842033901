"""`memorymaze report`: runs as a folder of pages that open in any browser."""

import argparse
import sys

from memorymaze.cli.verbs import Verbs


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "report",
        help="make pages that show runs: tables, walks on plans, every episode",
        description="Make a folder of HTML pages that show one run or several side by "
        "side: tables with intervals and tests, walks on the plans, where they leave "
        "the way, distributions, errors in instructions, and every episode with a "
        "replay. They open from the disk, without server or network.",
        epilog="example: memorymaze report runs/rules runs/mine --out report",
    )
    parser.add_argument("runs", metavar="RUN", nargs="+", help="run folders")
    parser.add_argument(
        "--out", metavar="DIR", required=True, help="folder to make; not there yet"
    )
    parser.add_argument(
        "--overwrite",
        action="store_true",
        help="replace the report that is there, once the new one is whole",
    )
    parser.add_argument(
        "--exclude-dev",
        action="store_true",
        help="leave out the instructions that prompts may be built from (split dev)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from tqdm import tqdm

    from memorymaze.results.report import check_out, read_sources, write_report

    check_out(options.out, overwrite=options.overwrite)
    sources = read_sources(options.runs, exclude_dev=options.exclude_dev)
    with tqdm(unit="episode", disable=not sys.stderr.isatty()) as bar:

        def show(done: int, total: int) -> None:
            bar.total = total
            bar.update(done - bar.n)

        notes = write_report(
            sources, options.out, overwrite=options.overwrite, progress=show
        )
    for note in notes:
        print(f"memorymaze: note: {note}", file=sys.stderr)
    print(f"{options.out}/index.html")
    return 0
