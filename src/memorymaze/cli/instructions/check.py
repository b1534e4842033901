"""`memorymaze instructions check`: everything that is wrong in instruction files."""

import argparse
import sys

from memorymaze.cli.instructions.sites_option import add_sites_option
from memorymaze.cli.verbs import Verbs
from memorymaze.cli.wording import counted

__all__ = ["add_parser"]


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "check",
        help="list everything that is wrong in instruction files",
        description="List every bad line; exit code 1 where there is one.",
        epilog="example: memorymaze instructions check mine.jsonl --sites plans",
    )
    parser.add_argument("files", metavar="FILE", nargs="+", help="JSONL files")
    add_sites_option(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.instructions.checking import check_instruction_files
    from memorymaze.sites import load_sites

    count, problems = check_instruction_files(options.files, load_sites(options.sites))
    for problem in problems:
        print(problem)
    verdict = counted(len(problems), "problem") if problems else "no problems"
    print(f"{counted(count, 'good instruction')}, {verdict}", file=sys.stderr)
    return 1 if problems else 0
