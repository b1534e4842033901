"""Arguments come out of the sandbox checked, results go in as plain values."""

import numpy as np
import pytest

from memorymaze.agents.code_generation.program_execution import (
    read_arguments,
    to_sandbox,
)
from memorymaze.robot.api.control import Detection, MoveResult


def test_arguments_get_their_names_and_types():
    assert read_arguments("move_forward", (2,), {}, 10) == {"distance": 2.0}
    assert read_arguments("turn", (), {"direction": "left"}, 10) == {
        "direction": "left"
    }
    assert read_arguments("stop", (), {}, 10) == {}


@pytest.mark.parametrize(
    ("args", "kwargs", "problem"),
    [
        ((), {}, "missing a required argument: 'distance'"),
        ((1, 2), {}, "too many positional arguments"),
        ((1,), {"speed": 2}, "unexpected keyword argument 'speed'"),
        (("1",), {}, "distance must be a number, not str"),
        ((True,), {}, "distance must be a number, not bool"),
        ((None,), {}, "distance must be a number, not NoneType"),
    ],
)
def test_arguments_of_another_kind_are_type_errors(args, kwargs, problem):
    with pytest.raises(TypeError, match=r"^move_forward\(\): .*" + problem):
        read_arguments("move_forward", args, kwargs, 10)


@pytest.mark.parametrize("number", [float("nan"), float("inf"), -(10**400)])
def test_numbers_must_be_finite(number):
    with pytest.raises(ValueError, match="distance must be a finite number"):
        read_arguments("move_forward", (number,), {}, 10)


def test_texts_may_be_as_long_as_the_limit():
    assert read_arguments("say", ("x" * 10,), {}, 10) == {"text": "x" * 10}
    with pytest.raises(ValueError, match="at most 10 characters, not 11"):
        read_arguments("say", ("x" * 11,), {}, 10)


def test_records_become_tuples_with_their_fields():
    box = (np.float64(1), 2.0, 3.0, np.float32(4))
    seen = to_sandbox([Detection("door", box, 1, 2.5, np.float64(-3), np.int64(7))])

    assert seen == [("door", (1.0, 2.0, 3.0, 4.0), 1, 2.5, -3.0, 7)]
    assert seen[0]._fields == tuple(Detection.__dataclass_fields__)
    assert {type(value) for value in (*seen[0], *seen[0].box)} == {
        str,
        tuple,
        int,
        float,
    }
    assert repr(to_sandbox(MoveResult(1.0, "done"))) == (
        "MoveResult(distance=1.0, reason='done')"
    )


@pytest.mark.parametrize("value", [None, True, "left", 3, 2.5, ["left"], (1, "a")])
def test_plain_values_stay_as_they_are(value):
    assert to_sandbox(value) == value
    assert type(to_sandbox(value)) is type(value)


@pytest.mark.parametrize("value", [object(), {"a": 1}, MoveResult, b"x"])
def test_what_the_api_never_returns_is_the_robots_mistake(value):
    with pytest.raises(TypeError, match="which is not part of its API"):
        to_sandbox(value)
