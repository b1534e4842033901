"""From the name of an agent to the agent: the table of those that come with the package.

To add one: an entry in `_KNOWN`, with how it is made, its dataclass of options (see
`memorymaze.options`), and what it needs.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any

from memorymaze.agents.agent import Agent, Need
from memorymaze.agents.code_generation import CodeGenerationAgent, CodeGenerationOptions
from memorymaze.agents.explorer import ExplorerAgent, ExplorerOptions
from memorymaze.agents.guide import GuideOptions
from memorymaze.agents.isolated import IsolatedAgent
from memorymaze.agents.navgpt import NavGPTAgent, NavGPTOptions
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.own_agents import (
    checked_agent,
    checked_needs,
    checked_options,
    find_agent,
    make_own_agent,
)
from memorymaze.agents.rules import RulesAgent, RulesOptions
from memorymaze.agents.see_and_go import SeeAndGoAgent, SeeAndGoOptions
from memorymaze.agents.stop import StopAgent
from memorymaze.errors import SettingsError, did_you_mean
from memorymaze.evaluation.language_agents import (
    code_generation_for_runs,
    guide_for_runs,
    navgpt_for_runs,
    navid_for_runs,
    reading_for_runs,
    see_and_go_for_runs,
)
from memorymaze.evaluation.oracle import OracleAgent
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.instructions.records import Episode
from memorymaze.language.model_settings import ModelSettings
from memorymaze.options import options_of, read_options

AgentChoice = str | AgentSettings | Agent | type[Agent]
"""An agent by its name, with settings, as an object or as a class."""

AgentFor = Callable[[Episode], Agent]
"""Gives the agent that follows an episode; most look at no episode."""


@dataclass(frozen=True, slots=True)
class KnownAgent:
    """An agent that comes with the package."""

    make: Callable[[AgentSettings, Any], AgentFor]
    """Called with the settings and an instance of `options` (None where it has none)."""
    summary: str
    """What it does, in a few words."""
    needs: frozenset[Need] = frozenset()
    """Whatever its options are; these may have more in an attribute `needs`."""
    options: type | None = None
    """The dataclass of its options."""
    parser: bool = False
    """Whether it can parse instructions first (`--no-parser`)."""


def _one_for_all(make: Callable[[Any], Agent]) -> Callable[..., AgentFor]:
    """Return what makes, from options, one agent that follows all episodes."""

    def make_once(settings: AgentSettings, options: Any) -> AgentFor:
        agent = make(options)
        return lambda _: agent

    return make_once


_KNOWN: dict[str, KnownAgent] = {
    "code_generation": KnownAgent(
        code_generation_for_runs,
        "a language model writes one program, and the robot runs it",
        needs=CodeGenerationAgent.needs,
        options=CodeGenerationOptions,
        parser=True,
    ),
    "explorer": KnownAgent(
        reading_for_runs(ExplorerAgent),
        "searches everywhere for the destination named, whatever way was told",
        options=ExplorerOptions,
    ),
    "guide": KnownAgent(
        guide_for_runs,
        "reads, believes, doubts, repairs what it was told, and tells how sure it is",
        options=GuideOptions,
    ),
    "navgpt": KnownAgent(
        navgpt_for_runs,
        "a language model picks the next viewpoint of a navigation graph, step by step",
        needs=NavGPTAgent.needs,
        options=NavGPTOptions,
    ),
    "navid": KnownAgent(
        navid_for_runs,
        "the NaVid protocol: a vision model is shown the video so far and says one "
        "short motion after another",
        needs=NavidAgent.needs,
        options=NavidOptions,
    ),
    "oracle": KnownAgent(
        lambda settings, options: lambda each: OracleAgent(each.reference_path),
        "follows the reference path: what the robot's body can reach",
        needs=OracleAgent.needs,
    ),
    "rules": KnownAgent(
        reading_for_runs(RulesAgent),
        "reads the instruction by rules, walks and doubts; needs no model unless told to",
        options=RulesOptions,
    ),
    "see_and_go": KnownAgent(
        see_and_go_for_runs,
        "a vision-language model is shown the camera's picture and says the next move",
        needs=SeeAndGoAgent.needs,
        options=SeeAndGoOptions,
    ),
    "stop": KnownAgent(
        _one_for_all(lambda _: StopAgent()), "stops where it stands: the lower end"
    ),
}


def agent_names() -> list[str]:
    """Return the names that `build_agent` knows without a module or file."""
    return sorted(_KNOWN)


def known_agent(name: str) -> KnownAgent:
    """Return an agent that comes with the package."""
    if name in _KNOWN:
        return _KNOWN[name]
    raise SettingsError(
        f"agent: expected one of {', '.join(agent_names())}, or your own as "
        f"module:Class or file.py:Class, got {name!r}{did_you_mean(name, _KNOWN)}"
    )


def agent_needs(settings: AgentSettings, given: Agent | None = None) -> frozenset[Need]:
    """Return what an agent needs, by its settings or as it was given.

    Raises:
        SettingsError: There is no such agent, or it has no such options.
    """
    if given is not None:
        return checked_needs(settings.name, given)
    if settings.is_own:
        return checked_needs(settings.name, find_agent(settings.name))
    needs = known_agent(settings.name).needs
    kind = agent_options(settings.name)
    if kind is None:
        return needs
    options = read_options(kind, settings.options, agent=settings.name)
    return needs | getattr(options, "needs", frozenset[Need]())


def agent_options(name: str) -> type | None:
    """Return the dataclass of an agent's options; None where it has none."""
    if ":" in name:
        return checked_options(name, find_agent(name))
    return known_agent(name).options


def option_values(
    settings: AgentSettings, given: Agent | None = None
) -> tuple[tuple[str, str], ...]:
    """Return all options of an agent with their values, also those nobody gave."""
    kind = None if given is not None else agent_options(settings.name)
    if kind is None:
        # Those of an object are all there.
        return settings.options
    chosen = read_options(kind, settings.options, agent=settings.name)
    return tuple((each.name, each.default) for each in options_of(chosen))


def has_language_model(settings: AgentSettings) -> bool:
    """Tell whether a shipped agent asks a language model.

    Users' own agents have their models made by themselves.
    """
    return not settings.is_own and "language_model" in agent_needs(settings)


def has_parser(name: str) -> bool:
    """Tell whether the agent of this name can parse instructions first."""
    return name in _KNOWN and _KNOWN[name].parser


def settings_of(agent: AgentChoice) -> tuple[AgentSettings, Agent | None]:
    """Return what a run records of an agent, and the agent where it is no matter of names.

    A class is called without arguments, or with its dataclass `Options` as it stands.
    """
    if isinstance(agent, AgentSettings):
        return agent, None
    if isinstance(agent, str):
        return AgentSettings(agent), None
    made = make_own_agent(agent) if isinstance(agent, type) else agent
    cls = type(made)
    name = f"{cls.__module__}:{cls.__qualname__}"
    checked_needs(name, checked_agent(name, made))
    options = getattr(made, "options", None)
    given: tuple[tuple[str, str], ...] = ()
    if is_dataclass(options) and not isinstance(options, type):
        given = tuple((each.name, each.default) for each in options_of(options))
    return AgentSettings(name, options=given), made


def build_agent(
    settings: AgentSettings,
    given: Agent | None = None,
    *,
    isolate: bool = False,
    kept_from: Sequence[str | Path] = (),
) -> AgentFor:
    """Make an agent, or take the one that is given as an object.

    Besides the names of `agent_names`, `package.module:Class` and `path/to/file.py:Class`
    are understood: anything that can be called without arguments, or that has a dataclass
    `Options` and can be called with one of these, and returns an `Agent`. One agent
    follows all the episodes of a process, so it must not carry anything from one to the
    next.

    An isolated one lives in a process of its own without buildings, which is also kept
    from reading some files.
    """
    if isolate:
        _refuse_isolation(settings, given)
    if given is None and not settings.is_own:
        return _build_known(settings)
    if given is None:
        _refuse_parser(settings)
    own = make_own_agent(settings.name, settings.options) if given is None else given
    if isolate:
        by_name = given is None
        own = IsolatedAgent(
            settings.name, settings.options, own, kept_from, by_name=by_name
        )
    return lambda _: own


def _build_known(settings: AgentSettings) -> AgentFor:
    known = known_agent(settings.name)
    _refuse_parser(settings)
    options = None
    if known.options is not None:
        options = read_options(known.options, settings.options, agent=settings.name)
    elif settings.options:
        raise SettingsError(
            f"--set {settings.options[0][0]}: the agent {settings.name!r} has no "
            "options to set"
        )
    return known.make(settings, options)


def _refuse_isolation(settings: AgentSettings, given: Agent | None) -> None:
    for need in ("answers", "graph"):
        if need in agent_needs(settings, given):
            raise SettingsError(
                f"--isolate: the agent {settings.name!r} needs the {need}, which an agent "
                "in a process of its own does not get; leave the option out"
            )
    if given is None and not settings.is_own:
        raise SettingsError(
            f"--isolate: is for agents of your own; {settings.name!r} comes with "
            "memorymaze and sees no answers; leave the option out"
        )


def _refuse_parser(settings: AgentSettings) -> None:
    if settings.parser is not None and not has_parser(settings.name):
        raise SettingsError(
            f"--no-parser: the agent {settings.name!r} has no parser to leave out"
        )


def refuse_unused_model(settings: AgentSettings, given: Agent | None = None) -> None:
    """Refuse settings of a language model where the agent asks none.

    Raises:
        SettingsError: There is such a setting.
    """
    if given is not None or has_language_model(settings):
        return
    askers = [name for name in agent_names() if has_language_model(AgentSettings(name))]
    for field in (each for each in fields(ModelSettings) if each.metadata):
        # Users' own agents may ask a model that only they know of.
        is_set = getattr(settings.language_model, field.name) != field.default
        if is_set and not (settings.is_own and field.name == "inference_time"):
            raise SettingsError(
                f"--{field.name.replace('_', '-')}: the agent {settings.name!r} asks no "
                "language model; leave the option out, or choose --agent "
                f"{' or '.join(askers)}, or --ask N --passers-by model"
            )
