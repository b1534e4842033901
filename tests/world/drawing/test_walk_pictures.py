"""Pictures of walks: whatever part of whatever plan they show, they are drawn."""

from collections.abc import Callable
from dataclasses import replace
from itertools import cycle, islice
from pathlib import Path
from xml.etree import ElementTree

import networkx as nx
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text
from numpy.typing import NDArray
from shapely import LineString, box, get_parts

from memorymaze.world.construction import BUILDING_KINDS
from memorymaze.world.drawing.plan_picture import (
    AROUND,
    draw_plan,
    draw_site,
    draw_walk,
    picture_of,
)
from memorymaze.world.drawing.shapes import bounds_of
from memorymaze.world.sites import Route, Site
from memorymaze.world.sites.navigation_graph import navigation_graph

SHIPPED = ("university", "museum_5f", "museum_7f")
WALKS = 28
"""In each of eleven buildings: 308."""
CUTTING = {
    "university": [(91.3, 32.3), (87.6, 30.7), (86.8, 32.5)],
    "museum_5f": [(12.5, 15.2), (9.0, 11.2), (5.0, 17.7)],
    "museum_7f": [(25.8, 27.0), (21.5, 27.0), (16.2, 24.4)],
}
"""Walks round which a square piece of the floor falls into parts, metres."""

Places = NDArray[np.float64]


def drawn(site: Site, route: Route, walk: Places) -> Figure:
    return draw_walk(
        site, route, walk, instruction="Go on.", outcome="?", arrived=False
    )


def along(route: Route, walk: Places) -> Route:
    """A route that describes just a walk."""
    return replace(route, line=LineString(walk))


@pytest.mark.parametrize("name", CUTTING)
def test_a_picture_may_cut_the_floor_into_pieces(
    name: str, builtin_sites: dict[str, Site]
):
    site, walk = builtin_sites[name], np.array(CUTTING[name])
    sheet = box(*bounds_of([(*walk.min(axis=0), *walk.max(axis=0))], AROUND))
    pieces = get_parts(site.walkable_floor.intersection(sheet))
    assert sum(piece.area > 0 for piece in pieces) > 1
    route = along(site.routes[0], walk)
    assert picture_of(drawn(site, route, walk)).width > 500
    assert draw_plan(site, [route], walk, (64, 48)).picture.shape == (48, 64, 3)


def test_a_picture_names_what_it_shows_and_nothing_else(
    builtin_sites: dict[str, Site],
):
    site, walk = builtin_sites["museum_5f"], np.array(CUTTING["museum_5f"])
    sheet = drawn(site, along(site.routes[0], walk), walk)
    words = [text.get_text().replace("\n", " ") for text in sheet.findobj(Text)]
    assert "Lift Lobby" in words
    assert "steel door" in words
    assert "Tiny Worlds" not in words
    assert "elevator door" not in words


@pytest.fixture(scope="module", params=[*SHIPPED, *BUILDING_KINDS])
def building(
    request: pytest.FixtureRequest,
    builtin_sites: dict[str, Site],
    made_building: Callable[[str], Site],
) -> Site:
    """A shipped building, or one of each kind that was made."""
    return builtin_sites.get(request.param) or made_building(request.param)


@pytest.mark.proof
def test_a_walk_between_any_places_of_a_building_is_drawn(
    building: Site, tmp_path: Path
):
    rng = np.random.default_rng(0)
    graph = navigation_graph(building)
    at = {each.id: (each.x, each.y) for each in graph.viewpoints}
    net = nx.Graph((one, to.id) for one in at for to in graph.neighbours[one])
    path = tmp_path / "walk.svg"
    for number, route in enumerate(islice(cycle(building.routes), WALKS)):
        ends = rng.choice(sorted(at), 2)
        walk = np.array([at[each] for each in nx.shortest_path(net, *ends)])
        match number % 4:
            case 0:
                draw_site(building, path, trajectories=[walk])
                ElementTree.parse(path)
            case 1:
                drawn(building, route, walk).draw_without_rendering()
            case _:
                drawn(building, along(route, walk), walk).draw_without_rendering()
