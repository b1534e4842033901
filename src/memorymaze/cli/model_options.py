"""Options that say which language model is asked, how, and what that may cost."""

import argparse
from collections.abc import Callable, Collection
from dataclasses import fields
from typing import Any

from memorymaze.language.model_settings import ModelSettings
from memorymaze.options import list_options, read_flags

OTHER_NAMES = {"replay": ["--programs"]}
"""What options were called before."""


def add_model_options(
    add: Callable[..., Any], only: Collection[str] | None = None
) -> None:
    """Add an option for each field of `ModelSettings`, or `only` for some.

    Args:
        add: `add_argument` of a parser, or of a group of it.
        only: Names of fields.
    """
    kinds = {each.name: each for each in fields(ModelSettings)}
    for option in list_options(ModelSettings):
        metavar = kinds[option.name].metadata.get("metavar")
        if metavar is None or (only is not None and option.name not in only):
            continue
        default = "" if option.default == "none" else f" (default: {option.default})"
        add(
            f"--{option.name.replace('_', '-')}",
            *OTHER_NAMES.get(option.name, []),
            metavar=metavar,
            help=(option.meaning + default).replace("%", "%%"),
        )


def model_settings(options: argparse.Namespace) -> ModelSettings:
    """Return what the options say of the model.

    Raises:
        SettingsError: A value has no meaning; names the option.
    """
    given = {
        each.name: getattr(options, each.name, None) for each in fields(ModelSettings)
    }
    return read_flags(
        ModelSettings, {name: text for name, text in given.items() if text is not None}
    )
