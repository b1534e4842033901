"""What verbs share: the place where they add their parser, and `--sites`."""

from argparse import ArgumentParser
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from argparse import _ArgumentGroup  # pyright: ignore[reportPrivateUsage]


class Verbs(Protocol):
    """What `ArgumentParser.add_subparsers` returns."""

    def add_parser(
        self,
        name: str,
        *,
        help: str,
        description: str,
        epilog: str,
    ) -> ArgumentParser:
        """Add a verb and return its parser."""
        ...


def add_sites_option(parser: "ArgumentParser | _ArgumentGroup") -> None:
    """Add `--sites`, of verbs that look at buildings."""
    parser.add_argument(
        "--sites",
        metavar="DIR",
        help="folder of site plans (default: the three shipped ones)",
    )
