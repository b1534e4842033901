"""A site as OpenDRIVE 1.4: corridors as roads, turning points and halls as junctions.

OpenDRIVE's frame is the plan's: x east, y north, headings counter-clockwise; metres.
"""

from collections.abc import Sequence
from typing import Literal
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from memorymaze.exporting.reference_lines import Slice
from memorymaze.exporting.road_network import (
    Road,
    RoadEnd,
    RoadJunction,
    RoadNetwork,
    road_network,
)
from memorymaze.sites.records import Site

LaneType = Literal["sidewalk", "driving"]
LANE_TYPES: tuple[LaneType, ...] = ("sidewalk", "driving")
"""For whom the ways are: people on foot, or vehicles."""
BESIDE = {"sidewalk": "sidewalk", "driving": "shoulder"}
"""Type of the lanes that cover what is left of halls, by that of the ways."""


def opendrive(site: Site, lanes: LaneType = "sidewalk") -> str:
    """Return a site's floor as the text of an OpenDRIVE file.

    Every road has a lane each way. One keeps to the right; on sidewalks no one has to.
    """
    network = road_network(site)
    west, south, east, north = site.walkable_floor.bounds
    root = Element("OpenDRIVE")
    header = SubElement(root, "header", {
        "revMajor": "1",
        "revMinor": "4",
        "name": site.name,
        "version": "1",
        **_numbers(north=north, south=south, east=east, west=west),
    })
    latitude, longitude = (
        (site.anchor.latitude, site.anchor.longitude) if site.anchor else (0.0, 0.0)
    )
    SubElement(header, "geoReference").text = (
        f"+proj=tmerc +lat_0={latitude!r} +lon_0={longitude!r} +k=1 +x_0=0 +y_0=0 "
        "+datum=WGS84 +units=m +no_defs"
    )
    leads_to = {
        (end.road, end.contact): junction.id
        for junction in network.junctions
        for end in junction.ends
    }
    for road in network.roads:
        _add_road(root, road, leads_to, lanes)
    for junction in network.junctions:
        if junction.ends:
            _add_junction(root, junction, network)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _add_road(
    root: Element, road: Road, leads_to: dict[tuple[int, str], int], lanes: LaneType
) -> None:
    made = SubElement(root, "road", {
        "name": road.name,
        "id": str(road.id),
        "junction": str(road.junction or -1),
        **_numbers(length=road.line.length),
    })
    links = SubElement(made, "link")
    for tag, contact, way in (
        ("predecessor", "start", road.before),
        ("successor", "end", road.after),
    ):
        junction = leads_to.get((road.id, contact))
        if way is not None:
            told = {"elementType": "road", "elementId": str(way.road)}
            SubElement(links, tag, {**told, "contactPoint": way.contact})
        elif junction is not None:
            told = {"elementType": "junction", "elementId": str(junction)}
            SubElement(links, tag, told)
    SubElement(made, "type", {"s": "0", "type": "pedestrian" if lanes == "sidewalk" else "lowSpeed"})
    plan = SubElement(made, "planView")
    for start, stretch in zip(road.line.starts, road.line, strict=False):
        x, y, heading = stretch.start
        geometry = SubElement(
            plan,
            "geometry",
            _numbers(s=start, x=x, y=y, hdg=heading, length=stretch.length),
        )
        if stretch.curvature:
            SubElement(geometry, "arc", _numbers(curvature=stretch.curvature))
        else:
            SubElement(geometry, "line")
    _add_lanes(made, road, lanes)


def _add_lanes(made: Element, road: Road, lanes: LaneType) -> None:
    left, right = road.lanes
    lanes_at = SubElement(made, "lanes")
    for piece in road.slices:
        middle = [at.right + (at.left - at.right) * right / (left + right) for at in piece]
        SubElement(lanes_at, "laneOffset", _linear("s", piece, middle))
    section = SubElement(lanes_at, "laneSection", {"s": "0"})
    is_way = road.lanes == (1, 1) or road.junction is None
    kind = lanes if is_way else BESIDE[lanes]
    for tag, numbers in (
        ("left", range(left, 0, -1)),
        ("center", (0,)),
        ("right", range(-1, -right - 1, -1)),
    ):
        if not numbers:
            continue
        side = SubElement(section, tag)
        for number in numbers:
            lane = SubElement(side, "lane", {
                "id": str(number),
                "type": kind if number else "none",
                "level": "false",
            })
            links = SubElement(lane, "link")
            if number == 0:
                continue
            for link, end in (("predecessor", road.before), ("successor", road.after)):
                if end is not None:
                    there = _lane_on(end, number, goes_on=link == "successor")
                    SubElement(links, link, {"id": str(there)})
            for piece in road.slices:
                wide = [(at.left - at.right) / (left + right) for at in piece]
                SubElement(lane, "width", _linear("sOffset", piece, wide))


def _lane_on(end: RoadEnd, number: int, *, goes_on: bool) -> int:
    """Return the lane of the way at an end that a connecting road's lane leads to.

    Lanes keep their side where the way runs in the same direction.
    """
    same = (end.contact == "start") == goes_on
    return number if same else -number


def _add_junction(root: Element, junction: RoadJunction, network: RoadNetwork) -> None:
    made = SubElement(
        root, "junction", {"name": junction.name, "id": str(junction.id)}
    )
    inside = [each for each in network.roads if each.junction == junction.id]
    number = 0
    for road in inside:
        enters = [(road.before, "start", -1), (road.after, "end", 1)]
        ways = [each for each in enters if each[0] is not None]
        # Readers only know the roads of a junction by a way that leads onto them.
        for end, contact, lane in ways or [(junction.ends[0], "start", 0)]:
            assert end is not None
            connection = SubElement(made, "connection", {
                "id": str(number),
                "incomingRoad": str(end.road),
                "connectingRoad": str(road.id),
                "contactPoint": contact,
            })
            number += 1
            if lane:
                leaves = _lane_on(end, lane, goes_on=contact == "end")
                link = {"from": str(leaves), "to": str(lane)}
                SubElement(connection, "laneLink", link)


def _linear(name: str, piece: Slice, values: Sequence[float]) -> dict[str, str]:
    """Return a polynomial, as OpenDRIVE has them, that is straight between two values."""
    begin, end = piece
    slope = (values[1] - values[0]) / (end.at - begin.at)
    return _numbers(**{name: begin.at, "a": values[0], "b": slope, "c": 0.0, "d": 0.0})


def _numbers(**values: float) -> dict[str, str]:
    return {name: f"{value:.9g}" for name, value in values.items()}
