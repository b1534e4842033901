"""`memorymaze agents`: which agents there are, and the options of each."""

import argparse

from memorymaze.cli.verbs import Verbs


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "agents",
        help="list the agents, what they need, and their options",
        description="List the agents, what each needs, and the options that "
        "`evaluate` and `navigate` take for it with --set NAME=VALUE.",
        epilog="example: memorymaze agents code_generation",
    )
    parser.add_argument(
        "names",
        metavar="NAME",
        nargs="*",
        help="only these; also your own as module:Class or file.py:Class (default: all "
        "that come with the package)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.evaluation.agent_listing import agent_listing

    print(agent_listing(options.names), end="")
    return 0
