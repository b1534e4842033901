import math

import pytest
from benchmarks.ceiling import (
    Readings,
    TrueMaps,
    follow,
    in_frame,
    phrases_of,
    readings_otherwise,
)

from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.starts import starts_ahead
from memorymaze.basics.geometry.pose import Pose
from memorymaze.language.plans import Arrival, Leg, RoutePlan, Turn
from memorymaze.texts.corpus import Corpus
from memorymaze.world.sites import Site


@pytest.fixture(scope="module")
def loop_maps(loop_site: Site) -> TrueMaps:
    return TrueMaps(loop_site)


def test_a_true_map_begins_with_the_start_and_leads_everywhere(
    loop_site: Site, loop_maps: TrueMaps
) -> None:
    start = loop_site.routes[0].start
    floor = loop_maps.floor_map(start, ["yellow box"])
    assert floor.crossings[0].place == (0.0, 0.0)
    ahead = floor.stretches[0, 0]
    assert ahead.arrival == pytest.approx(0.0, abs=0.05)
    assert floor.crossings[ahead.end].place[0] > 0
    assert set(floor.distances_from(0)) == set(floor.crossings)
    assert all(each.asked == {"yellow box"} for each in floor.stretches.values())


def test_things_stand_on_a_true_map_where_they_are(
    loop_site: Site, loop_maps: TrueMaps
) -> None:
    [box] = [each for each in loop_site.landmarks if each.color == "yellow"]
    start = Pose(0.0, 0.0, math.pi / 2)
    floor = loop_maps.floor_map(start, ["yellow box", "pink elephant"])
    [seen] = floor.seen("yellow box")
    assert seen.place == pytest.approx((box.position.y, -box.position.x), abs=1.0)
    assert floor.seen("pink elephant") == []


def test_a_plan_ends_where_it_says_on_a_true_map(
    loop_site: Site, loop_maps: TrueMaps
) -> None:
    route = loop_site.routes[0]
    legs = tuple(Leg(Turn(each.direction)) for each in route.turns)
    plan = RoutePlan(legs=legs, arrival=Arrival(("drinking fountain",)))
    floor = loop_maps.floor_map(route.start, phrases_of(plan))
    model = Likelihoods()
    followed = follow(plan, floor, starts_ahead(model, floor, 0), model, set())
    assert followed.masses.sum() == pytest.approx(1.0)
    best = followed.likeliest
    assert best is not None
    assert best.reason == "drinking fountain seen"
    goal = in_frame(route.start, route.line.coords[-1])
    assert followed.share_at(goal, 3.0) > 0.5


def test_plans_that_take_other_turns_are_listed(tiny_corpus: Corpus) -> None:
    readings = Readings(tiny_corpus.sites)
    episode = next(
        each for each in tiny_corpus.episodes if not each.instruction.failures
    )
    route = tiny_corpus.sites[episode.instruction.site].find_route(
        episode.instruction.reference_route
    )
    legs = tuple(Leg(Turn(each.direction)) for each in route.turns)
    plan = RoutePlan(legs=legs, arrival=Arrival(at_end=True))
    right = readings.meaning(episode, plan, Likelihoods())
    assert right.takes_the_turns
    legs = (Leg(Turn("around"), on_the_spot=True), *plan.legs)
    back = RoutePlan(legs=legs, arrival=plan.arrival)
    wrong = readings.meaning(episode, back, Likelihoods())
    assert not wrong.is_goal
    [line] = readings_otherwise([wrong])
    assert line.startswith(episode.instruction.id)
