"""A site as a map for ROS 2: grid, route graph, and what is where, in the frame `map`."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from shapely import Point, Polygon, contains_xy, prepare, union_all
from shapely.ops import nearest_points

from memorymaze.basics.durable_files import as_json, write_new_folder
from memorymaze.basics.options import check_number
from memorymaze.world.exporting.named_meshes import Attributes, feature_attributes
from memorymaze.world.sites.navigation_graph import (
    NavigationGraph,
    navigation_graph,
    standing_floor,
)
from memorymaze.world.sites.records import Door, Landmark, Room, Site, TurningPoint
from memorymaze.world.sites.solids import WALL_THICKNESS

RESOLUTION = 0.05
"""Metres per pixel, unless told otherwise."""
FINEST, COARSEST = 0.01, 0.5
FREE, OCCUPIED, UNKNOWN = 254, 0, 205
"""Shades of grey that `map_server` takes for free, occupied and unknown, with the
thresholds below: 205 is 0.19608 dark, which must not be less than `free_thresh`."""
MARGIN = 1.0
"""Metres of unknown round the building."""
FRAME = "map"


def write_ros_map(site: Site, out: Path, resolution: float = RESOLUTION) -> list[Path]:
    """Write a folder with `map.yaml`, `map.pgm`, `graph.geojson`, `semantics.geojson`."""
    check_number("--resolution", resolution, least=FINEST, most=COARSEST)
    graph = navigation_graph(site)
    image, west, south = _grid(site, resolution)
    contents = {
        "map.yaml": _yaml(west, south, resolution),
        "map.pgm": image,
        "graph.geojson": _json(site, _graph_features(site, graph)),
        "semantics.geojson": _json(site, _semantic_features(site, graph)),
    }
    return write_new_folder(out, contents)


def _grid(site: Site, resolution: float) -> tuple[bytes, float, float]:
    """Return a PGM file, and where its lower left corner is, metres."""
    floor, free = site.walkable_floor, site.free_floor
    # In coarse grids walls are thicker than in the building, or they had gaps.
    thickness = max(WALL_THICKNESS, 1.5 * resolution)
    around = floor.buffer(thickness, join_style="mitre")
    solid = union_all([
        around.difference(floor),
        *(each.footprint for each in site.landmarks if each.obstacle),
    ])
    west, south, east, north = around.buffer(MARGIN).bounds
    west, south = (math.floor(each / resolution) * resolution for each in (west, south))
    xs = np.arange(west, east, resolution) + resolution / 2
    ys = np.arange(south, north, resolution)[::-1] + resolution / 2
    pixels = np.full((len(ys), len(xs)), UNKNOWN, dtype=np.uint8)
    for shape, shade in ((free, FREE), (solid, OCCUPIED)):
        prepare(shape)
        pixels[contains_xy(shape, *np.meshgrid(xs, ys))] = shade
    header = f"P5\n{len(xs)} {len(ys)}\n255\n".encode()
    return header + pixels.tobytes(), west, south


def _yaml(west: float, south: float, resolution: float) -> bytes:
    return (
        "image: map.pgm\n"
        "mode: trinary\n"
        f"resolution: {resolution}\n"
        f"origin: [{west:.3f}, {south:.3f}, 0.0]\n"
        "negate: 0\n"
        "occupied_thresh: 0.65\n"
        "free_thresh: 0.196\n"
    ).encode()


def _graph_features(site: Site, graph: NavigationGraph) -> Iterator[dict[str, Any]]:
    """Yield nodes, then edges both ways, with the members Nav2's Route Server reads.

    Its loader takes points for nodes and lines for edges, and fails at a null.
    """
    for number, viewpoint in enumerate(graph.viewpoints):
        here = Point(viewpoint.x, viewpoint.y)
        parts = (*site.turning_points, *site.areas, *site.corridors)
        near = [each.id for each in parts if each.polygon.distance(here) < 0.01]
        yield _feature(
            {"type": "Point", "coordinates": [viewpoint.x, viewpoint.y]},
            id=number,
            frame=FRAME,
            metadata={"viewpoint": viewpoint.id, "part_of": near},
        )
    both_ways = sorted({*graph.edges, *((b, a) for a, b in graph.edges)})
    for number, (start, end) in enumerate(both_ways, start=len(graph.viewpoints)):
        ends = [graph.viewpoints[start], graph.viewpoints[end]]
        line = [[each.x, each.y] for each in ends]
        yield _feature(
            {"type": "MultiLineString", "coordinates": [line]},
            id=number,
            startid=start,
            endid=end,
            overridable=True,
            metadata={"length": math.dist(*line)},
        )


def _semantic_features(site: Site, graph: NavigationGraph) -> Iterator[dict[str, Any]]:
    """Yield turning points, rooms, doors and things, and where to stand for each.

    `stand` is a pose on free floor that looks at it; `node` is the graph's nearest.
    """
    standing = standing_floor(site)
    attributes = feature_attributes(site)
    doors = {door.room: door for door in reversed(site.doors)}
    for each in (*site.turning_points, *site.rooms, *site.doors, *site.landmarks):
        told = dict(attributes[each.id])
        geometry = told.pop("geometry")
        # One enters a room by its door, so one stands before that.
        looked_at = doors.get(each.id, each) if isinstance(each, Room) else each
        yield _feature(geometry, **told, **_stand_at(looked_at, standing, graph))


def _stand_at(
    each: TurningPoint | Room | Door | Landmark,
    standing: Polygon,
    graph: NavigationGraph,
) -> Attributes:
    if isinstance(each, (TurningPoint, Room)):
        aim = each.polygon.centroid
    else:
        aim = each.line.centroid if isinstance(each, Door) else each.position
    place, _ = nearest_points(standing, aim)
    ahead = math.atan2(aim.y - place.y, aim.x - place.x)
    stand = {"x": place.x, "y": place.y, "yaw": ahead}
    nearest = graph.viewpoints.index(graph.nearest(place.x, place.y))
    if isinstance(each, TurningPoint):
        # One stands in it, and may look any way.
        del stand["yaw"]
    return {"stand": stand, "node": nearest, "frame": FRAME}


def _feature(geometry: object, **properties: object) -> dict[str, Any]:
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def _json(site: Site, features: Iterator[dict[str, Any]]) -> bytes:
    return as_json({
        "type": "FeatureCollection",
        "name": site.name,
        "features": list(features),
    })
