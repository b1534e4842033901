"""`memorymaze instructions`: Table I of instruction files, and checking them."""

import argparse
import sys

from memorymaze.cli.verbs import Verbs
from memorymaze.cli.wording import counted

__all__ = ["add_parser"]


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "instructions",
        help="describe or check instruction files",
        description="Describe instruction files as the paper's Table I does, or check "
        "them.",
        epilog="example: memorymaze instructions stats",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    stats = actions.add_parser(
        "stats",
        help="lengths, failures and alternative ways (Table I)",
        description="Print the paper's Table I for instruction files.",
        epilog="example: memorymaze instructions stats",
    )
    stats.add_argument(
        "files",
        metavar="FILE",
        nargs="*",
        help="JSONL files (default: the shipped texts, written by a language model)",
    )
    stats.set_defaults(run=_stats)
    check = actions.add_parser(
        "check",
        help="list everything that is wrong in instruction files",
        description="List every bad line; exit code 1 where there is one.",
        epilog="example: memorymaze instructions check mine.jsonl --sites plans",
    )
    check.add_argument("files", metavar="FILE", nargs="+", help="JSONL files")
    check.set_defaults(run=_check)
    for action in (stats, check):
        action.add_argument(
            "--sites",
            metavar="DIR",
            help="folder of site plans (default: the three shipped ones)",
        )


def _stats(options: argparse.Namespace) -> int:
    from memorymaze.instructions.corpus import load_instructions
    from memorymaze.instructions.episodes import episodes
    from memorymaze.instructions.statistics_table import format_statistics
    from memorymaze.sites import load_sites

    sites = load_sites(options.sites)
    read = load_instructions(options.files or None)
    episodes(read, sites)
    print(format_statistics(read, sites), end="")
    return 0


def _check(options: argparse.Namespace) -> int:
    from memorymaze.instructions.checking import check_instruction_files
    from memorymaze.sites import load_sites

    count, problems = check_instruction_files(options.files, load_sites(options.sites))
    for problem in problems:
        print(problem)
    verdict = counted(len(problems), "problem") if problems else "no problems"
    print(f"{counted(count, 'good instruction')}, {verdict}", file=sys.stderr)
    return 1 if problems else 0
