import numpy as np
import pytest
import shapely
from shapely import Point, union_all

from memorymaze.robot.simulation.obstacles.movables import left_standing, things
from memorymaze.robot.simulation.obstacles.placing import (
    PASSAGE,
    footprint,
    place_things,
    stretches,
)
from memorymaze.world.sites.records import Site

ALL_KINDS = tuple(left_standing())


def _placed(site: Site, count: int, seed: int, keep_free: list[tuple[float, float]]):
    wanted = things(count, ALL_KINDS)
    poses = place_things(site, wanted, keep_free, np.random.default_rng(seed))
    return [
        footprint(thing, pose)
        for thing, pose in zip(wanted, poses, strict=True)
        if pose is not None
    ]


@pytest.mark.parametrize("seed", range(4))
def test_things_seal_no_way(tiny_sites: dict[str, Site], seed: int):
    placed = 0
    for site in tiny_sites.values():
        covered = _placed(site, 8, seed, [])
        placed += len(covered)

        def parts(floor: shapely.Geometry) -> int:
            return len(shapely.get_parts(floor.buffer(-PASSAGE / 2 + 0.01)))

        before = parts(site.free_floor)
        assert parts(site.free_floor.difference(union_all(covered))) == before
    assert placed > 10


def test_things_stand_on_free_floor_away_from_doors_and_turning_points(
    builtin_sites: dict[str, Site],
):
    site = builtin_sites["university"]

    covered = _placed(site, 20, 0, [])

    assert len(covered) > 15
    for each in covered:
        assert site.free_floor.contains(each)
        assert all(each.distance(door.line) >= 0.7 for door in site.doors)
        assert all(each.distance(p.polygon) >= 0.3 for p in site.turning_points)
    assert all(
        a.distance(b) > 0.5
        for number, a in enumerate(covered)
        for b in covered[:number]
    )


def test_nothing_stands_where_it_must_stay_free(corridor_site: Site):
    kept = [(2.0, 0.0), (17.0, 0.0)]

    for seed in range(5):
        for each in _placed(corridor_site, 6, seed, kept):
            assert all(each.distance(Point(place)) >= 1.5 for place in kept)


def test_no_place_is_found_in_a_way_that_is_too_narrow(plans):
    site = plans.site(plans.corridor("c", 0, -0.6, 20, 0.6))

    assert _placed(site, 5, 0, []) == []


def test_the_same_seed_gives_the_same_places(corridor_site: Site):
    first = _placed(corridor_site, 5, 3, [])

    assert first == _placed(corridor_site, 5, 3, [])
    assert first != _placed(corridor_site, 5, 4, [])


def test_areas_are_furnished_along_their_long_axis(two_rooms: Site):
    found = stretches(two_rooms)

    assert len(found) == len(two_rooms.corridors) + len(two_rooms.areas)
    assert all(each.polygon.buffer(0.01).contains(each.line) for each in found)
