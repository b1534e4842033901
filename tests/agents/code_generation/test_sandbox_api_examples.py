"""What the prompts show of the control API are programs that run."""

import contextlib
import doctest
import inspect
from collections.abc import Callable

import pytest

from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import EpisodeOver
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.specification import API_NAMES


@pytest.mark.parametrize("name", API_NAMES)
def test_the_example_of_each_function_runs_and_calls_it(
    name: str, make_robot: Callable[..., Robot]
) -> None:
    text = inspect.getdoc(getattr(Robot, name)) or ""
    examples = doctest.DocTestParser().get_examples(text)
    robot = make_robot()
    with contextlib.suppress(EpisodeOver):
        run_program("".join(each.source for each in examples), robot)
    assert name in robot.names
