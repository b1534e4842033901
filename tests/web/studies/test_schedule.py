from collections import Counter
from collections.abc import Callable
from itertools import pairwise

import pytest

from memorymaze.web.studies.schedule import route_orders, steps_of
from memorymaze.web.studies.study_file import RouteShown, Study

MakeStudy = Callable[..., Study]


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6])
def test_each_route_comes_equally_often_at_each_place_and_after_each_other(
    make_study: MakeStudy, count: int
) -> None:
    shown = [RouteShown(route=f"R{number}") for number in range(count)]
    design = make_study().design.model_copy(update={"routes": shown})
    orders = route_orders(design)
    assert all(len(set(order)) == count for order in orders)
    places = Counter((place, each) for o in orders for place, each in enumerate(o))
    assert len(set(places.values())) == 1
    followers = Counter(pair for order in orders for pair in pairwise(order))
    assert len(followers) == count * (count - 1)
    assert len(set(followers.values())) <= 1


def test_orders_of_some_of_the_routes_have_each_route_equally_often(
    make_study: MakeStudy,
) -> None:
    shown = [RouteShown(route=f"R{number}") for number in range(3)]
    changed = {"routes": shown, "routes_each": 2, "attention": []}
    orders = route_orders(make_study().design.model_copy(update=changed))
    assert {len(order) for order in orders} == {2}
    assert len(set(Counter(each for order in orders for each in order).values())) == 1


def test_online_participants_tell_each_route_twice(make_study: MakeStudy) -> None:
    steps = steps_of(make_study().design, ("R2", "R1"))
    assert steps == [
        "comprehension",
        "familiarity",
        "scenario",
        "tell.R2",
        "retell.R2",
        "attention.0",
        "tell.R1",
        "retell.R1",
    ]


def test_memory_has_the_video_and_a_delay_before_the_telling(
    make_study: MakeStudy,
) -> None:
    steps = steps_of(make_study("memory").design, ("R1",))
    assert [step.kind for step in steps][3:6] == ["watch", "wait", "tell"]
    at_once = make_study("memory", "delay_minutes = 0")
    kinds = [step.kind for step in steps_of(at_once.design, ("R1",))]
    assert "wait" not in kinds


def test_followers_walk_one_text_of_each_route(make_study: MakeStudy) -> None:
    steps = steps_of(make_study("follow").design, ("R2", "R1"))
    assert steps[3:] == ["follow.R2", "attention.0", "follow.R1"]
