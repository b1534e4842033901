"""`memorymaze benchmark`: the guide on all shipped instructions, and Table II."""

import argparse

from memorymaze import __version__
from memorymaze.front.cli import evaluate, table
from memorymaze.front.cli.verbs import VerbParser, Verbs, given_path


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "benchmark",
        help="follow all shipped instructions offline, and print Table II",
        description="Follow the 564 shipped instructions with the agent guide, which "
        "needs no model, and print the paper's Table II. The same as `evaluate --agent "
        "guide --resume` and `table`. Broken off, it goes on when it is called again.",
        epilog="example: memorymaze benchmark --limit 60",
    )
    parser.add_argument(
        "--limit", metavar="N", help="at most this many, alike many of each route"
    )
    parser.add_argument(
        "--workers",
        metavar="N",
        default="0",
        help="processes (default: 0, one per core)",
    )
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=given_path,
        help="run folder (default: runs/guide-VERSION; of a limit, -LIMIT after that)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    limited = [] if options.limit is None else ["--limit", options.limit]
    out = str(options.out or "-".join([f"runs/guide-{__version__}", *limited[1:]]))
    run = ["--agent", "guide", *limited, "--workers", options.workers, "--out", out]
    commands = argparse.ArgumentParser(prog="memorymaze")
    verbs = commands.add_subparsers(parser_class=VerbParser)
    evaluate.add_parser(verbs)
    table.add_parser(verbs)
    for command in (["evaluate", *run, "--resume"], ["table", out]):
        chosen = commands.parse_args(command, argparse.Namespace(debug=options.debug))
        chosen.run(chosen)
