import math

import pytest
import shapely

from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory
from memorymaze.runs.metrics.turns import TurnAtPlace, turns_in_order, turns_taken

CROSSING = [("crossing", shapely.box(-2, -2, 2, 2))]

A, B, C = TurnAtPlace("a", "left"), TurnAtPlace("b", "right"), TurnAtPlace("c", "left")


def through(*degrees: float, x: float = 0.0) -> Trajectory:
    """Arrive at x from the west with the first heading, then face the others there."""
    poses = [TimedPose(0, x - 5, 0, math.radians(degrees[0]))]
    poses += [TimedPose(1 + n, x, 0, math.radians(d)) for n, d in enumerate(degrees)]
    return Trajectory([*poses, TimedPose(99, x + 5, 0, math.radians(degrees[-1]))])


@pytest.mark.parametrize(
    ("walk", "turns"),
    [
        pytest.param(through(0, 90), [TurnAtPlace("crossing", "left")], id="left"),
        pytest.param(through(0, -90), [TurnAtPlace("crossing", "right")], id="right"),
        pytest.param(
            through(0, 30), [TurnAtPlace("crossing", "left")], id="slight left"
        ),
        pytest.param(
            through(170, -130), [TurnAtPlace("crossing", "left")], id="past 180"
        ),
        pytest.param(through(0, 5), [], id="straight on"),
        pytest.param(through(0, 180), [], id="turning back"),
        pytest.param(through(0, 90, 0), [], id="looking left and going on"),
        pytest.param(through(0, 90, x=9), [], id="elsewhere"),
    ],
)
def test_turns_are_changes_of_heading_within_a_place(
    walk: Trajectory, turns: list[TurnAtPlace]
) -> None:
    assert turns_taken(CROSSING, walk) == turns


def test_a_place_entered_twice_gives_two_turns() -> None:
    poses = [
        *through(0, 90).poses,
        TimedPose(100, 0, 0, math.radians(90)),
        TimedPose(101, 0, 0, 0),
        TimedPose(102, 5, 0, 0),
    ]
    sides = [turn.side for turn in turns_taken(CROSSING, Trajectory(poses))]
    assert sides == ["left", "right"]


def test_turns_come_in_the_order_of_the_walk() -> None:
    places = [("late", shapely.box(8, -2, 12, 2)), *CROSSING]
    poses = [
        *through(0, 90).poses,
        *(p._replace(time=100) for p in through(0, -90, x=10).poses),
    ]
    assert turns_taken(places, Trajectory(poses)) == [
        TurnAtPlace("crossing", "left"),
        TurnAtPlace("late", "right"),
    ]


@pytest.mark.parametrize(
    ("wanted", "taken", "share"),
    [
        pytest.param([A, B, C], [A, B, C], 1, id="all"),
        pytest.param([A, B, C], [A, C], 2 / 3, id="one left out"),
        pytest.param([A, B, C], [A, A, B, A, C], 1, id="some too many"),
        pytest.param([A, B, C], [C, B, A], 1 / 3, id="backwards"),
        pytest.param(
            [A, B], [TurnAtPlace("a", "right"), B], 1 / 2, id="the wrong side"
        ),
        pytest.param([A, A], [A], 1 / 2, id="twice wanted, once taken"),
        pytest.param([A], [], 0, id="none"),
        pytest.param([], [A], 1, id="none wanted"),
    ],
)
def test_the_share_in_order_is_as_counted_by_hand(
    wanted: list[TurnAtPlace], taken: list[TurnAtPlace], share: float
) -> None:
    assert turns_in_order(wanted, taken) == pytest.approx(share)
