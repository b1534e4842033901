"""`memorymaze settings`: all settings of runs, or those of a run as a file."""

import argparse
import textwrap
from collections.abc import Iterator, Sequence

from memorymaze.front.cli.verbs import Verbs, given_path

WIDTH = 88


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "settings",
        help="list the settings of runs, what they mean and their defaults",
        description="List the settings that `evaluate`, `navigate` and `try` take with "
        "--with NAME=VALUE, as options of their own, or in a file with --settings; or "
        "write those of a run as such a file.",
        epilog="example: memorymaze settings turning_points",
    )
    parser.add_argument(
        "names", metavar="NAME", nargs="*", help="only these (default: all)"
    )
    parser.add_argument(
        "--of",
        metavar="RUN",
        type=given_path,
        help="write the settings of this run folder as a file for --settings",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    if options.of is None:
        print(settings_listing(options.names), end="")
        return
    from memorymaze.basics.errors import SettingsError
    from memorymaze.runs.episodes.named_settings import settings_file
    from memorymaze.runs.work.run_folder import read_run

    if options.names:
        raise SettingsError("--of: writes all settings of a run; leave the names out")
    settings = read_run(options.of)[0].settings
    print(settings_file(settings, settings.agent.language_model), end="")


def settings_listing(names: Sequence[str]) -> str:
    """Return a text on settings, by what they are about; on all where none is named."""
    from memorymaze.basics.errors import SettingsError, did_you_mean
    from memorymaze.language.models.model_settings import ModelSettings
    from memorymaze.robot.simulation.settings import SimulationSettings
    from memorymaze.runs.episodes.named_settings import SETTINGS
    from memorymaze.runs.episodes.settings import RunSettings

    chosen = [name.replace("-", "_") for name in names]
    for name in chosen:
        if name not in SETTINGS:
            raise SettingsError(
                f"setting: expected one of those that `memorymaze settings` lists, got "
                f"{name!r}{did_you_mean(name, SETTINGS)}"
            )
    titles = {
        RunSettings: "how episodes are run",
        SimulationSettings: "the robot and its limits",
        ModelSettings: "the language model, of agents that ask one",
    }
    paragraphs: list[str] = []
    for cls, title in titles.items():
        listed = [
            name
            for name, owner in SETTINGS.items()
            if owner is cls and name in (chosen or SETTINGS)
        ]
        if listed:
            paragraphs.append("\n".join([title, *_described(cls, listed)]))
    return "\n\n".join(paragraphs) + "\n"


def _described(cls: type, names: Sequence[str]) -> Iterator[str]:
    from memorymaze.basics.options import called_on_command_line, list_options

    for option in list_options(cls, names):
        flag = called_on_command_line(cls, option.name)
        between = "=" if flag.startswith("--with") else " "
        yield f"  {flag}{between}{option.default}"
        meaning = option.meaning[0].upper() + option.meaning[1:].rstrip(".")
        said = f"{meaning}. Takes {option.allowed}."
        yield textwrap.indent(textwrap.fill(said, WIDTH - 8), " " * 8)
