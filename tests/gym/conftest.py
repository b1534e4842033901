"""Environments on the tiny sites, most of them without pictures, which take seconds."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import gymnasium
import pytest

import memorymaze.gym  # noqa: F401 - registers the environments

TESTS = Path(__file__).parents[1]

TINY: dict[str, Any] = {
    "instructions": str(TESTS / "tiny_instructions.jsonl"),
    "sensors": (),
}
"""Settings of an environment on a tiny site without pictures."""

Settings = Callable[..., dict[str, Any]]
MakeTiny = Callable[..., gymnasium.Env[Any, Any]]


@pytest.fixture
def tiny_settings() -> Settings:
    """Give the settings of an environment by the name of a tiny site."""

    def settings(name: str = "loop", **others: Any) -> dict[str, Any]:
        return {**TINY, "site": str(TESTS / f"tiny_sites/{name}.geojson"), **others}

    return settings


@pytest.fixture
def make_tiny(tiny_settings: Settings) -> Iterator[MakeTiny]:
    """Make an environment by the name of a tiny site; closed after the test."""
    made: list[gymnasium.Env[Any, Any]] = []

    def make(name: str = "loop", **others: Any) -> gymnasium.Env[Any, Any]:
        made.append(
            gymnasium.make("MemoryMaze/Site-v0", **tiny_settings(name, **others))
        )
        return made[-1]

    yield make
    for each in made:
        each.close()
