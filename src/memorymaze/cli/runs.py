"""`memorymaze runs merge`: one run folder from those of all its shards."""

import argparse
import shlex

from memorymaze.cli.verbs import Verbs
from memorymaze.extras import command_here
from memorymaze.wording import counted


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "runs",
        help="make one run of its shards",
        description="Do something with run folders.",
        epilog="example: memorymaze runs merge runs/1 runs/2 --out runs/whole",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    merge = actions.add_parser(
        "merge",
        help="make one run folder of those of all its shards",
        description="Make one run folder of those of all shards of a run (evaluate "
        "--with shard=1/8). It equals that of the same run in one piece. Shards of different "
        "settings, agents or code are refused.",
        epilog="example: memorymaze runs merge runs/1 runs/2 --out runs/whole",
    )
    merge.add_argument(
        "folders", metavar="RUN", nargs="+", help="run folders of all shards"
    )
    merge.add_argument("--out", metavar="DIR", required=True, help="run folder")
    merge.set_defaults(run=_merge)


def _merge(options: argparse.Namespace) -> int:
    from memorymaze.evaluation.shards import merge_shards

    results = merge_shards(options.folders, options.out)
    print(
        f"run {options.out}: {counted(len(results), 'episode')} of "
        f"{counted(len(options.folders), 'shard')}"
    )
    print(f"tables: {command_here()} table {shlex.quote(options.out)}")
    return 0
