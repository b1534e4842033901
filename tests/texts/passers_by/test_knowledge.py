import math
from collections.abc import Callable

import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.texts.passers_by import FloorKnowledge
from memorymaze.world.sites import Site

Knowing = Callable[[Site], FloorKnowledge]


@pytest.mark.parametrize(
    ("here", "goal", "start", "turns"),
    [
        pytest.param((0, -6, 90), "the library", "ahead", ["left"], id="ahead"),
        pytest.param((0, -6, 90), "the lift", "ahead", ["right"], id="other way"),
        pytest.param((0, -6, 270), "the library", "back", ["left"], id="facing away"),
        pytest.param((0, 0, 90), "the library", "left", [], id="in the junction"),
        pytest.param((5, 0, 90), "the library", "left", [], id="past junctions"),
        pytest.param((5, 0, 90), "the lift", "right", [], id="beside"),
    ],
)
def test_the_way_begins_where_one_stands_and_as_one_faces(
    knowing: Knowing,
    t_site: Site,
    here: tuple[float, float, float],
    goal: str,
    start: str,
    turns: list[str],
) -> None:
    x, y, degrees = here
    way = knowing(t_site).way_to(goal, Pose(x, y, math.radians(degrees)))
    assert way is not None
    assert way.start == start
    assert [turn.direction for turn in way.facts.route.turns] == turns
    assert way.facts.follow(way.facts.plan).arrived


@pytest.mark.proof
def test_a_way_can_be_told_from_anywhere_on_the_shipped_floors(
    knowing: Knowing, builtin_sites: dict[str, Site]
) -> None:
    for site in builtin_sites.values():
        floor = knowing(site)
        for route in site.routes[:2]:
            for share in (0.1, 0.6):
                at = route.line.interpolate(share, normalized=True)
                way = floor.way_to(route.goal, Pose(at.x, at.y, 0.0))
                assert way is not None
                assert way.facts.follow(way.facts.plan).arrived


def test_names_mean_destinations_doors_and_things(
    knowing: Knowing, t_site: Site
) -> None:
    floor = knowing(t_site)
    for words, known in (
        ("The library", "door_library"),
        ("library door", "door_library"),
        ("a red chair", "chair"),
    ):
        assert [place.id for place in floor.places_called(words)] == [known]
    assert floor.places_called("the aquarium") == ()


@pytest.mark.parametrize(
    ("degrees", "bearing"),
    [(0, "ahead"), (90, "right"), (180, "back"), (270, "left")],
)
def test_a_thing_in_sight_is_where_it_is_seen_as_one_faces(
    knowing: Knowing, t_site: Site, degrees: float, bearing: str
) -> None:
    floor = knowing(t_site)
    [chair] = floor.places_called("the red chair")
    there = floor.whereabouts(chair, Pose(0, 0.2, math.radians(degrees)))
    assert there.bearing == bearing
    assert there.metres == pytest.approx(5, abs=0.5)


def test_a_thing_round_the_corner_is_out_of_sight(
    knowing: Knowing, t_site: Site
) -> None:
    floor = knowing(t_site)
    [chair] = floor.places_called("the red chair")
    assert floor.whereabouts(chair, Pose(0, -8, 0.0)).bearing is None
