"""Sites as OpenDRIVE, judged by the reader that CARLA's client has.

`python -m benchmarks.opendrive [--made 5] [--lanes driving]` prints a Markdown table of
the shipped floors, made ones of every kind, and imported ones. It needs the package
`carla`, and no server.

CARLA's `get_topology` and `generate_waypoints` only know lanes of type `driving`, so
what leads where is asked of `Waypoint.next` at the end of every lane, whatever its type.
`Waypoint.lane_width` is across the road's line, and a waypoint looks along its lane.
"""

import argparse
import math
import os
import sys
import tempfile
import zipfile
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, permutations, product
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import carla
import networkx as nx
import numpy as np
import shapely
from shapely import LineString, Polygon, STRtree, union_all
from shapely.geometry.base import BaseGeometry

from memorymaze.world.construction import BUILDING_KINDS, make_building
from memorymaze.world.exporting.opendrive import LANE_TYPES, LaneType, opendrive
from memorymaze.world.importing import import_site
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Site, load_site
from memorymaze.world.sites.navigation_graph import navigation_graph

SAMPLE = 0.25
"""Metres along a lane between the places where CARLA is asked for its borders."""
JUST = 1e-3
"""Metres before and behind a place where a lane may change."""
ON_ROUTE = 0.1
"""Metres between the points of a route, and of an edge of the navigation graph."""
ON_LANE = 0.05
"""Metres that a point may lie beside a lane and count as on it."""
EXAMPLES = Path(__file__).parents[1] / "tests" / "world" / "importing" / "data"

Way = tuple[int, int, int]
"""A road, a junction and a road."""
Pair = tuple[int, int]
"""Roads or junctions."""


@dataclass(frozen=True)
class CarlaLane:
    """A lane as CARLA reads it, in the site's frame."""

    road: int
    number: int
    junction: int | None
    kind: str
    floor: BaseGeometry
    leads_to: frozenset[tuple[int, int]]
    """Roads and lanes that follow at its end, the way one goes on it."""


class CarlaReading:
    """What CARLA's client makes of an OpenDRIVE text."""

    def __init__(self, name: str, xodr: str) -> None:
        """Read it; what the reader says meanwhile, of which it prints, is `said`."""
        with tempfile.TemporaryFile() as told:
            kept = [os.dup(handle) for handle in (1, 2)]
            sys.stdout.flush()
            for handle in (1, 2):
                os.dup2(told.fileno(), handle)
            try:
                self.map = carla.Map(name, xodr)
            finally:
                for handle, before in zip((1, 2), kept, strict=True):
                    os.dup2(before, handle)
                    os.close(before)
            told.seek(0)
            self.said = told.read().decode(errors="replace").strip()
        self._roads = ElementTree.fromstring(xodr).findall("road")

    @cached_property
    def lanes(self) -> list[CarlaLane]:
        """All lanes."""
        return [lane for road in self._roads for lane in self._lanes_of(road)]

    @cached_property
    def floor(self) -> Any:
        """What all lanes cover together."""
        return union_all([lane.floor for lane in self.lanes])

    @cached_property
    def pieces(self) -> dict[int, Any]:
        """Floor of each road that is in no junction, and of each junction, by id."""
        found: dict[int, list[BaseGeometry]] = defaultdict(list)
        for lane in self.lanes:
            found[lane.junction or lane.road].append(lane.floor)
        # CARLA's numbers are single precision, which leaves cracks between lanes.
        return {piece: union_all(parts).buffer(JUST) for piece, parts in found.items()}

    @cached_property
    def ways(self) -> set[Way]:
        """From which road one gets through which junction to which other."""
        lanes = {(lane.road, lane.number): lane for lane in self.lanes}
        found: set[Way] = set()
        for lane in self.lanes:
            if lane.junction is not None:
                continue
            for through in (lanes[each] for each in lane.leads_to):
                if through.junction is None:
                    continue
                for road, _ in through.leads_to:
                    if road != through.road:
                        found.add((lane.road, through.junction, road))
        return found

    @cached_property
    def links(self) -> set[frozenset[int]]:
        """Pieces between which a lane leads."""
        piece = {each.road: each.junction or each.road for each in self.lanes}
        pairs = {(each.road, road) for each in self.lanes for road, _ in each.leads_to}
        return {frozenset((piece[one], piece[other])) for one, other in pairs}

    def beside_lane(self, x: float, y: float, kind: carla.LaneType) -> float:
        """Return how far CARLA's own answer for a point lies beside its lane, metres."""
        here = carla.Location(x=x, y=-y, z=0.0)
        found = self.map.get_waypoint(here, project_to_road=True, lane_type=kind)
        assert found is not None  # projected to a road
        away = found.transform.location.distance(here)
        return max(0.0, away - found.lane_width / 2)

    def _lanes_of(self, road: ElementTree.Element) -> Iterator[CarlaLane]:
        number, length = int(road.attrib["id"]), float(road.attrib["length"])
        stops = {float(each.attrib["s"]) for each in road.iter("laneOffset")}
        stops |= {float(each.attrib["sOffset"]) for each in road.iter("width")}
        places = {
            min(max(at + by, JUST), length - JUST)
            for at in stops
            for by in (-JUST, JUST)
        }
        steps = math.ceil(length / SAMPLE) + 1
        places |= set(np.linspace(JUST, length - JUST, steps).tolist())
        for lane in (int(each.attrib["id"]) for each in road.iter("lane")):
            if lane == 0:
                continue
            points = [
                self.map.get_waypoint_xodr(number, lane, at) for at in sorted(places)
            ]
            borders = [_borders(each, road) for each in points]
            quads = [
                shapely.convex_hull(shapely.multipoints([*one, *other]))
                for one, other in pairwise(borders)
            ]
            last = points[-1 if lane < 0 else 0]
            assert last is not None  # the places are on the road
            yield CarlaLane(
                number,
                lane,
                last.junction_id if last.is_junction else None,
                str(last.lane_type),
                union_all([each for each in quads if isinstance(each, Polygon)]),
                frozenset((each.road_id, each.lane_id) for each in last.next(2 * JUST)),
            )


def _borders(point: Any, road: ElementTree.Element) -> list[tuple[float, float]]:
    """Return both ends of a line across a lane, in the site's frame."""
    place, half = point.transform.location, point.lane_width / 2
    stretches = list(road.iter("geometry"))
    under = [each for each in stretches if float(each.attrib["s"]) <= point.s]
    begin, heading = (float(under[-1].attrib[name]) for name in ("s", "hdg"))
    for arc in under[-1].iter("arc"):
        heading += float(arc.attrib["curvature"]) * (point.s - begin)
    aside = half * math.sin(heading), half * math.cos(heading)
    return [(place.x + side * aside[0], -place.y - side * aside[1]) for side in (-1, 1)]


@dataclass(frozen=True)
class OpenDriveVerdict:
    """How a site fares in CARLA's reader."""

    site: str
    said: str
    """What the reader printed; empty when all is well."""
    kilobytes: float
    roads: int
    junctions: int
    covered: float
    """Share of the walkable floor that is on a lane."""
    outside: float
    """Square metres of lanes beyond the walkable floor and 2 cm around it."""
    off_lane: float
    """Metres between any point of a reference route and the nearest lane, at most."""
    off_answer: float
    """The same of the lane that CARLA names for the point, the one whose middle is
    nearest, though the point may lie beside that and on another."""
    other_answers: float
    """Share of the points that lie more than 5 cm beside the lane that CARLA names."""
    ways: int
    """From how many roads one gets through a junction to how many others."""
    missing: frozenset[Way]
    """Ways that the navigation graph has and the map lacks."""
    extra: frozenset[Way]
    """Ways that the map has and the navigation graph lacks."""
    beside: frozenset[Pair]
    """Pieces between which the graph's edges lead without a way of the map."""


def judge(site: Site, lanes: LaneType = "sidewalk") -> OpenDriveVerdict:
    """Export a site, let CARLA read it, and compare."""
    xodr = opendrive(site, lanes)
    reading = CarlaReading(site.name, xodr)
    floor = site.walkable_floor
    points = [
        (place.x, place.y)
        for route in site.routes
        if route.role == "reference"
        for at in np.arange(0.0, route.line.length + ON_ROUTE, ON_ROUTE)
        for place in [route.line.interpolate(at)]
    ]
    kind = carla.LaneType.Sidewalk if lanes == "sidewalk" else carla.LaneType.Any
    shapely.prepare(reading.floor)
    walked, beside = graph_ways(site, reading)
    off_answers = [reading.beside_lane(*each, kind) for each in points] or [0.0]
    return OpenDriveVerdict(
        site=site.name,
        said=reading.said,
        kilobytes=len(xodr.encode()) / 1000,
        roads=len({lane.road for lane in reading.lanes if lane.junction is None}),
        junctions=len({lane.junction for lane in reading.lanes} - {None}),
        covered=reading.floor.intersection(floor).area / floor.area,
        outside=reading.floor.difference(floor.buffer(0.02)).area,
        off_lane=max(
            (shapely.distance(reading.floor, shapely.Point(*each)) for each in points),
            default=0.0,
        ),
        off_answer=max(off_answers),
        other_answers=float(np.mean([each > ON_LANE for each in off_answers])),
        ways=len(reading.ways),
        missing=frozenset(walked - reading.ways),
        extra=frozenset(reading.ways - walked),
        beside=frozenset(beside),
    )


def graph_ways(site: Site, reading: CarlaReading) -> tuple[set[Way], set[Pair]]:
    """Return the ways that the edges of the navigation graph lead.

    And pairs of pieces that they join though the map does not. Edges are cut into points;
    one on a seam is on both pieces. Roads are joined by a junction where points that hang
    together on it touch both.
    """
    names = list(reading.pieces)
    tree = STRtree([reading.pieces[each] for each in names])
    graph = navigation_graph(site)
    points: nx.Graph[Any] = nx.Graph()
    on: dict[Any, set[int]] = defaultdict(set)
    for edge in graph.edges:
        line = LineString([graph.viewpoints[each][1:] for each in edge])
        count = max(2, math.ceil(line.length / ON_ROUTE) + 1)
        places = shapely.line_interpolate_point(
            line, np.linspace(0, line.length, count)
        )
        chain: list[Any] = [edge[0], *((edge, n) for n in range(1, count - 1)), edge[1]]
        nx.add_path(points, chain)
        for place, piece in tree.query(places, predicate="intersects").T.tolist():
            on[chain[place]].add(names[piece])
    junctions = {each.junction for each in reading.lanes if each.junction is not None}
    ways: set[Way] = set()
    for junction in junctions:
        inside = points.subgraph([each for each in points if junction in on[each]])
        for part in nx.connected_components(inside):
            near = {
                piece
                for here in part
                for each in (here, *points[here])
                for piece in on[each]
            }
            ways |= {
                (one, junction, other)
                for one, other in permutations(near - junctions, 2)
            }
    beside = {
        (one, other)
        for here, there in points.edges
        if not on[here] & on[there]
        for one, other in product(on[here], on[there])
        if frozenset((one, other)) not in reading.links
    }
    return ways, beside


def imported_sites() -> Iterator[Site]:
    """Yield the floors of the example files of importers, with a route each."""
    with tempfile.TemporaryDirectory() as folder:
        archive = Path(folder) / "mill_court.zip"
        with zipfile.ZipFile(archive, "w") as content:
            for file in sorted((EXAMPLES / "mill_court").iterdir()):
                content.write(file, f"Mill Court/{file.name}")
        quay, lantern = (
            EXAMPLES / "quay_house_MapData.geojson",
            EXAMPLES / "lantern_building.osm",
        )
        for file, kind, floor, routes in (
            (quay, "cabot", "2F", [("Elevator", "Rope Workshop")]),
            (quay, "cabot", "1F", []),
            (archive, "imdf", "1", [("Reception", "Dye lab")]),
            (archive, "imdf", "G", []),
            (lantern, "osm", "3", []),
            (lantern, "osm", "2", []),
        ):
            yield import_site(file, kind, floor=floor, routes=routes).site


def row(verdict: OpenDriveVerdict) -> str:
    cells = [
        verdict.site,
        f"{verdict.kilobytes:.0f}",
        verdict.roads,
        verdict.junctions,
        f"{100 * verdict.covered:.1f}",
        f"{verdict.outside:.2f}",
        f"{100 * verdict.off_lane:.1f}",
        f"{100 * verdict.off_answer:.1f}",
        f"{100 * verdict.other_answers:.1f}",
        verdict.ways,
        len(verdict.missing),
        len(verdict.extra),
        len(verdict.beside),
        verdict.said or "nothing",
    ]
    return f"| {' | '.join(map(str, cells))} |"


def all_sites(made: int) -> Iterator[Site]:
    for name in BUILTIN_SITE_NAMES:
        yield load_site(name)
    for kind in BUILDING_KINDS:
        for seed in range(made):
            yield make_building(kind, seed)
    yield from imported_sites()


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.opendrive",
        description="Let CARLA's reader judge sites that are exported as OpenDRIVE.",
    )
    parser.add_argument("--made", type=int, default=5, help="buildings of each kind")
    parser.add_argument("--lanes", choices=LANE_TYPES, default="sidewalk")
    args = parser.parse_args()
    titles: Sequence[str] = (
        "floor",
        "kB",
        "roads",
        "junctions",
        "covered, %",
        "lanes outside, m²",
        "route off lanes, cm",
        "route off CARLA's answer, cm",
        "so more than 5 cm, %",
        "ways",
        "missing",
        "extra",
        "beside",
        "the reader says",
    )
    print(f"| {' | '.join(titles)} |\n|{'---|' * len(titles)}", flush=True)
    for site in all_sites(args.made):
        print(row(judge(site, args.lanes)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
