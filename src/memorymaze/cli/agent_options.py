"""Options that say which agent acts, and how; shared by `evaluate` and `navigate`."""

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from memorymaze.cli.model_options import add_model_options, model_settings

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
    add_model_options(model.add_argument)
    model.add_argument(
        "--no-parser",
        action="store_true",
        help="write the program from the instruction itself, without parsing it first",
    )


def add_episode_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that every episode obeys, as a group."""
    group = parser.add_argument_group("how episodes are run")
    group.add_argument(
        "--seed",
        metavar="N",
        type=int,
        help="of all randomness (default: 0)",
    )
    group.add_argument(
        "--success-distance",
        metavar="METRES",
        type=float,
        help="stopping nearer than this to the goal is success (default: 3.0)",
    )
    group.add_argument(
        "--time-budget",
        metavar="SECONDS",
        type=float,
        help="simulated time of an episode (default: three times what a perfect "
        "follower needs for the longest route)",
    )
    group.add_argument(
        "--call-budget",
        metavar="N",
        type=int,
        help="calls of the control API in an episode (default: 10000)",
    )
    group.add_argument(
        "--detection-range",
        metavar="METRES",
        type=float,
        help="how far things are detected (default: 4; with --sail 40, to the end of "
        "every hall)",
    )
    group.add_argument(
        "--obstacles",
        metavar="SETTINGS",
        nargs="?",
        const="medium",
        help="leave things in the way and let people walk about: light, medium or "
        "heavy, or settings such as things=4,density=1,seed=1 (alone: medium; "
        "default: none). Results are a track of their own",
    )
    group.add_argument(
        "--turning-points",
        metavar="SOURCE",
        help="where the robot knows turning points from: annotated (the site plan, "
        "the default) or lidar (its scans and odometry)",
    )
    group.add_argument(
        "--detector",
        metavar="NAME[:SETTINGS]",
        help="what looks for objects: truth (the default), truth:errors or truth:miss=0.2 "
        "(with mistakes), grounding-dino:CHECKPOINT,box_threshold=0.35 (a model, from "
        "the camera's picture), remote:URL (a server). See docs/perception.md",
    )
    group.add_argument(
        "--isolate",
        action="store_true",
        default=None,
        help="run an agent of your own in a process of its own, which has no buildings "
        "and cannot read plans",
    )
    group.add_argument(
        "--signs",
        metavar="SOURCE",
        help="how read_signs reads: truth (the default) or ocr (from the camera's "
        "picture)",
    )
    group.add_argument(
        "--looks",
        choices=("own", "models"),
        help="how things look to cameras: own, or models (furniture models; see "
        "memorymaze sites models, and the default where it was called)",
    )


CHOICES = (
    "seed",
    "success_distance",
    "time_budget",
    "call_budget",
    "detection_range",
    "turning_points",
    "obstacles",
    "detector",
    "signs",
    "looks",
    "isolate",
)


def episode_settings(
    options: argparse.Namespace, base: "RunSettings", *more: str
) -> "RunSettings":
    """Return settings with what the options say, `more` settings by name included."""
    from memorymaze.evaluation.settings import with_choices

    given = {name: getattr(options, name) for name in (*CHOICES, *more)}
    return with_choices(
        base, {name: value for name, value in given.items() if value is not None}
    )


def agent_settings(options: argparse.Namespace) -> "AgentSettings":
    """Return the agent that the options ask for."""
    from memorymaze.evaluation.agent_catalogue import has_parser
    from memorymaze.evaluation.settings import AgentSettings

    parser: bool | None = None
    if options.no_parser or (has_parser(options.agent) and options.replay is None):
        parser = not options.no_parser
    return AgentSettings(
        name=options.agent,
        parser=parser,
        language_model=model_settings(options),
        options=given_options(options.set),
    )


def given_options(texts: Sequence[str]) -> tuple[tuple[str, str], ...]:
    """Return the names and values that `--set` was given.

    Raises:
        SettingsError: A text is not `NAME=VALUE`.
    """
    return tuple(map(_pair, texts))


def _pair(text: str) -> tuple[str, str]:
    from memorymaze.errors import SettingsError

    name, equals, value = text.partition("=")
    if not (equals and name.strip()):
        raise SettingsError(f"--set: expected NAME=VALUE, got {text!r}")
    return name.strip(), value.strip()
