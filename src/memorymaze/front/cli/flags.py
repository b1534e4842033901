"""Options of the command line that are read from dataclasses of settings."""

from collections.abc import Callable, Collection
from dataclasses import fields
from typing import Any

from memorymaze.basics.options import list_options


def flag_names(cls: type) -> list[str]:
    """Return the fields that the command line has an option for: those with a `metavar`.

    All others are given with `--with NAME=VALUE`.
    """
    return [each.name for each in fields(cls) if "metavar" in each.metadata]


def add_flags(
    add: Callable[..., Any], cls: type, only: Collection[str] | None = None
) -> None:
    """Add an option for each field of a dataclass; what is given stays a text.

    Help is the meaning of a field up to the first semicolon; `memorymaze settings` has the
    rest. A field's metadata may say what it is when it is given `alone`, without a value.

    `add` is `add_argument` of a parser or of a group of it; `only` names fields, None
    stands for those of `flag_names`.
    """
    known = {each.name: each for each in fields(cls)}
    for option in list_options(cls, flag_names(cls) if only is None else only):
        field = known[option.name]
        form: dict[str, Any] = {"metavar": field.metadata["metavar"]}
        if "alone" in field.metadata:
            form |= {"nargs": "?", "const": field.metadata["alone"]}
        default = "" if option.default == "none" else option.default
        add(
            f"--{field.name.replace('_', '-')}",
            help=(
                option.meaning.partition(";")[0]
                + (default and f" (default: {default})")
            ).replace("%", "%%"),
            **form,
        )
