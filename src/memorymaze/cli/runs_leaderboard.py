"""`memorymaze runs leaderboard`: the page that ranks a folder of runs."""

import argparse
import sys

from memorymaze.cli.verbs import (
    Verbs,
    add_leaderboard_options,
    add_new_folder,
    shown_progress,
)
from memorymaze.wording import counted


def add_leaderboard(actions: Verbs) -> None:
    """Add the action to `memorymaze runs`."""
    parser = actions.add_parser(
        "leaderboard",
        help="make the page that ranks a folder of runs",
        description="Look over every run folder in a folder as `runs check` does, and "
        "make a static page that ranks those that can stand on a leaderboard, tracks "
        "apart, and says why the others cannot.",
        epilog="example: memorymaze runs leaderboard submissions --out leaderboard",
    )
    parser.add_argument("folder", metavar="DIR", help="folder of run folders")
    add_new_folder(parser, "leaderboard")
    add_leaderboard_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.durable_files import check_new_folder
    from memorymaze.instructions import load_corpus
    from memorymaze.results.report.leaderboard import (
        MARK,
        read_leaderboard,
        write_leaderboard,
    )

    # Before the work rather than after it.
    check_new_folder(options.out, replaces=MARK if options.overwrite else None)
    with shown_progress("trace") as show:
        board = read_leaderboard(
            options.folder,
            load_corpus(options.instructions, sites=options.sites),
            progress=lambda name, done, total: show(done, total, name),
        )
    write_leaderboard(board, options.out, overwrite=options.overwrite)
    for each in board.refused:
        more = len(each.reasons) - 1
        print(
            f"{each.name}: refused: {each.reasons[0]}"
            + (f" (and {counted(more, 'problem')} more)" if more else ""),
            file=sys.stderr,
        )
    print(f"{options.out}/index.html")
    return 0
