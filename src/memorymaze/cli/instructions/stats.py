"""`memorymaze instructions stats`: Table I of instruction files."""

import argparse

from memorymaze.cli.instructions.sites_option import add_sites_option
from memorymaze.cli.verbs import Verbs

__all__ = ["add_parser"]


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "stats",
        help="lengths, failures and alternative ways (Table I)",
        description="Print the paper's Table I for instruction files.",
        epilog="example: memorymaze instructions stats",
    )
    parser.add_argument(
        "files",
        metavar="FILE",
        nargs="*",
        help="JSONL files (default: the shipped texts, written by a language model)",
    )
    add_sites_option(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.instructions.corpus import load_instructions
    from memorymaze.instructions.episodes import episodes
    from memorymaze.instructions.statistics_table import format_statistics
    from memorymaze.sites import load_sites

    sites = load_sites(options.sites)
    read = load_instructions(options.files or None)
    episodes(read, sites)
    print(format_statistics(read, sites), end="")
    return 0
