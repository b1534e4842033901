"""Agents, what they need and their options, in words."""

import textwrap
from collections.abc import Iterator, Sequence

from memorymaze.errors import SettingsError
from memorymaze.evaluation.agent_catalogue import (
    Need,
    agent_names,
    agent_options,
    known_agent,
)
from memorymaze.options import list_options

_NEEDS: dict[Need, str] = {
    "answers": "the reference path of its episode (no method to compare with)",
    "camera": "pictures from the robot's camera",
    "graph": "the navigation graph of the site",
    "language_model": "a language model (--model, or recorded replies with --replay)",
    "steps": "a robot that can be moved by single steps (robot.steps)",
}
_WIDTH = 88


def agent_listing(names: Sequence[str] = ()) -> str:
    """Return a text on agents: one paragraph each."""
    paragraphs = ("\n".join(_paragraph(name)) for name in names or agent_names())
    return "\n\n".join(paragraphs) + "\n"


def _paragraph(name: str) -> Iterator[str]:
    if ":" in name:
        yield f"{name}: an agent of your own"
    else:
        agent = known_agent(name)
        yield f"{name}: {agent.summary}"
        for need in sorted(agent.needs):
            yield f"  needs {_NEEDS[need]}"
        if agent.parser:
            yield "  parses instructions first, unless --no-parser is given"
    kind = agent_options(name)
    if kind is None:
        yield "  no options"
        return
    try:
        options = list_options(kind)
    except TypeError as error:
        raise SettingsError(f"agent {name!r}: its options: {error}") from None
    for option in options:
        yield f"  --set {option.name}={option.default}"
        said = f"{option.meaning} Takes {option.allowed}."
        yield textwrap.fill(
            said, _WIDTH, initial_indent=" " * 8, subsequent_indent=" " * 8
        )
