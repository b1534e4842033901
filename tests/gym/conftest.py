"""Environments on the tiny sites, most of them without pictures, which take seconds."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import gymnasium
import pytest

import memorymaze.gym  # noqa: F401 - registers the environments

Settings = Callable[..., dict[str, Any]]
MakeTiny = Callable[..., gymnasium.Env[Any, Any]]


@pytest.fixture
def tiny_settings(tiny_instructions: Path, tiny_sites_folder: Path) -> Settings:
    """Give the settings of an environment without pictures on a tiny site."""

    def settings(name: str = "loop", **others: Any) -> dict[str, Any]:
        plan = tiny_sites_folder / f"{name}.geojson"
        return {
            "instructions": str(tiny_instructions),
            "sensors": (),
            "site": str(plan),
            **others,
        }

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
