"""Agents that ask a language model, made for runs: each episode by its instruction's id."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from memorymaze.agents.agent import Agent, Journal, Need
from memorymaze.agents.code_generation import CodeGenerationAgent, CodeGenerationOptions
from memorymaze.agents.explorer import ExplorerAgent
from memorymaze.agents.guide import GuideAgent, GuideOptions
from memorymaze.agents.navgpt import NavGPTAgent, NavGPTOptions
from memorymaze.agents.navgpt.agent import loop_limits
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.plan_readers import ModelReader
from memorymaze.agents.rules import RulesAgent
from memorymaze.agents.see_and_go import MOTIONS, SeeAndGoAgent, SeeAndGoOptions
from memorymaze.errors import SettingsError
from memorymaze.evaluation.budgets import fair_steps, fewest_answers, perfect_steps
from memorymaze.evaluation.graph_agents import NavGPTOnGraph, longest_route_viewpoints
from memorymaze.evaluation.guarded_robot import simulated_behind
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.instructions.records import Episode
from memorymaze.language.answers import AboutInstruction
from memorymaze.language.building import build_language_model, replaying_model
from memorymaze.language.local_models import is_local
from memorymaze.language.model import LanguageModel
from memorymaze.language.model_settings import ModelSettings
from memorymaze.robot.api import Robot
from memorymaze.robot.steps import SteppingRobot
from memorymaze.sites import Route, Site

Made = TypeVar("Made", bound=Agent)


def _asking(
    model: LanguageModel, make: Callable[[LanguageModel], Made]
) -> Callable[[Episode], Made]:
    """Return what makes agents that ask a model, each about its episode's instruction."""
    return lambda episode: make(AboutInstruction(model, episode.instruction.id))


def code_generation_for_runs(
    settings: AgentSettings, options: CodeGenerationOptions
) -> Callable[[Episode], CodeGenerationAgent]:
    """Return what makes the agent of an episode."""
    model = build_language_model(settings.language_model)
    parser = parses_first(settings)

    return _asking(
        model, lambda asked: CodeGenerationAgent(asked, parser=parser, options=options)
    )


def reading_for_runs(
    agent: type[RulesAgent] | type[ExplorerAgent],
) -> Callable[[AgentSettings, Any], Callable[[Episode], Agent]]:
    """Return what makes agents that begin by reading, by grammar or a language model."""

    def make(settings: AgentSettings, options: Any) -> Callable[[Episode], Agent]:
        if options.reader != "model":
            made = agent(options)
            return lambda _: made
        model = build_language_model(settings.language_model)
        return _asking(model, lambda asked: agent(options, ModelReader(asked)))

    return make


def guide_for_runs(
    settings: AgentSettings, options: GuideOptions
) -> Callable[[Episode], GuideAgent]:
    """Return what makes the agent of an episode; one model reads and decides."""
    if not options.needs:
        made = GuideAgent(options)
        return lambda _: made
    model = build_language_model(settings.language_model)

    def make(asked: LanguageModel) -> GuideAgent:
        reader = ModelReader(asked) if options.reader == "model" else None
        return GuideAgent(options, reader, asked if options.asks_on_the_way else None)

    return _asking(model, make)


def parses_first(settings: AgentSettings) -> bool:
    """Tell whether an agent with a parser uses it; by its answers, if nobody says."""
    if settings.parser is not None:
        return settings.parser
    model = replaying_model(settings.language_model)
    stages = set() if model is None else {stage for _, stage in model.versions()}
    return not stages or any(stage.partition("+")[0] == "parse" for stage in stages)


def navgpt_for_runs(
    settings: AgentSettings, options: NavGPTOptions
) -> Callable[[Episode], NavGPTOnGraph]:
    """Return what makes the agent of an episode, and what describes what it sees."""
    model = build_language_model(settings.language_model)
    describe = None
    if options.captions == "vision":
        from memorymaze.evaluation.vision_captions import CaptionStore, VisionCaptions

        looking = model
        if options.caption_model is not None:
            looking = build_language_model(
                replace(settings.language_model, model=options.caption_model)
            )
        store = CaptionStore(options.caption_file)
        describe = VisionCaptions(looking, store).in_episode

    return _asking(
        model, lambda asked: NavGPTOnGraph(NavGPTAgent(asked, options), describe)
    )


Stepping = TypeVar("Stepping", NavidAgent, SeeAndGoAgent)


class _OnSite(Generic[Stepping]):
    """Stands for an agent whose budget comes from the site that it is on."""

    def __init__(self, agent: Stepping) -> None:
        """Stand for an agent."""
        self._agent = agent
        self.prompts = agent.prompts
        """Versions of the prompts that the agent asks with."""

    @property
    def name(self) -> str:
        """That of the agent."""
        return self._agent.name


class NavidOnSite(_OnSite[NavidAgent]):
    """The agent with the budget `fair` of the site that it is on."""

    needs: ClassVar[frozenset[Need]] = NavidAgent.needs

    def answers_expected(self, site: Site, route: Route) -> tuple[int, int]:
        """Return how often it will ask on a route.

        Without a mistake, and at most, as the budget of steps allows.
        """
        options = self._agent.options
        motions = options.motions
        fair = fair_steps(site.routes, motions.forward_m, motions.turn_deg)
        limit = options.step_limit(fair) or 0
        perfect = fewest_answers(route, motions.most, motions.turn_deg)
        # Where the budget does not suffice for the route, it ends the walk.
        return min(perfect, limit), limit

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Let the agent follow; only the number of steps comes from the site."""
        motions = self._agent.options.motions
        routes = simulated_behind(robot, self.name).scene.site.routes
        limit = fair_steps(routes, motions.forward_m, motions.turn_deg)
        self._agent.follow(instruction, robot, journal, rng, limit)


def navid_for_runs(
    settings: AgentSettings, options: NavidOptions
) -> Callable[[Episode], Agent]:
    """Return what makes the agent of an episode."""
    model = _checked_model(settings.language_model, options)
    return _asking(model, lambda asked: NavidOnSite(NavidAgent(asked, options)))


def _checked_model(settings: ModelSettings, options: NavidOptions) -> LanguageModel:
    if settings.model is None and settings.replay is None:
        raise SettingsError(
            "--agent navid: name a vision model with --model, or take recorded replies "
            "with --replay"
        )
    if options.pictures == "shown":
        _refuse_blind(settings, ", or leave pictures out with --set pictures=none")
    return build_language_model(settings)


def _refuse_blind(settings: ModelSettings, way_out: str = "") -> None:
    here = settings.base_url is None and is_local(settings.model or "")
    if settings.replay is None and here:
        raise SettingsError(
            f"--model {settings.model}: models that run here see no pictures; name a "
            f"vision model on a server (--base-url){way_out}"
        )


class SeeAndGoOnSite(_OnSite[SeeAndGoAgent]):
    """The agent with as many requests as NavGPT has, by its budget `fair`, on a site."""

    needs: ClassVar[frozenset[Need]] = SeeAndGoAgent.needs

    def answers_expected(self, site: Site, route: Route) -> tuple[int, int]:
        """Return how often it will ask on a route: without a mistake, and at most."""
        farthest, widest = (
            MOTIONS.most * each for each in (MOTIONS.forward_m, MOTIONS.turn_deg)
        )
        perfect = perfect_steps(route, farthest, widest) + 1
        limit = self._agent.options.requests or _fair_requests(site)
        return min(perfect, limit), limit

    def follow(
        self,
        instruction: str,
        robot: SteppingRobot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Let the agent follow; only the number of requests comes from the site."""
        simulated = simulated_behind(robot, self.name)
        limit = _fair_requests(simulated.scene.site)
        self._agent.follow(instruction, robot, journal, rng, limit)


def _fair_requests(site: Site) -> int:
    return loop_limits(NavGPTOptions(), longest_route_viewpoints(site)).iterations


def see_and_go_for_runs(
    settings: AgentSettings, options: SeeAndGoOptions
) -> Callable[[Episode], SeeAndGoOnSite]:
    """Return what makes the agent of an episode.

    Raises:
        SettingsError: No model is named, it sees nothing, or a file cannot be used.
    """
    _refuse_blind(settings.language_model)
    model = build_language_model(settings.language_model)
    return _asking(model, lambda asked: SeeAndGoOnSite(SeeAndGoAgent(asked, options)))
