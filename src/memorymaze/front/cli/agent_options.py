"""Options that say which agent acts, and how; shared by `evaluate`, `navigate`, `try`."""

import argparse
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from memorymaze.front.cli.flags import add_flags, flag_names
from memorymaze.language.models.model_settings import ModelSettings

if TYPE_CHECKING:
    from memorymaze.runs.episodes.named_settings import GivenSetting
    from memorymaze.runs.episodes.settings import AgentSettings, RunSettings


def add_agent_name(add: "Callable[..., Any]", default: str | None) -> None:
    """Add `--agent`, among the options that come first."""
    add(
        "--agent",
        metavar="NAME",
        default=default,
        help="one of `memorymaze agents`, or your own as module:Class or file.py:Class"
        + (f" (default: {default})" if default else ""),
    )


def add_agent_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the agent and of its language model."""
    parser.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="an option of the agent; see `memorymaze agents NAME`",
    )
    model = parser.add_argument_group("language model")
    add_flags(model.add_argument, ModelSettings)


def add_episode_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that every episode obeys, as a group."""
    from memorymaze.runs.episodes.settings import OF_MANY_EPISODES, RunSettings

    group = parser.add_argument_group("how episodes are run")
    every = [name for name in flag_names(RunSettings) if name not in OF_MANY_EPISODES]
    add_flags(group.add_argument, RunSettings, every)
    group.add_argument(
        "--with",
        dest="settings",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="any other setting; see `memorymaze settings`",
    )
    group.add_argument(
        "--settings",
        dest="settings_file",
        metavar="FILE",
        help="a file of settings (TOML); the command line wins",
    )


def given_settings(options: argparse.Namespace) -> "list[GivenSetting]":
    """Return all settings that a command was given; later ones win.

    Raises:
        SettingsError: One is given twice, or its file cannot be read.
    """
    from memorymaze.basics.errors import SettingsError
    from memorymaze.runs.episodes.named_settings import (
        SETTINGS,
        GivenSetting,
        read_settings,
    )

    given = [
        GivenSetting(name, value, f"--{name.replace('_', '-')}")
        for name in SETTINGS
        if (value := getattr(options, name, None)) is not None
    ]
    for name, value in given_options(getattr(options, "settings", []), "--with"):
        name = name.replace("-", "_")
        if name in {each.name for each in given}:
            raise SettingsError(f"--with {name}: given twice; leave one out")
        given.append(GivenSetting(name, value, f"--with {name}"))
    path = getattr(options, "settings_file", None)
    return given if path is None else [*read_settings(path), *given]


def episode_settings(options: argparse.Namespace, base: "RunSettings") -> "RunSettings":
    """Return settings with what the options say."""
    from memorymaze.runs.episodes.named_settings import run_settings

    return run_settings(base, given_settings(options))


def one_episode_settings(options: argparse.Namespace) -> "RunSettings":
    """Return the settings of a single episode; refuse those that choose among several."""
    from memorymaze.basics.errors import SettingsError
    from memorymaze.runs.episodes.settings import OF_MANY_EPISODES, RunSettings

    settings = episode_settings(options, RunSettings())
    for each in given_settings(options):
        if each.name in OF_MANY_EPISODES:
            where = f"{each.place}: " if each.place else ""
            raise SettingsError(
                f"{where}{each.called}: is for runs of several episodes; leave it out, or "
                "see memorymaze evaluate"
            )
    return settings


def agent_settings(options: argparse.Namespace) -> "AgentSettings":
    """Return the agent that the options ask for."""
    from memorymaze.runs.episodes.named_settings import model_settings
    from memorymaze.runs.episodes.settings import AgentSettings

    return AgentSettings(
        name=options.agent,
        language_model=model_settings(given_settings(options)),
        options=given_options(options.set),
    )


def given_options(
    texts: Sequence[str], flag: str = "--set"
) -> tuple[tuple[str, str], ...]:
    """Return the names and values that a flag was given."""
    from memorymaze.basics.errors import SettingsError

    pairs: list[tuple[str, str]] = []
    for text in texts:
        name, equals, value = text.partition("=")
        if not (equals and name.strip()):
            raise SettingsError(f"{flag}: expected NAME=VALUE, got {text!r}")
        pairs.append((name.strip(), value.strip()))
    return tuple(pairs)
