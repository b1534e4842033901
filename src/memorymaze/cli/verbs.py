"""What verbs share: their parser, the place where they add it, and `--sites`."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from argparse import _ArgumentGroup  # pyright: ignore[reportPrivateUsage]


class VerbParser(ArgumentParser):
    """Parser of a verb; it may get its options only when the verb is called.

    Options that are read from settings take a second to import, and the help of the whole
    program shows none of them.
    """

    def __init__(
        self,
        *arguments: Any,
        options: Callable[[ArgumentParser], None] | None = None,
        **named: Any,
    ) -> None:
        """Take what adds the options."""
        super().__init__(*arguments, **named)
        self._add_options = options

    def parse_known_args(  # pyright: ignore[reportIncompatibleMethodOverride]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[Namespace, list[str]]:
        """Add the options and parse."""
        if self._add_options is not None:
            self._add_options(self)
            self._add_options = None
        return super().parse_known_args(args, namespace)


class Verbs(Protocol):
    """What `ArgumentParser.add_subparsers` returns."""

    def add_parser(
        self,
        name: str,
        *,
        help: str,
        description: str,
        epilog: str,
        options: Callable[[ArgumentParser], None] | None = None,
    ) -> ArgumentParser:
        """Add a verb and return its parser; `options` adds some when it is called."""
        ...


def add_sites_option(parser: "ArgumentParser | _ArgumentGroup") -> None:
    """Add `--sites`, of verbs that look at buildings."""
    parser.add_argument(
        "--sites",
        metavar="DIR",
        help="folder of site plans (default: the three shipped ones)",
    )
