"""`memorymaze doctor`: what works on this machine, and how to get the rest."""

import argparse

from memorymaze.front.cli.verbs import Verbs


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "doctor",
        help="say what works on this machine, and how to get the rest",
        description="Say what works on this machine: Python and packages, graphics, and "
        "the extras, each with what to type where it is missing. What is missing is no "
        "failure: nothing here is needed by `make benchmark`.",
        epilog="example: memorymaze doctor",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.front.library.doctor import examine

    for check in examine():
        print(f"{'works' if check.works else 'missing':8} {check.what}: {check.found}")
        if check.remedy:
            print(f"         type: {check.remedy}")
