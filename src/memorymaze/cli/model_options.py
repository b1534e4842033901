"""Options that say which language model is asked, how, and what that may cost."""

import argparse
from collections.abc import Collection
from dataclasses import fields

from memorymaze.language.model_settings import ModelSettings
from memorymaze.options import list_options, read_flags

OTHER_NAMES = {"replay": ["--programs"]}
"""What options were called before."""


def add_model_options(
    parser: argparse.ArgumentParser, only: Collection[str] | None = None
) -> "argparse._ArgumentGroup":
    """Add an option for each field of `ModelSettings`, as a group; all, or `only` some."""
    group = parser.add_argument_group("language model")
    kinds = {each.name: each for each in fields(ModelSettings)}
    for option in list_options(ModelSettings):
        metavar = kinds[option.name].metadata.get("metavar")
        if metavar is None or (only is not None and option.name not in only):
            continue
        default = "" if option.default == "none" else f" (default: {option.default})"
        group.add_argument(
            f"--{option.name.replace('_', '-')}",
            *OTHER_NAMES.get(option.name, []),
            metavar=metavar,
            help=(option.meaning + default).replace("%", "%%"),
        )
    return group


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
