"""The NaVid protocol's agent for runs: its policy, and the fair budget of a site."""

from collections.abc import Callable
from functools import partial

import numpy as np

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.navid.model_policies import BlindPolicy, VisionPolicy
from memorymaze.agents.navid.policy import Policy
from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.evaluation.budgets import fair_steps
from memorymaze.evaluation.guarded_robot import simulated_behind
from memorymaze.evaluation.language_models import build_language_model
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.instructions.records import Episode
from memorymaze.language.answers import AboutInstruction
from memorymaze.language.local_models import is_local
from memorymaze.language.model import LanguageModel
from memorymaze.robot.api import Robot


class NavidOnSite:
    """The agent with the budget `fair` of the site that it is on."""

    def __init__(self, agent: NavidAgent) -> None:
        """Stand for an agent."""
        self._agent = agent
        self.prompts = agent.prompts
        """Versions of the prompts that the agent asks with."""

    @property
    def name(self) -> str:
        """That of the agent."""
        return self._agent.name

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
    """Return what makes the agent of an episode, on a policy server or a vision model.

    Raises:
        SettingsError: The server cannot be used, no model is named, or both are.
    """
    if options.server is not None:
        policy = _remote_policy(settings, options, options.server)
        return lambda _: NavidOnSite(NavidAgent(policy, options))
    model = _checked_model(settings, options)

    def agent_for(episode: Episode) -> Agent:
        asked = AboutInstruction(model, episode.instruction.id)
        return NavidOnSite(NavidAgent(_policy(asked, options), options))

    return agent_for


def _checked_model(settings: AgentSettings, options: NavidOptions) -> LanguageModel:
    if settings.model is None and settings.replay is None:
        raise SettingsError(
            "--agent navid: name a vision model with --model, or a policy server with "
            "--set server=URL, or take recorded replies with --replay"
        )
    here = settings.base_url is None and is_local(settings.model or "")
    if options.pictures == "shown" and settings.replay is None and here:
        raise SettingsError(
            f"--model {settings.model}: models that run here see no pictures; name a "
            "vision model on a server (--base-url), or leave pictures out with --set "
            "pictures=none"
        )
    return build_language_model(settings)


def _policy(model: LanguageModel, options: NavidOptions) -> Policy:
    if options.pictures == "none":
        return BlindPolicy(
            model, temperature=options.temperature, max_tokens=options.max_tokens
        )
    return VisionPolicy(
        model,
        history=options.history,
        history_width=options.history_width,
        temperature=options.temperature,
        max_tokens=options.max_tokens,
    )


def _remote_policy(
    settings: AgentSettings, options: NavidOptions, address: str
) -> Policy:
    from memorymaze.agents.navid.remote_policy import (
        PolicyServer,
        RemotePolicy,
        ReplayedPolicy,
    )
    from memorymaze.language.answers import RecordingModel, ReplayingModel

    if options.pictures == "none":
        raise SettingsError(
            "--set pictures=none: a policy server is always shown pictures; leave it out"
        )
    for option in ("model", "base_url"):
        if getattr(settings, option) is not None:
            raise SettingsError(
                f"--{option.replace('_', '-')} and --set server: either a vision model "
                "or a policy server decides; leave one out"
            )
    asking = settings.asking
    for option in ("price", "max_cost", "max_tokens_total", "max_requests", "grammar"):
        if getattr(asking, option) is not None:
            raise SettingsError(
                f"--{option.replace('_', '-')}: is for language models; a policy server "
                "tells its costs itself and answers as fast as it can; leave it out"
            )
    record, replay = settings.record, settings.replay
    if replay is not None:
        if record is not None:
            raise SettingsError(
                "--replay and --record: replies are replayed or asked for, not both; "
                "leave one out"
            )
        return ReplayedPolicy(ReplayingModel(replay))
    server = PolicyServer(address, timeout=asking.timeout, retries=asking.retries)
    recorder = None if record is None else partial(RecordingModel, path=record)
    try:
        return RemotePolicy(server, recorder)
    except LanguageModelError as error:
        raise SettingsError(f"--set server: {error}") from error
