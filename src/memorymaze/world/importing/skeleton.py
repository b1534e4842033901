"""The skeleton of a floor: what lies equally far from two walls, as a graph.

Edges of the Voronoi diagram of points along the walls, without the spurs that lead into
corners, niches and the unevenness of walls.
"""

import math
from collections.abc import Iterator
from itertools import pairwise

import networkx as nx
import numpy as np
import shapely
from scipy.spatial import Voronoi
from shapely import MultiPolygon, Polygon

WALL_STEP = 0.2
"""Metres between two points along a wall."""
LEAST_REACH = 1.2
"""Metres that a way must reach beyond the open floor it begins in; else it is a niche."""
CORNER_REACH = 0.5
"""The same in radii of that open floor: its corners are no ways."""


def floor_skeleton(floor: Polygon | MultiPolygon) -> "nx.Graph[int]":
    """Return the skeleton of a floor without its spurs.

    Nodes have `x`, `y` and `radius`, the metres to the nearest wall. Edges have `length`
    and `parallel`: 1 between parallel walls, less the faster the floor widens there.
    """
    skeleton = _voronoi_edges(floor)
    while spurs := list(_spurs(skeleton)):
        skeleton.remove_nodes_from(spurs)
    return skeleton


def branches(skeleton: "nx.Graph[int]") -> Iterator[list[int]]:
    """Yield the ways between junctions and ends, each as nodes in their order.

    A ring without a junction begins and ends where it bends most.
    """
    ends = [node for node in skeleton if skeleton.degree(node) != 2]
    for part in nx.connected_components(skeleton):
        if all(skeleton.degree(node) == 2 for node in part):
            ends.append(
                max(part, key=lambda node: float(skeleton.nodes[node]["radius"]))
            )
    ended, walked = set(ends), set[frozenset[int]]()
    for end in ends:
        for first in skeleton.neighbors(end):
            if frozenset((end, first)) in walked:
                continue
            way = [end, first]
            while way[-1] not in ended:
                way += [node for node in skeleton.neighbors(way[-1]) if node != way[-2]]
            walked |= {frozenset(step) for step in pairwise(way)}
            yield way


def _voronoi_edges(floor: Polygon | MultiPolygon) -> "nx.Graph[int]":
    walls = shapely.segmentize(floor.boundary, WALL_STEP)
    sites = np.unique(shapely.get_coordinates(walls), axis=0)
    diagram = Voronoi(sites)
    ridges = np.asarray(diagram.ridge_vertices)
    shapely.prepare(floor)
    inside = shapely.contains_xy(floor, diagram.vertices)
    kept = (ridges >= 0).all(axis=1) & inside[ridges].all(axis=1)
    ridges, walls_of = ridges[kept], diagram.ridge_points[kept]
    skeleton: nx.Graph[int] = nx.Graph()
    for (first, second), pair in zip(ridges.tolist(), walls_of, strict=True):
        ends = diagram.vertices[[first, second]]
        near = sites[pair[0]]
        for node, (x, y) in zip((first, second), ends.tolist(), strict=True):
            radius = math.dist((x, y), near)
            skeleton.add_node(node, x=x, y=y, radius=radius)
        apart = math.dist(near, sites[pair[1]]) / 2
        parallel = min(1.0, apart / math.dist(ends.mean(axis=0), near))
        length = math.dist(*ends)
        skeleton.add_edge(first, second, length=length, parallel=parallel)
    return skeleton


def _spurs(skeleton: "nx.Graph[int]") -> Iterator[int]:
    """Yield the nodes of branches that end and hardly leave the floor they begin in."""
    for way in branches(skeleton):
        if skeleton.degree(way[0]) == 1:
            way.reverse()
        if skeleton.degree(way[-1]) != 1 or skeleton.degree(way[0]) < 3:
            continue
        begin, end = (skeleton.nodes[node] for node in (way[0], way[-1]))
        apart = math.dist((begin["x"], begin["y"]), (end["x"], end["y"]))
        reach = apart + end["radius"] - begin["radius"]
        if reach < max(LEAST_REACH, CORNER_REACH * begin["radius"]):
            yield from way[1:]
