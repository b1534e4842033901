import math

from hypothesis import given
from hypothesis import strategies as st

from memorymaze.robot.perception import SingleSighting, Tracker


def door(x: float, y: float = 1.5) -> SingleSighting:
    return SingleSighting("door", (x, y), 0.9)


def test_thing_keeps_its_number_after_a_detour() -> None:
    tracker = Tracker()
    first = tracker.update([door(3.0)])
    tracker.update([door(20.0), door(30.0)])
    assert tracker.update([door(3.1)]) == first


def test_long_thing_may_seem_to_move_more_than_a_small_one() -> None:
    tracker = Tracker()
    tracker.update([SingleSighting("mural", (0.0, 0.0), 3.6)])
    assert tracker.update([SingleSighting("mural", (1.5, 0.0), 3.6)]) == [1]
    tracker.update([SingleSighting("bin", (0.0, 0.0), 0.4)])
    assert tracker.update([SingleSighting("bin", (0.5, 0.0), 0.4)]) == [3]


def test_other_kind_in_the_same_place_is_another_thing() -> None:
    tracker = Tracker()
    assert tracker.update([door(3.0), SingleSighting("sign", (3.0, 1.5), 0.3)]) == [
        1,
        2,
    ]


def test_nearest_track_wins_whatever_the_order() -> None:
    tracker = Tracker()
    tracker.update([door(3.0), door(3.4)])
    assert tracker.update([door(3.41), door(3.01)]) == [2, 1]


places = st.floats(-50, 50, allow_nan=False)


@given(st.lists(st.tuples(places, places), max_size=8))
def test_things_of_one_look_are_all_different(
    points: list[tuple[float, float]],
) -> None:
    tracker = Tracker()
    sightings = [door(x, y) for x, y in points]
    for _ in range(2):
        numbers = tracker.update(sightings)
        assert len(set(numbers)) == len(sightings)


@given(st.lists(st.tuples(places, places), max_size=8))
def test_things_apart_keep_their_numbers_in_any_order(
    points: list[tuple[float, float]],
) -> None:
    apart: list[tuple[float, float]] = []
    for point in points:
        if all(math.dist(point, other) > 0.5 for other in apart):
            apart.append(point)
    tracker = Tracker()
    numbers = dict(
        zip(apart, tracker.update([door(x, y) for x, y in apart]), strict=True)
    )
    again = sorted(apart)
    assert tracker.update([door(x, y) for x, y in again]) == [
        numbers[point] for point in again
    ]
