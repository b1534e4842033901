"""One episode: an agent follows an instruction, and is scored.

Whatever the agent does, there is a result; nothing it raises gets out of here.
"""

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol, cast

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.notes import TracebackNote
from memorymaze.basics.errors import (
    DetectorError,
    EpisodeOver,
    InterpreterLostError,
    LanguageModelError,
    ProgramError,
    SpendingLimitReached,
)
from memorymaze.basics.failures import failure_line, failure_traceback
from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.budgets import episode_time_budget, fair_limits
from memorymaze.runs.episodes.guarded_robot import hand_over
from memorymaze.runs.episodes.people_to_ask import people_of_episode
from memorymaze.runs.episodes.results import EpisodeResult, StoppedBy, measure_walk
from memorymaze.runs.episodes.seeds import seeds_of
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.runs.episodes.trace_entries import (
    OpeningEntry,
    TraceEntry,
    answer_entry,
    call_entry,
    closing_entries,
    note_entry,
    opening_entry,
    surroundings_entries,
)
from memorymaze.runs.episodes.vision_captions import VisionCaptions
from memorymaze.texts.corpus.records import Episode
from memorymaze.texts.passers_by import Encounters


@dataclass(frozen=True, slots=True)
class EpisodeRun:
    """What an episode leaves behind."""

    result: EpisodeResult
    trajectory: Trajectory
    trace: tuple[TraceEntry, ...]
    """Entries in the order of time; see `docs/formats.md`."""
    interpreter_lost: bool = False
    """Whether the process that ran the agent's program died."""

    @property
    def opening(self) -> OpeningEntry:
        """What was followed, from where."""
        return next(each for each in self.trace if isinstance(each, OpeningEntry))


class Watcher(Protocol):
    """Looks at an episode while it goes on; changes nothing."""

    def begin(self, robot: SimulatedRobot, trace: Sequence[TraceEntry]) -> None:
        """See an episode begin; its trace grows from now on."""
        ...

    def told(self) -> None:
        """Take note that the trace has grown."""
        ...


def run_episode(
    agent: Agent,
    episode: Episode,
    arena: Arena,
    settings: RunDefinition,
    watcher: Watcher | None = None,
    *,
    captions: VisionCaptions | None = None,
    name: str | None = None,
) -> EpisodeRun:
    """Let an agent follow an instruction, and score its walk.

    The first thing that ends the episode counts: a budget that ran out stays `budget`,
    even where the agent catches what the robot raises and returns as if it had arrived.
    A walk that leaves the floor is a `crash`, and measured up to there. An episode whose
    program lost its interpreter is run once more, because that may have been killed from
    outside; a program that brings it down does so again.

    Args:
        agent: Follows; may raise anything.
        episode: What to follow, from where.
        arena: The site of the episode.
        settings: Of the run; seed, budgets and success distance count here.
        watcher: Looks on.
        captions: Describe viewpoints to an agent on a graph; None for templates.
        name: Of the agent, in results; None for the one it has as the episode begins.

    Raises:
        UndefinedMetricError: The episode's reference path leaves the floor.
        KeyboardInterrupt: Passed on.
        SpendingLimitReached: Passed on; an episode that is broken off has no result.
    """
    called = agent.name if name is None else name

    def attempt() -> EpisodeRun:
        with ExitStack() as held:
            return _attempt(
                called, agent, episode, arena, settings, watcher, captions, held
            )

    run = attempt()
    return attempt() if run.interpreter_lost else run


def _attempt(
    name: str,
    agent: Agent,
    episode: Episode,
    arena: Arena,
    settings: RunDefinition,
    watcher: Watcher | None,
    captions: VisionCaptions | None,
    held: ExitStack,
) -> EpisodeRun:
    """Run it once; what `held` holds is let go of by the caller."""
    seeds = seeds_of(settings.seed, episode.id)
    way = arena.site.find_route(episode.instruction.reference_route)
    destination = None if settings.ask is None else way.goal
    trace: list[TraceEntry] = [opening_entry(name, episode, settings, destination)]

    def tell(entry: TraceEntry) -> None:
        trace.append(entry)
        if watcher is not None:
            watcher.told()

    robot = arena.robot(
        episode,
        replace(settings.simulation, time_budget=episode_time_budget(settings, way)),
        seeds.robot,
        lambda event: tell(call_entry(event)),
        seeds.detector,
    )
    held.callback(robot.close)
    people = None
    if settings.ask is not None and destination is not None:
        people = Encounters(
            robot,
            people_of_episode(arena, episode, settings, seeds.people),
            destination,
            settings.ask,
            lambda asked: tell(answer_entry(asked)),
        )
    journal = Journal(
        listener=lambda note: tell(note_entry(robot.time, note)),
        on_completion=lambda reply: robot.wait(
            settings.agent.language_model.inference_time.seconds(reply)
        ),
        limits=fair_limits(arena.site.routes),
    )
    if watcher is not None:
        watcher.begin(robot, trace)
    began = time.perf_counter()
    ended, error, interpreter_lost = _follow(
        agent,
        episode.instruction.text,
        robot,
        lambda: hand_over(
            robot,
            frozenset(settings.needs),
            episode.reference_path,
            people,
            None if captions is None else captions.in_episode(robot, journal),
        ),
        journal,
        seeds.agent,
    )
    wall_s = time.perf_counter() - began
    if robot.lost is not None:
        # Whatever the agent made of it.
        ended, error = "crash", robot.lost
    walk = robot.trajectory()
    finished = arena.finished(episode, walk, ended, settings.success_distance)
    if finished.left_floor_at is not None and robot.lost is None:
        ended, error = "crash", _off_floor(finished.left_floor_at, robot)
    trace += surroundings_entries(robot)
    trace += closing_entries(robot, walk, ended, error)
    told = episode.instruction
    asked = [] if people is None else people.asked
    strangers_s = 0.0 if people is None else people.seconds
    result = EpisodeResult(
        episode_id=episode.id,
        instruction_id=told.id,
        site=told.site,
        route=told.route,
        reference_route=told.reference_route,
        study=told.study,
        iteration=told.iteration,
        participant=told.participant,
        source=told.source,
        split=told.split,
        agent=name,
        stopped_by=ended,
        **measure_walk(finished),
        collisions=len(robot.collisions),
        duration_s=robot.time,
        wall_s=wall_s,
        api_calls=robot.calls,
        model_calls=journal.model_calls,
        tokens=journal.tokens,
        cost_usd=journal.cost_usd,
        error=error,
        person_collisions=sum(each.kind == "person" for each in robot.collisions),
        near_misses=len(robot.near_misses),
        waiting_s=robot.waiting_time,
        refused_turns=robot.refused_turns,
        inference_s=journal.inference_s,
        standing_s=round(robot.standing_time - strangers_s, 6),
        followers=told.followers,
        error_kinds=tuple(failure.kind for failure in told.failures),
        errors_of_tellings=tuple(len(each.failures) for each in episode.tellings),
        pair=told.pair,
        way_m=way.length,
        confidence=journal.confidence,
        gave_up=ended == "agent" and journal.gave_up,
        questions=len(asked),
        asked_in_vain=0 if people is None else people.in_vain,
        wrong_answers=sum(each.truth == "wrong" for each in asked),
        strangers_s=strangers_s,
        strangers_tokens=sum(each.tokens for each in asked),
        strangers_cost_usd=sum(each.cost_usd for each in asked),
        by_odometry=robot.tells_by_odometry,
        answers_left_m=tuple(
            round(float(metres), 3)
            for metres in finished.distances_to_goal([each.place for each in asked])
        )
        if asked
        else (),
    )
    return EpisodeRun(result, walk, tuple(trace), interpreter_lost)


def _off_floor(place: XY, robot: SimulatedRobot) -> str:
    x, y = place
    told = f"the walk as measured leaves the floor at ({x:.2f}, {y:.2f})"
    if robot.tells_by_odometry:
        told += ", by its odometry, which may drift; a body with pose_in_site is measured by that"
    return told


class _Ending(NamedTuple):
    stopped_by: StoppedBy
    error: str | None = None
    interpreter_lost: bool = False


def _follow(
    agent: Agent,
    text: str,
    robot: SimulatedRobot,
    handed: Callable[[], Any],
    journal: Journal,
    rng: Any,
) -> _Ending:
    """Let the agent follow; return what ended the episode and what went wrong."""
    try:
        agent.follow(text, handed(), journal, rng)
        # A body that died under an agent that caught it does not come to rest either.
        return _Ending(_as_robot_says(robot))
    except (KeyboardInterrupt, SpendingLimitReached):
        raise
    except EpisodeOver as over:
        # A program that computes for ever is over while its robot is not.
        if over.stopped_by in {"budget", "stuck"} and robot.stopped_by is None:
            return _Ending(cast(StoppedBy, over.stopped_by))
        return _Ending(_as_robot_says(robot))
    except BaseException as problem:
        where = failure_traceback(problem)
        if where:
            journal.add(TracebackNote(where))
        return _Ending(
            _outcome(problem) if robot.stopped_by is None else _as_robot_says(robot),
            failure_line(problem, agent),
            isinstance(problem, InterpreterLostError),
        )


def _outcome(problem: BaseException) -> StoppedBy:
    if isinstance(problem, LanguageModelError | DetectorError):
        return "model_error"
    return "unsafe" if isinstance(problem, ProgramError) and problem.unsafe else "crash"


def _as_robot_says(robot: SimulatedRobot) -> StoppedBy:
    return cast(StoppedBy, robot.finish())
