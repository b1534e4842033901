"""`--sites`, which every action has that looks at the buildings."""

import argparse


def add_sites_option(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--sites",
        metavar="DIR",
        help="folder of site plans (default: the three shipped ones)",
    )
