"""The place where a verb adds its parser."""

from argparse import ArgumentParser
from typing import Protocol


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
