"""Several environments at once, in this process and in others that draw, too."""

from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
import pytest

Settings = Callable[..., dict[str, Any]]

PICTURES = {"sensors": {"width": 32, "height": 24}}


def walk(settings: dict[str, Any], mode: str, **how: Any) -> list[Any]:
    """Drive two environments for some steps, the second of which stops at once."""
    envs = gymnasium.make_vec(
        "MemoryMaze/Site-v0",
        num_envs=2,
        vectorization_mode=mode,
        vector_kwargs=how,
        **settings,
    )
    try:
        seen, told = envs.reset(seed=5)
        left = [(told["episode_id"].tolist(), *_parts(seen))]
        for actions in ([1, 0], [1, 1], [2, 1]):
            seen, reward, terminated, truncated, told = envs.step(np.array(actions))
            left.append((reward.tolist(), terminated.tolist(), *_parts(seen)))
            assert not truncated.any()
        assert "success" not in told
        return left
    finally:
        envs.close()


def _parts(seen: Any) -> tuple[list[str], float]:
    assert seen["rgb"].shape == (2, 24, 32, 3)
    return list(seen["instruction"]), float(seen["rgb"].sum())


@pytest.mark.proof
def test_it_makes_no_difference_where_environments_run(
    tiny_settings: Settings,
) -> None:
    settings = tiny_settings(**PICTURES)
    # Processes by "spawn", because this one may have drawn already.
    apart = walk(settings, "async", context="spawn")
    unshared = walk(settings, "async", context="spawn", shared_memory=False)
    here = walk(settings, "sync")
    assert here == apart == unshared
    (names, texts, _), stopped, after, _ = here
    assert len(set(names)) == 2
    assert all(len(text) > 10 for text in texts)
    assert stopped[1] == [False, True]
    # The second has begun a new episode.
    assert after[2][0] == texts[0]


def test_instructions_come_through_shared_memory_anew_each_episode(
    tiny_settings: Settings,
) -> None:
    envs = gymnasium.make_vec(
        "MemoryMaze/Site-v0",
        num_envs=1,
        vectorization_mode="async",
        vector_kwargs={"context": "spawn"},
        **tiny_settings(),
    )
    try:
        for seed in range(4):
            seen, told = envs.reset(seed=seed)
            assert list(seen["instruction"]) == told["instruction"].tolist()
        kept = seen["instruction"]
        envs.reset(options={"episode_id": "p5-1"})
        assert kept == tuple(told["instruction"])
    finally:
        envs.close()
