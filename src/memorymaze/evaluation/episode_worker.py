"""What a worker process does with the episodes it is given."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.errors import SpendingLimitReached
from memorymaze.evaluation.agent_failures import WorkerLost
from memorymaze.evaluation.agents_for_runs import build_agent
from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.episode import run_episode
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.settings import RunSettings
from memorymaze.evaluation.trace import trace_content
from memorymaze.instructions.records import Episode
from memorymaze.perception.eyes import Eyes
from memorymaze.robot.api import Robot
from memorymaze.sites import Site


@dataclass(frozen=True, slots=True)
class EpisodeDone:
    """What came of an episode; the driver alone writes it into the run folder."""

    result: EpisodeResult
    trace: bytes
    """Content of the trace's file."""


@dataclass(frozen=True, slots=True)
class LimitReached:
    """An episode that was broken off because the run has spent what it may."""

    reason: str


@dataclass(frozen=True, slots=True)
class EpisodeTask:
    """An episode to run."""

    episode: Episode
    tries: int = 0
    """Times a worker was lost over it."""
    lost: str | None = None
    """When set, the episode is not tried again but recorded as a crash, with this."""


@dataclass(frozen=True, slots=True)
class EpisodeWorker:
    """Makes, in a worker process, the function that runs one episode after another."""

    settings: RunSettings
    sites: dict[str, Site]

    def __call__(self) -> Callable[[EpisodeTask], EpisodeDone | LimitReached]:
        """Make the agent; return the function."""
        agent_for = build_agent(self.settings.agent)
        obstacles = self.settings.obstacles
        eyes = Eyes(self.settings.detector, self.settings.signs)
        arenas = {
            name: Arena(site, obstacles, eyes) for name, site in self.sites.items()
        }

        def run(task: EpisodeTask) -> EpisodeDone | LimitReached:
            episode = task.episode
            agent = agent_for(episode)
            if task.lost is not None:
                agent = _LostAgent(agent.name, task.lost)
            arena = arenas[episode.instruction.site]
            try:
                done = run_episode(agent, episode, arena, self.settings)
            except SpendingLimitReached as limit:
                return LimitReached(str(limit))
            return EpisodeDone(done.result, trace_content(done.trace))

        return run


@dataclass(frozen=True, slots=True)
class _LostAgent:
    """Stands in for an agent over which worker processes were lost twice."""

    name: str
    reason: str

    def follow(
        self, instruction: str, robot: Robot, journal: Journal, rng: np.random.Generator
    ) -> None:
        raise WorkerLost(self.reason)
