"""`memorymaze runs`: whether runs can be published, and which is best."""

import argparse
import sys

from memorymaze.basics.wording import counted
from memorymaze.front.cli.verbs import (
    Verbs,
    add_corpus_options,
    add_new_folder,
    given_path,
    shown_progress,
)

SHOWN = 20


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "runs",
        help="check runs for a leaderboard, and rank them",
        description="Check that a run can stand on a leaderboard, or make the page that "
        "ranks a folder of runs.",
        epilog="example: memorymaze runs check runs/guide",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    _add_check(actions)
    _add_leaderboard(actions)


def _add_check(actions: Verbs) -> None:
    parser = actions.add_parser(
        "check",
        help="check that a run can stand on a leaderboard",
        description="Check a run folder: every episode, default settings, committed "
        "code, and traces that give the same figures when they are scored again. Exit "
        "code 1 where it cannot stand on a leaderboard.",
        epilog="example: memorymaze runs check runs/guide",
    )
    parser.add_argument("folder", metavar="RUN", type=given_path, help="run folder")
    _add_texts(parser)
    parser.set_defaults(run=_check)


def _check(options: argparse.Namespace) -> int:
    from memorymaze.runs.submission import check_submission
    from memorymaze.texts.corpus import load_corpus

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


def _add_leaderboard(actions: Verbs) -> None:
    parser = actions.add_parser(
        "leaderboard",
        help="make the page that ranks a folder of runs",
        description="Look over every run folder in a folder as `runs check` does, and "
        "make a static page that ranks those that can stand on a leaderboard, tracks "
        "apart, and says why the others cannot.",
        epilog="example: memorymaze runs leaderboard runs --out leaderboard",
    )
    parser.add_argument(
        "folder", metavar="DIR", type=given_path, help="folder of run folders"
    )
    add_new_folder(parser, "leaderboard")
    _add_texts(parser)
    parser.set_defaults(run=_leaderboard)


def _leaderboard(options: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_new_folder
    from memorymaze.runs.report.leaderboard import (
        MARK,
        read_leaderboard,
        write_leaderboard,
    )
    from memorymaze.texts.corpus import load_corpus

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


def _add_texts(parser: argparse.ArgumentParser) -> None:
    texts = "the leaderboard's instructions (default: the shipped ones)"
    add_corpus_options(parser, texts)
