"""Options of the command line that are read from dataclasses of settings."""

import argparse
from collections.abc import Callable, Collection
from dataclasses import fields
from typing import Any

from memorymaze.options import list_options


def flag_names(cls: type) -> list[str]:
    """Return the fields that the command line has an option for.

    Those are all that have a `metavar` in their metadata, and all that are true or false.
    """
    return [
        each.name
        for each in fields(cls)
        if "metavar" in each.metadata or isinstance(each.default, bool)
    ]


def add_flags(
    add: Callable[..., Any], cls: type, only: Collection[str] | None = None
) -> None:
    """Add an option for each field of a dataclass; what is given stays a text.

    A field's metadata may say what it is when it is given `alone`, without a value.

    `add` is `add_argument` of a parser or of a group of it; `only` names fields, None
    stands for those of `flag_names`.
    """
    known = {each.name: each for each in fields(cls)}
    for option in list_options(cls, flag_names(cls) if only is None else only):
        field = known[option.name]
        if isinstance(field.default, bool):
            form = {"action": "store_const", "const": "true"}
        else:
            form = {"metavar": field.metadata["metavar"]}
        if "alone" in field.metadata:
            form |= {"nargs": "?", "const": field.metadata["alone"]}
        default = "" if option.default in ("none", "false") else option.default
        add(
            f"--{field.name.replace('_', '-')}",
            help=(option.meaning + (default and f" (default: {default})")).replace(
                "%", "%%"
            ),
            **form,
        )


def given_flags(options: argparse.Namespace, cls: type) -> dict[str, str]:
    """Return the texts that were given for fields of a dataclass, by their names."""
    given = {each.name: getattr(options, each.name, None) for each in fields(cls)}
    return {name: text for name, text in given.items() if text is not None}
