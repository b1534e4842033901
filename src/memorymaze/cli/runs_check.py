"""`memorymaze runs check`: whether a run can stand on a leaderboard."""

import argparse
import sys

from memorymaze.cli.verbs import Verbs, add_leaderboard_options, shown_progress
from memorymaze.wording import counted

SHOWN = 20


def add_check(actions: Verbs) -> None:
    """Add the action to `memorymaze runs`."""
    parser = actions.add_parser(
        "check",
        help="check that a run can stand on a leaderboard",
        description="Check a run folder: every episode, default settings, committed "
        "code, and traces that give the same figures when they are scored again. Exit "
        "code 1 where it cannot stand on a leaderboard.",
        epilog="example: memorymaze runs check runs/rules",
    )
    parser.add_argument("folder", metavar="RUN", help="run folder")
    add_leaderboard_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.instructions import load_corpus
    from memorymaze.results.submission import check_submission

    with shown_progress("trace") as show:
        found = check_submission(
            options.folder,
            load_corpus(options.instructions, sites=options.sites),
            progress=show,
        )
    for problem in found.problems[:SHOWN]:
        print(problem)
    if len(found.problems) > SHOWN:
        print(f"… and {len(found.problems) - SHOWN} more")
    for remark in found.remarks:
        print(f"remark: {remark}")
    if found.problems:
        print(
            f"{options.folder}: {counted(len(found.problems), 'problem')}; it cannot "
            "stand on a leaderboard",
            file=sys.stderr,
        )
        return 1
    print(f"{options.folder}: ready, track {found.track}", file=sys.stderr)
    return 0
