"""From the name of an agent to the agent, for the command line and for workers."""

import difflib
import importlib
import importlib.util
import inspect
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, cast

from memorymaze.agents import AGENTS
from memorymaze.agents.agent import Agent
from memorymaze.errors import SettingsError
from memorymaze.evaluation.agent_failures import failure_line
from memorymaze.evaluation.language_models import build_language_model
from memorymaze.evaluation.oracle import OracleAgent
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.instructions.records import Episode

__all__ = [
    "AgentFor",
    "agent_names",
    "build_agent",
    "checked_agent",
    "has_language_model",
]

AgentFor = Callable[[Episode], Agent]
"""Gives the agent that follows an episode; only `oracle` looks at the episode."""

LANGUAGE_MODEL_AGENTS = ("code_generation",)


def agent_names() -> list[str]:
    """Return the names that `build_agent` knows without a module or file."""
    return sorted({*AGENTS, *LANGUAGE_MODEL_AGENTS, "oracle"})


def has_language_model(name: str) -> bool:
    """Tell whether the agent of this name asks a language model."""
    return name in LANGUAGE_MODEL_AGENTS


def build_agent(settings: AgentSettings) -> AgentFor:
    """Make an agent.

    Besides the names of `agent_names`, `package.module:Class` and `path/to/file.py:Class`
    are understood: anything that can be called without arguments and returns an
    `Agent`. What lies beside the file, or for a module in the current folder, can be
    imported too. One agent follows all the episodes of a process, so it must not carry
    anything from one to the next.

    Raises:
        SettingsError: There is no such agent, it cannot be made, or the settings name
            a language model for an agent that has none.
    """
    if not has_language_model(settings.name):
        _refuse_model(settings)
    if settings.name == "oracle":
        return lambda episode: OracleAgent(episode.reference_path)
    if has_language_model(settings.name):
        agent = _language_model_agent(settings)
    elif settings.name in AGENTS:
        agent = AGENTS[settings.name]()
    else:
        agent = _users_agent(settings.name)
    return lambda _: agent


def _refuse_model(settings: AgentSettings) -> None:
    for option in ("model", "base_url", "record", "replay"):
        if getattr(settings, option) is not None:
            raise SettingsError(
                f"--{option.replace('_', '-')}: the agent {settings.name!r} asks no "
                "language model; leave the option out, or choose --agent "
                f"{LANGUAGE_MODEL_AGENTS[0]}"
            )
    if settings.parser is not None:
        raise SettingsError(
            f"--no-parser: the agent {settings.name!r} has no parser to leave out"
        )


def _language_model_agent(settings: AgentSettings) -> Agent:
    from memorymaze.agents.code_generation import CodeGenerationAgent

    model = build_language_model(settings)
    return CodeGenerationAgent(model, parser=settings.parser is not False)


def _users_agent(name: str) -> Agent:
    place, colon, attribute = name.rpartition(":")
    if not colon:
        close = difflib.get_close_matches(name, agent_names(), n=1)
        hint = f"; did you mean {close[0]!r}?" if close else ""
        raise SettingsError(
            f"agent: expected one of {', '.join(agent_names())}, or your own as "
            f"module:Class or file.py:Class, got {name!r}{hint}"
        )
    try:
        module = _load(place)
    except (Exception, SystemExit) as error:
        raise SettingsError(
            f"agent {name!r}: {place!r} cannot be imported ({failure_line(error)})"
        ) from error
    factory = getattr(module, attribute, None)
    if not callable(factory):
        raise SettingsError(
            f"agent {name!r}: expected {place!r} to have a class {attribute!r}, got "
            f"{'nothing of this name' if factory is None else repr(factory)}"
        )
    try:
        return checked_agent(name, cast(Any, factory()))
    except SettingsError:
        raise
    except (Exception, SystemExit) as error:
        raise SettingsError(
            f"agent {name!r}: cannot be made without arguments ({failure_line(error)})"
        ) from error


def checked_agent(name: str, agent: Any) -> Agent:
    """Return an agent that has what every episode needs of one.

    Args:
        name: As the user calls it, for messages.
        agent: Anything.

    Raises:
        SettingsError: It has no `name` of one line, or no `follow` with four arguments.
    """
    follow = getattr(agent, "follow", None)
    if not (callable(follow) and hasattr(agent, "name")):
        raise SettingsError(
            f"agent {name!r}: expected an agent with `name` and `follow(instruction, "
            f"robot, journal, rng)`, got {type(agent).__name__}"
        )
    called = agent.name
    if not (isinstance(called, str) and called.strip() and called.isprintable()):
        raise SettingsError(
            f"agent {name!r}: expected its `name` to be one line of text, got {called!r}"
        )
    signature = inspect.signature(follow)
    try:
        signature.bind("the text", "the robot", "the journal", "the rng")
    except TypeError:
        raise SettingsError(
            f"agent {name!r}: expected follow(instruction, robot, journal, rng), got "
            f"follow{signature}"
        ) from None
    return agent


def _load(place: str) -> ModuleType:
    if not place.endswith(".py"):
        _look_also_in(Path.cwd())
        return importlib.import_module(place)
    path = Path(place).absolute()
    # Not its bare name: a user's random.py must not stand in for the library's.
    spec = importlib.util.spec_from_file_location(f"own_agent_{path.stem}", path)
    if spec is None or spec.loader is None or not path.is_file():
        raise FileNotFoundError(f"no such file: {place}")
    _look_also_in(path.parent)
    module = importlib.util.module_from_spec(spec)
    # Dataclasses and pickles inside the file look their module up here.
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module


def _look_also_in(folder: Path) -> None:
    """Let imports find what lies beside a user's agent, after all that is installed."""
    if str(folder) not in sys.path:
        sys.path.append(str(folder))
