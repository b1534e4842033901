"""`memorymaze agents`: which agents there are, and the options of each."""

import argparse
import textwrap
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from memorymaze.front.cli.verbs import Verbs

if TYPE_CHECKING:
    from memorymaze.agents.agent import Need

NEEDS: "dict[Need, str]" = {
    "answers": "the reference path of its episode (no method to compare with)",
    "camera": "pictures from the robot's camera",
    "graph": "the navigation graph of the site",
    "language_model": "a language model (--model, or recorded replies with --replay)",
    "steps": "a robot that can be moved by single steps (robot.steps)",
}
WIDTH = 88


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "agents",
        help="list the agents, what they need, and their options",
        description="List the agents, what each needs, and the options that "
        "`evaluate` and `navigate` take for it with --set NAME=VALUE.",
        epilog="example: memorymaze agents code_generation",
    )
    parser.add_argument(
        "names",
        metavar="NAME",
        nargs="*",
        help="only these; also your own as module:Class or file.py:Class (default: all "
        "that come with the package)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    print(agent_listing(options.names), end="")


def agent_listing(names: Sequence[str]) -> str:
    """Return a text on agents, one paragraph each; on all where none is named."""
    from memorymaze.runs.episodes.agent_catalogue import agent_names

    paragraphs = ("\n".join(_paragraph(name)) for name in names or agent_names())
    return "\n\n".join(paragraphs) + "\n"


def _paragraph(name: str) -> Iterator[str]:
    from memorymaze.basics.errors import SettingsError
    from memorymaze.basics.options import list_options
    from memorymaze.runs.episodes.agent_catalogue import choose_agent, shipped_agent

    own = ":" in name
    recipe = choose_agent(name).recipe
    yield f"{name}: {'an agent of your own' if own else shipped_agent(name).summary}"
    for need in sorted(recipe.needs):
        yield f"  needs {NEEDS[need]}"
    if recipe.options is None:
        yield "  no options"
        return
    try:
        listed = list_options(type(recipe.options))
    except TypeError as error:
        raise SettingsError(f"agent {name!r}: its options: {error}") from None
    for option in listed:
        yield f"  --set {option.name}={option.default}"
        said = f"{option.meaning} Takes {option.allowed}."
        yield textwrap.indent(textwrap.fill(said, WIDTH - 8), " " * 8)
