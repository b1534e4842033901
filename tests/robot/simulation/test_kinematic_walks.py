from collections.abc import Callable, Iterator

import numpy as np
import pytest

from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.runs.episodes.arena import arenas_of
from memorymaze.runs.episodes.episode import EpisodeRun, run_episode
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.settings import RunSettings
from memorymaze.runs.episodes.trace_entries import CallEntry
from memorymaze.texts.corpus import Corpus

Pairs = Iterator[tuple[EpisodeRun, EpisodeRun]]
BESIDE = 0.1
"""Metres between the two robots after the same way, at most."""


def runs(plan: RunPlan) -> list[EpisodeRun]:
    arenas = arenas_of(plan.settings, plan.sites)
    return [
        run_episode(
            plan.ready.in_episode(each),
            each,
            arenas[each.instruction.site],
            plan.settings,
        )
        for each in plan.episodes
    ]


def both(agent: str, corpus: Corpus | None = None, **choices: object) -> Pairs:
    """Have an agent walk with physics and without."""
    walks = [
        runs(
            plan_run(
                agent,
                corpus,
                with_choices(RunSettings(), {"motion": motion, **choices}),
            )
        )
        for motion in ("physics", "kinematic")
    ]
    return zip(*walks, strict=True)


def outcome(run: EpisodeRun) -> tuple[object, ...]:
    return run.result.episode_id, run.result.success, run.result.stopped_by


def calls(run: EpisodeRun) -> list[str]:
    return [each.call for each in run.trace if isinstance(each, CallEntry)]


def apart(walk: Trajectory, other: Trajectory) -> float:
    """Return how far two walks ever are apart, metres, at equal lengths driven."""
    at = np.arange(0.0, min(walk.length, other.length), 0.1)
    places: list[np.ndarray] = []
    for each in (walk, other):
        steps = np.hypot(*np.diff(each.points, axis=0).T)
        along = np.concatenate([[0.0], np.cumsum(steps)])
        places.append(
            np.column_stack([np.interp(at, along, xs) for xs in each.points.T])
        )
    return float(np.hypot(*(places[0] - places[1]).T).max(initial=0.0))


def test_without_physics_the_oracle_walks_the_same(tiny_corpus: Corpus) -> None:
    for physics, kinematic in both("oracle", tiny_corpus):
        assert outcome(kinematic) == outcome(physics)
        assert calls(kinematic) == calls(physics)
        assert apart(kinematic.trajectory, physics.trajectory) < BESIDE
        assert kinematic.result.collisions == 0


@pytest.mark.proof
def test_without_physics_the_guide_decides_the_same(tiny_corpus: Corpus) -> None:
    alike = 0
    for physics, kinematic in both("guide", tiny_corpus):
        assert outcome(kinematic) == outcome(physics)
        if calls(kinematic) == calls(physics):
            alike += 1
            assert apart(kinematic.trajectory, physics.trajectory) < BESIDE
    # What is just in sight may not be from a centimetre away, as with another seed.
    assert alike >= 10


@pytest.mark.proof
def test_the_same_seed_gives_the_same_kinematic_walk(
    tiny_plan: Callable[..., RunPlan],
) -> None:
    plan = tiny_plan("guide", motion="kinematic")
    assert [each.trajectory for each in runs(plan)] == [
        each.trajectory for each in runs(plan)
    ]


@pytest.mark.proof
def test_along_the_routes_of_the_shipped_sites_the_walks_are_the_same() -> None:
    for physics, kinematic in both("oracle", limit=12):
        assert outcome(kinematic) == outcome(physics)
        assert calls(kinematic) == calls(physics)
        assert apart(kinematic.trajectory, physics.trajectory) < BESIDE


@pytest.mark.proof
def test_the_guide_fares_alike_without_physics_on_the_shipped_sites() -> None:
    for physics, kinematic in both("guide", limit=12, time_budget=1200.0):
        assert outcome(kinematic) == outcome(physics)
        if calls(kinematic) == calls(physics):
            assert apart(kinematic.trajectory, physics.trajectory) < BESIDE
