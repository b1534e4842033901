"""Options that say which agent acts, and how; shared by `evaluate` and `navigate`."""

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from memorymaze.cli.flags import add_flags, flag_names, given_flags
from memorymaze.language.model_settings import ModelSettings
from memorymaze.options import read_flags, read_values

if TYPE_CHECKING:
    from memorymaze.evaluation.settings import AgentSettings, RunSettings


def add_agent_name(parser: argparse.ArgumentParser, default: str | None) -> None:
    """Add `--agent`, among the options that come first."""
    parser.add_argument(
        "--agent",
        metavar="NAME",
        default=default,
        required=default is None,
        help="rules, code_generation, …: see `memorymaze agents`; or your own as "
        "module:Class or file.py:Class" + (f" (default: {default})" if default else ""),
    )


def add_agent_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the agent and of its language model, as groups."""
    group = parser.add_argument_group("the agent")
    group.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="an option of the agent; may be given several times. `memorymaze agents "
        "NAME` lists the options of each agent, with what they mean",
    )
    model = parser.add_argument_group("language model")
    add_flags(model.add_argument, ModelSettings)


WHICH_EPISODES = ("limit", "split", "shard", "second_telling")
"""Settings that only runs of several episodes have."""


def add_episode_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that every episode obeys, as a group."""
    from memorymaze.evaluation.settings import RunSettings
    from memorymaze.simulation.settings import SimulationSettings

    group = parser.add_argument_group("how episodes are run")
    every = [name for name in flag_names(RunSettings) if name not in WHICH_EPISODES]
    add_flags(group.add_argument, RunSettings, every)
    add_flags(group.add_argument, SimulationSettings)


def episode_settings(options: argparse.Namespace, base: "RunSettings") -> "RunSettings":
    """Return settings with what the options say."""
    from memorymaze.evaluation.settings import RunSettings, with_choices
    from memorymaze.simulation.settings import SimulationSettings

    given = given_flags(options, SimulationSettings)
    of_robot = {name: text for name, text in given.items() if name != "time_budget"}
    return with_choices(
        base,
        read_values(RunSettings, given_flags(options, RunSettings), flags=True)
        | read_values(SimulationSettings, of_robot, flags=True),
    )


def agent_settings(options: argparse.Namespace) -> "AgentSettings":
    """Return the agent that the options ask for."""
    from memorymaze.evaluation.settings import AgentSettings

    return AgentSettings(
        name=options.agent,
        language_model=read_flags(ModelSettings, given_flags(options, ModelSettings)),
        options=given_options(options.set),
    )


def given_options(
    texts: Sequence[str], flag: str = "--set"
) -> tuple[tuple[str, str], ...]:
    """Return the names and values that a flag was given."""
    from memorymaze.errors import SettingsError

    pairs: list[tuple[str, str]] = []
    for text in texts:
        name, equals, value = text.partition("=")
        if not (equals and name.strip()):
            raise SettingsError(f"{flag}: expected NAME=VALUE, got {text!r}")
        pairs.append((name.strip(), value.strip()))
    return tuple(pairs)
