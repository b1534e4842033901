"""What answers given before a run lack, and how its episodes will end by them.

No model is asked here; the agent asks, and is answered from a file.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal, cast

import numpy as np

from memorymaze.agents.agent import Agent, Journal, asking_of
from memorymaze.agents.notes import ProgramDoubtsNote, note_of
from memorymaze.basics.errors import (
    EpisodeOver,
    LanguageModelError,
    ProgramError,
)
from memorymaze.language.models.answers import UnansweredError
from memorymaze.language.models.building import replaying_model
from memorymaze.language.models.model import CompletionRequest
from memorymaze.robot.api.specification import ASKING_NAMES
from memorymaze.robot.api.steps import SteppingRobot
from memorymaze.runs.episodes.arena import arenas_of
from memorymaze.runs.episodes.episode import run_episode
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.texts.corpus.records import Episode

_Kind = Literal["unsafe", "crash", "model_error", "note"]
"""How an episode will end, or `note`: worth knowing."""


def open_requests(plan: RunPlan) -> Iterator[CompletionRequest]:
    """Yield the next request of each episode that its answers leave open.

    Agents that ask all they ask before the robot moves are not put into a simulation.
    """
    settings = plan.settings
    arenas = arenas_of(settings, plan.sites)
    for episode in plan.episodes:
        agent = _Inquirer(plan.ready.in_episode(episode), episode)
        if agent.asks_beforehand:
            _follow_nowhere(agent, episode, Journal())
        else:
            arena = arenas[episode.instruction.site]
            captions = plan.ready.captions
            run_episode(agent, episode, arena, settings, captions=captions)
        if agent.open is not None:
            yield agent.open


@dataclass(frozen=True, slots=True)
class Remark:
    """One line on answers."""

    kind: _Kind
    text: str
    """With `file:line` where there is one."""


def remarks_on(plan: RunPlan) -> Iterator[Remark]:
    """Say how episodes will end before their robot moves, by the answers they have.

    Only agents that ask beforehand tell; programs are checked, not run.
    """
    known = {episode.instruction.id for episode in plan.episodes}
    places: dict[str, str] = {}
    model = replaying_model(plan.settings.agent.language_model)
    if model is not None:
        places = model.file.places
        for name in places.keys() - known:
            told = f"{places[name]}: {name!r} is the id of no instruction; not used"
            yield Remark("note", told)
        if model.file.unused:
            fields = ", ".join(map(repr, model.file.unused))
            told = f"{model.file.path}: fields that are not used: {fields}"
            yield Remark("note", told)
    for episode in plan.episodes:
        agent = _Inquirer(plan.ready.in_episode(episode), episode)
        if not agent.asks_beforehand:
            return
        journal = Journal()
        ending = _follow_nowhere(agent, episode, journal)
        name = episode.instruction.id
        file = plan.settings.agent.language_model.replay
        place = f"{places.get(name, file)}: {name}"
        if isinstance(ending, ProgramError):
            yield Remark("unsafe" if ending.unsafe else "crash", f"{place}: {ending}")
        elif isinstance(ending, LanguageModelError):
            yield Remark("model_error", f"{place}: {ending}")
        for note in journal.notes:
            read = note_of(note.about, note.details)
            if isinstance(read, ProgramDoubtsNote):
                yield from (Remark("note", f"{place}: {each}") for each in read.doubts)


class _Inquirer:
    """An agent that remembers the request that nobody had answered."""

    def __init__(self, agent: Agent, episode: Episode) -> None:
        self._agent = agent
        self.name = agent.name
        self.asks_beforehand = asking_of(agent, episode.instruction.text).beforehand
        self.open: CompletionRequest | None = None

    def follow(
        self,
        instruction: str,
        robot: SteppingRobot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        try:
            self._agent.follow(instruction, robot, journal, rng)
        except UnansweredError as unanswered:
            self.open = unanswered.request
            raise


def _follow_nowhere(
    agent: Agent, episode: Episode, journal: Journal
) -> ProgramError | LanguageModelError | None:
    """Let an agent ask; it is stopped where it would move. Return what went wrong."""
    robot = cast(SteppingRobot, _Nowhere())
    try:
        agent.follow(episode.instruction.text, robot, journal, np.random.default_rng(0))
    except EpisodeOver:
        return None
    except (ProgramError, LanguageModelError) as problem:
        return problem
    return None


class _Nowhere:
    """A robot in no building: whatever is called ends the episode."""

    def __getattr__(self, name: str) -> Any:
        if name in ASKING_NAMES:
            raise AttributeError(f"a robot in no building has nobody to {name}")
        raise EpisodeOver("budget")
