"""`memorymaze instructions`: describe, check, exchange; one file per action."""

from memorymaze.cli.instructions import check, exchange, generate, stats
from memorymaze.cli.verbs import Verbs

__all__ = ["add_parser"]


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "instructions",
        help="describe, check or exchange instruction files",
        description="Describe instruction files as the paper's Table I does, check "
        "them, or bring them into and out of other formats.",
        epilog="example: memorymaze instructions stats",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    for action in (stats, check, generate, exchange):
        action.add_parser(actions)
