from collections.abc import Callable
from typing import cast

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.episode import run_episode
from memorymaze.evaluation.oracle import OracleAgent
from memorymaze.evaluation.plan import RunPlan
from memorymaze.robot.api import Robot


def test_the_oracle_arrives_whatever_it_is_told(
    tiny_plan: Callable[..., RunPlan],
) -> None:
    """All routes of the benchmark are driven in tests/testing/test_sites.py."""
    plan = tiny_plan("oracle")
    arenas = {name: Arena(site) for name, site in plan.sites.items()}
    for episode in plan.episodes:
        agent = OracleAgent(episode.reference_path)
        arena = arenas[episode.instruction.site]
        result = run_episode(agent, episode, arena, plan.settings).result
        assert (result.stopped_by, result.success) == ("agent", True)
        assert result.collisions == 0
        assert result.turns_in_order == 1.0


def test_the_oracle_drives_simulated_robots_only() -> None:
    someone = cast(Robot, object())
    with pytest.raises(TypeError, match="needs a SimulatedRobot, got object"):
        OracleAgent([(0, 0)]).follow("", someone, Journal(), np.random.default_rng(0))
