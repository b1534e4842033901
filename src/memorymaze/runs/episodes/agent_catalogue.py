"""From the name of an agent to the agent: the table of those that come with the package.

To add one: a row in `AGENTS`, with its class, which is made as users' own are (see
`memorymaze.agents.making`).
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from memorymaze.agents.agent import Agent, Need
from memorymaze.agents.isolated import IsolatedAgent
from memorymaze.agents.making import (
    AgentRecipe,
    agent_recipe,
    checked_agent,
    checked_needs,
)
from memorymaze.agents.navgpt import CaptionOptions
from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.input_files import FileStamp
from memorymaze.basics.options import called_on_command_line, options_of
from memorymaze.basics.own_code import find_own, own_fingerprint
from memorymaze.language.models.answers import AboutInstruction
from memorymaze.language.models.building import build_language_model
from memorymaze.language.models.model import LanguageModel
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.episodes.vision_captions import VisionCaptions
from memorymaze.texts.corpus.records import Episode


class ShippedAgent(NamedTuple):
    """An agent that comes with the package."""

    place: str
    """Its class, as users' own are named: `module:Class`."""
    summary: str
    """What it does, in a few words."""


AGENTS = {
    "closed_loop": ShippedAgent(
        "memorymaze.agents.closed_loop:ClosedLoopAgent",
        "a language model reads the text and says at each turning point what to do next",
    ),
    "code_generation": ShippedAgent(
        "memorymaze.agents.code_generation:CodeGenerationAgent",
        "a language model writes one program, and the robot runs it",
    ),
    "explorer": ShippedAgent(
        "memorymaze.agents.explorer:ExplorerAgent",
        "searches everywhere for the destination named, whatever way was told",
    ),
    "guide": ShippedAgent(
        "memorymaze.agents.guide:GuideAgent",
        "reads, believes, doubts, repairs what it was told, and tells how sure it is",
    ),
    "navgpt": ShippedAgent(
        "memorymaze.agents.navgpt:NavGPTAgent",
        "a language model picks the next viewpoint of a navigation graph, step by step",
    ),
    "navid": ShippedAgent(
        "memorymaze.agents.navid:NavidAgent",
        "the NaVid protocol: a vision model is shown the video so far and says one "
        "short motion after another",
    ),
    "oracle": ShippedAgent(
        "memorymaze.runs.episodes.guarded_robot:OracleAgent",
        "follows the reference path: what the robot's body can reach",
    ),
    "see_and_go": ShippedAgent(
        "memorymaze.agents.see_and_go:SeeAndGoAgent",
        "a vision-language model is shown the camera's picture and says the next move",
    ),
    "stop": ShippedAgent(
        "memorymaze.agents.stop:StopAgent", "stops where it stands: the lower end"
    ),
}

AgentChoice: TypeAlias = str | AgentSettings | Agent | type[Agent]
"""An agent by its name, with settings, as an object or as a class."""

Handed: TypeAlias = Agent | type[Agent] | None
"""An agent that is no matter of names: an object, or a class to be made."""


class ReadyAgent(NamedTuple):
    """An agent that was made, for all episodes of a process."""

    agent: Agent
    name: str
    """As it was then: an agent's own code may change it."""
    model: AboutInstruction | None
    """Asked by the agent, about the instruction of its episode."""
    captions: VisionCaptions | None
    """What describes viewpoints to it; None for templates."""

    def in_episode(self, episode: Episode) -> Agent:
        """Return the agent; from now on its model is asked about this instruction."""
        if self.model is not None:
            self.model.instruction = episode.instruction.id
        return self.agent


@dataclass(frozen=True, slots=True)
class ChosenAgent:
    """An agent as a run has it: found once, with its options read and its needs known."""

    settings: AgentSettings
    """What a run records of it."""
    recipe: AgentRecipe
    handed: Handed = None

    @property
    def needs(self) -> frozenset[Need]:
        """What it needs besides text and robot."""
        return self.recipe.needs

    @property
    def takes_model(self) -> bool:
        """Whether the run makes it with a language model; an object has what it asks."""
        is_object = self.handed is not None and not isinstance(self.handed, type)
        return "language_model" in self.needs and not is_object

    def with_defaults(self, **options: str) -> "ChosenAgent":
        """Return it with values for options that it has and nobody gave."""
        given = {name.replace("-", "_") for name, _ in self.settings.options}
        known = {name for name, _ in _values(self.recipe.options)}
        added = [each for each in options.items() if each[0] in known - given]
        if not added:
            return self
        told = (*self.settings.options, *added)
        settings = replace(self.settings, options=told)
        return ChosenAgent(settings, self.recipe.with_options(told), self.handed)

    def make(
        self, *, isolate: bool = False, kept_from: Sequence[str | Path] = ()
    ) -> ReadyAgent:
        """Make the agent, with the language model it asks.

        It follows all the episodes of a process, so it must not carry anything from one
        to the next. An isolated one lives in a process of its own without buildings, which
        is also kept from reading some files.

        Raises:
            SettingsError: It cannot be made, or not so; or its model cannot be used.
        """
        if isolate:
            self._refuse_isolation()
        asked = captions = None
        if self.takes_model:
            settings = self.settings.language_model
            model = build_language_model(settings)
            asked = AboutInstruction(model, "")
            captions = _captions(self.recipe.options, model, settings)
        agent = self.recipe.make(asked)
        if isolate:
            maker = self.recipe.maker_elsewhere()
            agent = IsolatedAgent(agent, maker, asked, kept_from)
        return ReadyAgent(agent, agent.name, asked, captions)

    def files(self) -> tuple[FileStamp, ...]:
        """Return the fingerprints of the files of a user's own agent."""
        return own_fingerprint(self.settings.name, self.handed)

    def option_values(self, agent: Agent) -> tuple[tuple[str, str], ...]:
        """Return all options with their values, those nobody gave too, as settled in it."""
        settled = getattr(agent, "options", None)
        if type(settled) is not type(self.recipe.options):
            settled = self.recipe.options
        return _values(settled) or self.settings.options

    def _refuse_isolation(self) -> None:
        name = self.settings.name
        for need in ("answers", "graph"):
            if need in self.needs:
                raise SettingsError(
                    f"isolate: the agent {name!r} needs the {need}, which an agent in a "
                    "process of its own does not get; leave the option out"
                )
        if not self.settings.is_own:
            raise SettingsError(
                f"isolate: is for agents of your own; {name!r} comes with memorymaze and "
                "sees no answers; leave the option out"
            )

    def refuse_unused_model(self) -> None:
        """Refuse settings of a language model where the agent is given none."""
        if self.takes_model:
            return
        settings = self.settings.language_model
        for field in fields(ModelSettings):
            # Users' own agents may ask a model that only they know of.
            is_set = getattr(settings, field.name) != field.default
            if is_set and not (self.settings.is_own and field.name == "inference_time"):
                raise SettingsError(self._unused(field.name))

    def _unused(self, setting: str) -> str:
        name = self.settings.name
        told = f"{called_on_command_line(ModelSettings, setting)}: the agent {name!r} asks no language model"
        if self.handed is not None and not isinstance(self.handed, type):
            return f"{told} of the run, being an object; hand over its class instead"
        if self.settings.is_own:
            return (
                f"{told} of the run; leave the option out, or declare "
                'needs = frozenset({"language_model"}) in its class, which is then made '
                "with model="
            )
        asks = [each for each in AGENTS if choose_agent(each).takes_model]
        return (
            f"{told}; leave the option out, or choose --agent {' or '.join(asks)}, or "
            "--ask N --with passers_by=model"
        )


def agent_names() -> list[str]:
    """Return the names of the agents that come with the package."""
    return sorted(AGENTS)


def choose_agent(
    agent: AgentChoice, language_model: ModelSettings | None = None
) -> ChosenAgent:
    """Find an agent, read its options and what it needs: once in a run.

    Besides the names of `agent_names`, `package.module:Class` and `path/to/file.py:Class`
    are understood, and an agent itself, or its class; see `memorymaze.agents.making`. With
    `language_model` it asks that one.

    Raises:
        SettingsError: There is no such agent, or it has no such options.
    """
    if isinstance(agent, str):
        agent = AgentSettings(agent)
    if isinstance(agent, AgentSettings):
        settings, handed = agent, None
    else:
        settings, handed = _settings_of(agent), agent
    if language_model is not None:
        if not isinstance(language_model, ModelSettings):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise SettingsError(
                "language_model: expected ModelSettings(model=…), got "
                f"{language_model!r}"
            )
        if settings.language_model != ModelSettings():
            raise SettingsError(
                f"language_model: the settings of the agent {settings.name!r} name one "
                "too; leave one out"
            )
        settings = replace(settings, language_model=language_model)
    return chosen_again(settings, handed)


def chosen_again(settings: AgentSettings, handed: Handed) -> ChosenAgent:
    """Return an agent that was chosen in another process."""
    name = settings.name
    if isinstance(handed, type):
        recipe = agent_recipe(name, handed, settings.options, handed_over=True)
    elif handed is not None:
        needs = checked_needs(name, checked_agent(name, handed))
        recipe = AgentRecipe(name, lambda: handed, (), None, needs, handed_over=True)
    else:
        place = name if settings.is_own else shipped_agent(name).place
        recipe = agent_recipe(name, find_own("agent", place), settings.options)
    return ChosenAgent(settings, recipe, handed)


def shipped_agent(name: str) -> ShippedAgent:
    """Return an agent that comes with the package."""
    if name in AGENTS:
        return AGENTS[name]
    raise SettingsError(
        f"agent: expected one of {', '.join(agent_names())}, or your own as "
        f"module:Class or file.py:Class, got {name!r}{did_you_mean(name, AGENTS)}"
    )


def _settings_of(handed: Agent | type[Agent]) -> AgentSettings:
    """Return what a run records of an agent that was handed over."""
    cls = handed if isinstance(handed, type) else type(handed)
    name = f"{cls.__module__}:{cls.__qualname__}"
    if isinstance(handed, type):
        return AgentSettings(name)
    return AgentSettings(name, options=_values(getattr(handed, "options", None)))


def _values(options: Any) -> tuple[tuple[str, str], ...]:
    if not is_dataclass(options) or isinstance(options, type):
        return ()
    return options_of(options)


def _captions(
    options: Any, model: LanguageModel, settings: ModelSettings
) -> VisionCaptions | None:
    """Return what describes viewpoints to an agent that has it as its options."""
    if not isinstance(options, CaptionOptions) or options.captions == "templates":
        return None
    if options.caption_model is not None:
        model = build_language_model(replace(settings, model=options.caption_model))
    return VisionCaptions(model)
