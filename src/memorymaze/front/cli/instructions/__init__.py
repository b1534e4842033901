"""`memorymaze instructions`: describe, check, label, exchange; one file per action."""

from memorymaze.front.cli.instructions import (
    agreement,
    check,
    exchange,
    generate,
    label,
    stats,
)
from memorymaze.front.cli.verbs import Verbs

__all__ = ["add_parser"]


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "instructions",
        help="describe, check, label, make or exchange instruction files",
        description="Describe instruction files as the paper's Table I does, check "
        "and label them, make new ones, or bring them into and out of other formats.",
        epilog="example: memorymaze instructions stats",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    for action in (stats, check, label, agreement, generate, exchange):
        action.add_parser(actions)
