"""`memorymaze programs`: programs that were written elsewhere; one file per action."""

from memorymaze.cli.programs import check, read
from memorymaze.cli.verbs import Verbs

__all__ = ["add_parser"]


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "programs",
        help="read programs from offline replies, and check them",
        description="Make a file of programs from the replies of offline inference, or "
        "check one; `memorymaze evaluate --agent code_generation --programs FILE` runs "
        "them.",
        epilog="example: memorymaze programs check programs.jsonl",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    for action in (read, check):
        action.add_parser(actions)
