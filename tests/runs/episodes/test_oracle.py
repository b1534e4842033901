from collections.abc import Callable

from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.episode import run_episode
from memorymaze.runs.episodes.guarded_robot import OracleAgent
from memorymaze.runs.episodes.plan import RunPlan


def test_the_oracle_arrives_whatever_it_is_told(
    tiny_plan: Callable[..., RunPlan],
) -> None:
    """All routes of the benchmark are driven in tests/testing/test_sites.py."""
    plan = tiny_plan("oracle")
    arenas = {name: Arena(site) for name, site in plan.sites.items()}
    for episode in plan.episodes:
        arena = arenas[episode.instruction.site]
        result = run_episode(OracleAgent(), episode, arena, plan.settings).result
        assert (result.stopped_by, result.success) == ("agent", True)
        assert result.collisions == 0
        assert result.turns_in_order == 1.0
