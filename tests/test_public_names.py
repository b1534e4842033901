import subprocess
import sys

import pytest

import memorymaze

PUBLIC = """
Agent AgentSettings Comparison Corpus Episode Instruction Journal ModelSettings
ObstacleSettings Robot Run RunSettings SimulationSettings Site SteppingRobot Table Walk __version__ compare
evaluate export_site follow import_site load_corpus load_run load_site make_building make_robot
"""
"""The front door. Whoever takes a name from here breaks users' programs."""


def test_the_front_door_has_these_names_and_no_others() -> None:
    assert sorted(memorymaze.__all__) == sorted(PUBLIC.split())


def test_every_public_name_is_there_and_is_documented() -> None:
    for name in PUBLIC.split():
        assert getattr(memorymaze, name) is not None
        assert name in dir(memorymaze)
        if not name.startswith("__"):
            assert getattr(memorymaze, name).__doc__, name


def test_importing_the_package_loads_nothing_that_takes_time() -> None:
    program = "import memorymaze, sys; print(*sorted(sys.modules))"
    loaded = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout.split()
    assert not {"numpy", "mujoco", "shapely", "matplotlib", "openai"} & set(loaded)


def test_a_name_that_is_not_there_is_said_to_be_missing() -> None:
    with pytest.raises(AttributeError, match="'follows'"):
        memorymaze.follows  # noqa: B018
