"""What verbs share: their parser, the place where they add it, and some options."""

import contextlib
import re
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol
from urllib.parse import quote

if TYPE_CHECKING:
    from argparse import _ArgumentGroup  # pyright: ignore[reportPrivateUsage]


class VerbParser(ArgumentParser):
    """Parser of a verb; it may get its options only when the verb is called.

    Options that are read from settings take a while to import, and the help of the whole
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
        # A place such as -8.0,-3.0 is no option, as -8.0 is none.
        self._negative_number_matcher = re.compile(r"-[\d.]+(,\s*-?[\d.]+)?$")
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


def given_path(text: str) -> Path:
    """Read an argument that names a file or a folder; an empty one would be the folder here."""
    if not text:
        raise ArgumentTypeError(
            "expected a path, got an empty one; name a file or folder"
        )
    return Path(text)


def add_sites_option(parser: "ArgumentParser | _ArgumentGroup") -> None:
    """Add `--sites`, of verbs that look at buildings."""
    parser.add_argument(
        "--sites",
        metavar="DIR",
        type=given_path,
        help="folder of site plans (default: the three shipped ones)",
    )


TEXTS = "JSONL or CSV files (default: the shipped texts, written by a language model)"
TEXTS_OR_FOLDER = (
    "JSONL or CSV files, or a folder, also SAIL's (default: the shipped texts, written by "
    "a language model)"
)


def add_corpus_options(
    parser: "ArgumentParser | _ArgumentGroup", texts: str = TEXTS_OR_FOLDER
) -> None:
    """Add `--instructions` and `--sites`, of verbs that take a corpus."""
    parser.add_argument(
        "--instructions", metavar="FILE", type=given_path, nargs="+", help=texts
    )
    add_sites_option(parser)


def add_files(parser: ArgumentParser) -> None:
    """Add instruction files, of verbs that take the shipped texts where there are none."""
    parser.add_argument("files", metavar="FILE", type=given_path, nargs="*", help=TEXTS)


def add_plan(parser: ArgumentParser) -> None:
    """Add a building that need not have routes."""
    parser.add_argument(
        "site",
        metavar="FILE|NAME",
        help="a plan, or a benchmark's site such as university",
    )


def add_site_and_route(parser: ArgumentParser) -> None:
    """Add a building and a route of it."""
    parser.add_argument("site", metavar="SITE", help="a shipped site, or a plan file")
    parser.add_argument(
        "route", metavar="ROUTE", help="R1, R2, … or the id of a route in the plan"
    )


def add_exclude_dev(parser: ArgumentParser) -> None:
    """Add `--exclude-dev`, of verbs that show runs."""
    parser.add_argument(
        "--exclude-dev",
        action="store_true",
        help="leave out the instructions that prompts may be built from (split dev)",
    )


def add_new_folder(parser: ArgumentParser, what: str) -> None:
    """Add `--out` and `--overwrite`, of verbs that make a folder of pages."""
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=given_path,
        required=True,
        help="folder to make; not there yet",
    )
    parser.add_argument(
        "--overwrite",
        action="store_true",
        help=f"replace the {what} that is there, once the new one is whole",
    )


@contextlib.contextmanager
def shown_progress(unit: str) -> Generator[Callable[..., None]]:
    """Show a bar on terminals; yields what is told done and total, and what it is about."""
    from tqdm import tqdm

    with tqdm(unit=unit, disable=not sys.stderr.isatty()) as bar:

        def show(done: int, total: int, name: str = "") -> None:
            bar.set_description(name, refresh=False)
            bar.total = total
            bar.update(done - bar.n)

        yield show


def file_stem(name: str) -> str:
    """Return a name as part of a file's; it may be anything, also `../../x`."""
    return quote(name, safe="")[:100]
