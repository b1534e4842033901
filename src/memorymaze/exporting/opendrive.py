"""A site as OpenDRIVE 1.4: corridors as roads, turning points and halls as junctions.

OpenDRIVE's frame is the plan's: x east, y north, headings counter-clockwise; metres.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Literal
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from memorymaze.exporting.reference_lines import Across, Slice
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
BENT = {"s": "0", "a": "0", "b": "0", "c": "1e-09", "d": "0"}
"""Height of roads whose borders may bend, metres. CARLA's index of lanes takes those on
straight roads for straight from end to end, unless their height is curved."""
STRAIGHT = 1e-3
"""Metres that a border may lie off the straight line that is written for it."""


def opendrive(site: Site, lanes: LaneType = "sidewalk") -> str:
    """Return a site's floor as the text of an OpenDRIVE file.

    Every road has a lane each way. One keeps to the right; on sidewalks no one has to.
    """
    network = road_network(site)
    west, south, east, north = site.walkable_floor.bounds
    root = Element("OpenDRIVE")
    header = SubElement(
        root,
        "header",
        {
            "revMajor": "1",
            "revMinor": "4",
            "name": site.name,
            "version": "1",
            **_numbers(north=north, south=south, east=east, west=west),
        },
    )
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
    made = SubElement(
        root,
        "road",
        {
            "name": road.name,
            "id": str(road.id),
            "junction": str(road.junction or -1),
            **_numbers(length=road.line.length),
        },
    )
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
    SubElement(
        made,
        "type",
        {"s": "0", "type": "pedestrian" if lanes == "sidewalk" else "lowSpeed"},
    )
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
    if len(road.slices) > 1:
        SubElement(SubElement(made, "elevationProfile"), "elevation", BENT)
    _add_lanes(made, road, lanes)


def _add_lanes(made: Element, road: Road, lanes: LaneType) -> None:
    left, right = road.lanes
    count = left + right
    made = SubElement(made, "lanes")
    middles = [(at.right * left + at.left * right) / count for at in _places(road)]
    widths = [(at.left - at.right) / count for at in _places(road)]
    for record in _records("s", road.slices, middles):
        SubElement(made, "laneOffset", record)
    records = list(_records("sOffset", road.slices, widths))
    section = SubElement(made, "laneSection", {"s": "0"})
    kind = lanes if road.is_way else BESIDE[lanes]
    for tag, numbers in (
        ("left", range(left, 0, -1)),
        ("center", range(1)),
        ("right", range(-1, -right - 1, -1)),
    ):
        if not numbers:
            continue
        side = SubElement(section, tag)
        for number in numbers:
            told = {"id": str(number), "type": kind if number else "none"}
            lane = SubElement(side, "lane", {**told, "level": "false"})
            links = SubElement(lane, "link")
            if number == 0:
                continue
            for link, end in (("predecessor", road.before), ("successor", road.after)):
                if end is not None:
                    there = _lane_on(end, number, goes_on=link == "successor")
                    SubElement(links, link, {"id": str(there)})
            for record in records:
                SubElement(lane, "width", record)


def _lane_on(end: RoadEnd, number: int, *, goes_on: bool) -> int:
    """Return the lane of the way at an end that a connecting road's lane joins.

    Lanes keep their side where the way runs in the same direction.
    """
    return number if (end.contact == "start") == goes_on else -number


def _add_junction(root: Element, junction: RoadJunction, network: RoadNetwork) -> None:
    told = {"name": junction.name, "id": str(junction.id)}
    made = SubElement(root, "junction", told)
    inside = [each for each in network.roads if each.junction == junction.id]
    for number, road in enumerate(inside):
        # Readers know the roads of a junction by a way that leads onto each.
        end = road.before or junction.ends[0]
        connection = SubElement(
            made,
            "connection",
            {
                "id": str(number),
                "incomingRoad": str(end.road),
                "connectingRoad": str(road.id),
                "contactPoint": "start",
            },
        )
        if road.before is not None:
            lane = str(_lane_on(end, -1, goes_on=False))
            SubElement(connection, "laneLink", {"from": lane, "to": "-1"})


def _places(road: Road) -> Iterator[Across]:
    """Yield where each slice begins and ends."""
    for piece in road.slices:
        yield from piece


def _records(
    name: str, slices: Sequence[Slice], values: Sequence[float]
) -> Iterator[dict[str, str]]:
    """Yield the straight polynomials through values at both ends of each slice.

    Slices that go on straight share one.
    """
    begin, value, slope = slices[0][0].at, values[0], math.nan
    for piece, start, stop in zip(slices, values[::2], values[1::2], strict=True):
        goes_on = value + slope * (piece[1].at - begin)
        jumps = abs(value + slope * (piece[0].at - begin) - start) > STRAIGHT
        if jumps or not abs(goes_on - stop) <= STRAIGHT:
            if not math.isnan(slope):
                yield _numbers(**{
                    name: begin,
                    "a": value,
                    "b": slope,
                    "c": 0.0,
                    "d": 0.0,
                })
            begin, value = piece[0].at, start
            slope = (stop - start) / (piece[1].at - begin)
    yield _numbers(**{name: begin, "a": value, "b": slope, "c": 0.0, "d": 0.0})


def _numbers(**values: float) -> dict[str, str]:
    return {name: f"{value:.9g}" for name, value in values.items()}
