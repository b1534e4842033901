"""What the guide does next, by how likely ways and places are and how far away."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from memorymaze.agents.guide.alignments import AssumedStart, Frontier, Segment
from memorymaze.agents.guide.arriving import Ending
from memorymaze.agents.guide.choosing import Choice
from memorymaze.agents.walking.floor_map import Point, Sighting
from memorymaze.language.plans import Leg, RoutePlan, Turn

PLAN = RoutePlan(legs=(Leg(Turn("left")), Leg(Turn("right"))))
WAY_ON = 1


def _place(at: int, place: Point, mass: float, *, is_seen: bool = True) -> Ending:
    seen = Sighting("desk", "desk", 1.0, place, place, 2.0, at, (0, 0), "left")
    told = np.array([[mass], [0.0]])
    segment = Segment(at, 0.0, 2, told)
    return Ending(
        at, None, 0.0, place, told, segment, seen if is_seen else None, "desk seen"
    )


def _choice(
    *places: Ending, way_on: float, metres: dict[int, float], walked: float = 30.0
) -> Choice:
    """Choose at crossing 1, from where the way on begins; metres are from there.

    Places are twenty metres from where the walk began.
    """
    tellings = SimpleNamespace(
        endings=list(places),
        frontiers={(WAY_ON, 0): Frontier(WAY_ON, 0, mass=way_on)},
        total=1.0,
        names_at_once=("desk",),
        is_told=True,
        all=[SimpleNamespace(starts=[AssumedStart(0, 0.0, 0, 1.0)])],
    )
    distances = {WAY_ON: metres, 0: dict.fromkeys(metres, 20.0)}
    walker = SimpleNamespace(
        at=WAY_ON, travelled=walked, map=SimpleNamespace(distances_from=distances.get)
    )
    choice = Choice([PLAN], cast(Any, tellings), cast(Any, walker), goes_back=True)
    choice.update()
    return choice


def test_it_goes_to_the_likelier_of_two_places_however_far() -> None:
    near, far = _place(2, (0.0, 0.0), 0.30), _place(3, (40.0, 0.0), 0.35)
    choice = _choice(near, far, way_on=0.02, metres={1: 0.0, 2: 2.0, 3: 42.0})
    assert choice.best() is far


def test_what_is_believed_of_a_place_counts_together_whatever_was_seen_there() -> None:
    seen, unseen = _place(2, (0.0, 0.0), 0.3), _place(3, (2.5, 0.0), 0.2, is_seen=False)
    beyond = _place(4, (5.0, 0.0), 0.1, is_seen=False)
    metres = {1: 0.0, 2: 1.0, 3: 3.5, 4: 6.0}
    choice = _choice(seen, unseen, beyond, way_on=0.3, metres=metres)
    assert choice.best() is seen
    assert choice.chance(seen) == pytest.approx(0.6)


@pytest.mark.parametrize(
    ("place", "way_on", "walked", "stops"),
    [
        pytest.param(0.4, 0.3, 30.0, False, id="in time"),
        pytest.param(0.4, 0.3, 60.0, True, id="late"),
        pytest.param(0.25, 0.3, 60.0, False, id="late, the way on being worth more"),
        pytest.param(0.15, 0.1, 60.0, False, id="late, no place that it would claim"),
    ],
)
def test_it_walks_on_past_its_time_only_for_what_is_worth_more_than_the_place(
    place: float, way_on: float, walked: float, stops: bool
) -> None:
    ending = _place(2, (10.0, 0.0), place)
    metres = {1: 0.0, 2: 10.0}
    choice = _choice(ending, way_on=way_on, metres=metres, walked=walked)
    assert (choice.best() is ending) == stops


def test_however_likely_the_way_on_it_ends_where_no_time_is_left() -> None:
    ending = _place(2, (10.0, 0.0), 0.3)
    choice = _choice(ending, way_on=0.6, metres={1: 0.0, 2: 10.0}, walked=900.0)
    assert choice.best() is ending
