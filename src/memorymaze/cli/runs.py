"""`memorymaze runs`: whether runs can be published, and which is best."""

from memorymaze.cli.runs_check import add_check
from memorymaze.cli.runs_leaderboard import add_leaderboard
from memorymaze.cli.verbs import Verbs


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "runs",
        help="check runs for a leaderboard, and rank them",
        description="Check that a run can stand on a leaderboard, or make the page that "
        "ranks a folder of runs.",
        epilog="example: memorymaze runs check runs/rules",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    add_check(actions)
    add_leaderboard(actions)
