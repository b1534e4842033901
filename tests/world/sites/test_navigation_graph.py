import re
from dataclasses import replace

import numpy as np
import pytest
from shapely import LineString, Point, Polygon

from memorymaze.basics.errors import SitePlanError
from memorymaze.world.sites import Site
from memorymaze.world.sites.navigation_graph import NavigationGraph, navigation_graph


@pytest.fixture(scope="module")
def graphs(
    builtin_sites: dict[str, Site], tiny_sites: dict[str, Site]
) -> list[tuple[Site, NavigationGraph]]:
    sites = [*builtin_sites.values(), *tiny_sites.values()]
    return [(site, navigation_graph(site)) for site in sites]


Graphs = list[tuple[Site, NavigationGraph]]


def test_every_viewpoint_reaches_every_other(graphs: Graphs):
    for site, graph in graphs:
        reached, ahead = set(), [graph.viewpoints[0]]
        while ahead:
            here = ahead.pop()
            if here.id not in reached:
                reached.add(here.id)
                ahead += graph.neighbours[here.id]
        assert len(reached) == len(graph.viewpoints), site.name


def test_two_viewpoints_are_joined_exactly_when_the_way_is_short_and_free(
    tiny_sites: dict[str, Site],
):
    for site in tiny_sites.values():
        graph = navigation_graph(site)
        free = site.free_floor.buffer(-0.25, join_style="mitre").buffer(1e-6)
        for first, one in enumerate(graph.viewpoints):
            for second in range(first + 1, len(graph.viewpoints)):
                line = LineString([one[1:], graph.viewpoints[second][1:]])
                expected = line.length <= 5.0 and free.covers(line)
                assert ((first, second) in graph.edges) == expected, (site.name, line)


def test_a_robot_can_drive_along_every_edge(graphs: Graphs):
    for site, graph in graphs:
        walls = site.free_floor.boundary
        for first, second in graph.edges:
            line = LineString([graph.viewpoints[i][1:] for i in (first, second)])
            assert site.free_floor.contains(line), site.name
            assert walls.distance(line) > 0.249, site.name
            assert line.length <= 5.0, site.name


def test_viewpoints_stand_close_together_along_centre_lines(graphs: Graphs):
    for site, graph in graphs:
        spots = np.array([each[1:] for each in graph.viewpoints])
        for corridor in site.corridors:
            line = corridor.centre_line
            for along in np.arange(0.6, line.length - 0.6, 0.25):
                point = line.interpolate(along)
                nearest = np.hypot(*(spots - (point.x, point.y)).T).min()
                assert nearest <= 2.25, (site.name, corridor.id, along)


def test_every_turning_point_and_area_has_a_viewpoint(graphs: Graphs):
    for site, graph in graphs:
        for place in (*site.turning_points, *site.areas):
            near = place.polygon.buffer(1.0)
            assert any(near.contains(Point(each[1:])) for each in graph.viewpoints), (
                site.name,
                place.id,
            )


def test_ids_are_those_of_r2r_and_the_same_every_time(loop_site: Site):
    graph = navigation_graph(loop_site)
    ids = [each.id for each in graph.viewpoints]
    assert all(re.fullmatch("[0-9a-f]{32}", each) for each in ids)
    assert len(set(ids)) == len(ids)
    assert navigation_graph(loop_site) == graph
    other = navigation_graph(replace(loop_site, name="other"))
    assert not set(ids) & {each.id for each in other.viewpoints}


def test_an_obstacle_across_the_hall_is_walked_round(two_rooms: Site):
    table = next(thing for thing in two_rooms.landmarks if thing.id == "table")
    wide = replace(table, position=Point(3, 3), size=(4.6, 0.5, 1.0), heading=0.0)
    site = replace(two_rooms, landmarks=(wide,))
    graph = navigation_graph(site)
    west = graph.nearest(0.5, 3)
    assert west.x < 2.5
    assert graph.neighbours[west.id]


def test_floor_the_robot_cannot_reach_has_no_viewpoint(two_rooms: Site):
    table = next(thing for thing in two_rooms.landmarks if thing.id == "table")
    block = replace(table, position=Point(9, 3), size=(3.0, 3.0, 1.0), heading=0.0)
    graph = navigation_graph(replace(two_rooms, landmarks=(block,)))
    sides = {each.x < 9 for each in graph.viewpoints}
    assert len(sides) == 1


def test_a_floor_too_narrow_for_the_robot_is_an_error(corridor_site: Site):
    [corridor] = corridor_site.corridors
    narrow = Polygon([(0, 0), (20, 0), (20, 0.4), (0, 0.4)])
    site = replace(corridor_site, corridors=(replace(corridor, polygon=narrow),))
    with pytest.raises(SitePlanError, match=r"robot of 0\.50 m fits on, got none"):
        navigation_graph(site)


def test_connectivity_has_the_shape_of_r2r(t_site: Site):
    graph = navigation_graph(t_site)
    entries = graph.connectivity()
    assert [entry["image_id"] for entry in entries] == [v.id for v in graph.viewpoints]
    joined = np.array([entry["unobstructed"] for entry in entries])
    assert joined.dtype == bool
    assert np.array_equal(joined, joined.T)
    assert joined.sum() == 2 * len(graph.edges)
    pose = entries[0]["pose"]
    assert isinstance(pose, list)
    assert [pose[i] for i in (3, 7, 11)] == [*graph.viewpoints[0][1:], 1.25]
    assert len(pose) == 16
