import math

import pytest

from memorymaze.perception.turning_points.junctions import (
    SensedWay,
    is_turning_point,
    is_worth_telling,
)


def ways(*degrees: float) -> list[SensedWay]:
    return [
        SensedWay(
            2 * math.cos(math.radians(each)),
            2 * math.sin(math.radians(each)),
            math.radians(each),
            2.4,
        )
        for each in degrees
    ]


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [
        pytest.param([], False, id="nothing"),
        pytest.param([90], False, id="dead end"),
        pytest.param([0, 180], False, id="corridor"),
        pytest.param([0, 170], False, id="hardly a bend"),
        pytest.param([0, 160], True, id="bend"),
        pytest.param([0, 90], True, id="corner"),
        pytest.param([0, 90, 180], True, id="T"),
    ],
)
def test_turning_points_are_bends_and_more(
    degrees: list[float], expected: bool
) -> None:
    assert is_turning_point(ways(*degrees)) == expected


def test_straight_on_alone_is_not_told() -> None:
    (back, on, aside) = ways(180, 5, 60)
    assert not is_worth_telling([], back)
    assert not is_worth_telling([on], back)
    assert is_worth_telling([aside], back)
    assert is_worth_telling([on, aside], back)
    assert is_worth_telling([on], None)
