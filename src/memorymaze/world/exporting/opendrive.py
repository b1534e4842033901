"""A site as OpenDRIVE 1.4: corridors as roads, turning points and halls as junctions.

OpenDRIVE's frame is the plan's: x east, y north, headings counter-clockwise; metres.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Literal
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from memorymaze.world.exporting.road_network import (
    Road,
    RoadEnd,
    RoadJunction,
    road_network,
)
from memorymaze.world.sites.records import Site

LaneType = Literal["sidewalk", "driving"]
LANE_TYPES: tuple[LaneType, ...] = ("sidewalk", "driving")
"""For whom the ways are: people on foot, or vehicles."""
BESIDE: Mapping[LaneType, str] = {"sidewalk": "sidewalk", "driving": "shoulder"}
"""Type of the lanes that cover what is left of halls, by that of the ways."""
ROAD_TYPES: Mapping[LaneType, str] = {"sidewalk": "pedestrian", "driving": "lowSpeed"}
BENT = {"s": "0", "a": "0", "b": "0", "c": "1e-09", "d": "0"}
"""Height of roads whose borders bend, metres. CARLA's index of lanes takes those on
straight roads for straight from end to end, unless their height is curved."""


def opendrive(site: Site, lanes: LaneType = "sidewalk") -> str:
    """Return a site's floor as the text of an OpenDRIVE file.

    A corridor has a lane each way, its centre line between them.
    """
    roads, junctions = road_network(site)
    west, south, east, north = site.walkable_floor.bounds
    root = Element("OpenDRIVE")
    box = _numbers(north=north, south=south, east=east, west=west)
    told = {"revMajor": "1", "revMinor": "4", "name": site.name, "version": "1"}
    header = SubElement(root, "header", {**told, **box})
    latitude, longitude = (
        (site.anchor.latitude, site.anchor.longitude) if site.anchor else (0.0, 0.0)
    )
    SubElement(header, "geoReference").text = (
        f"+proj=tmerc +lat_0={latitude!r} +lon_0={longitude!r} +k=1 +x_0=0 +y_0=0 "
        "+datum=WGS84 +units=m +no_defs"
    )
    leads_to = {
        (end.road, end.contact): each.id for each in junctions for end in each.ends
    }
    for road in roads:
        _add_road(root, road, leads_to, lanes)
    for junction in junctions:
        if junction.ends:
            inside = [each for each in roads if each.junction == junction.id]
            _add_junction(root, junction, inside)
    indent(root)
    return tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _add_road(
    root: Element, road: Road, leads_to: Mapping[tuple[int, str], int], lanes: LaneType
) -> None:
    told = {"name": road.name, "id": str(road.id), "junction": str(road.junction or -1)}
    made = SubElement(root, "road", {**told, **_numbers(length=road.line.length)})
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
    SubElement(made, "type", {"s": "0", "type": ROAD_TYPES[lanes]})
    plan = SubElement(made, "planView")
    for start, stretch in zip(road.line.starts, road.line, strict=False):
        x, y, heading = stretch.start
        numbers = _numbers(s=start, x=x, y=y, hdg=heading, length=stretch.length)
        geometry = SubElement(plan, "geometry", numbers)
        if stretch.curvature:
            SubElement(geometry, "arc", _numbers(curvature=stretch.curvature))
        else:
            SubElement(geometry, "line")
    if len(road.borders) > 2:
        SubElement(SubElement(made, "elevationProfile"), "elevation", BENT)
    _add_lanes(made, road, lanes)


def _add_lanes(made: Element, road: Road, lanes: LaneType) -> None:
    (left, right), places = road.lanes, [each.at for each in road.borders]
    count = left + right
    middles = [(at.right * left + at.left * right) / count for at in road.borders]
    widths = [(at.left - at.right) / count for at in road.borders]
    made = SubElement(made, "lanes")
    for record in _straight_pieces("s", places, middles):
        SubElement(made, "laneOffset", record)
    section = SubElement(made, "laneSection", {"s": "0"})
    kind = lanes if road.is_way else BESIDE[lanes]
    for tag, numbers in (
        ("left", range(left, 0, -1)),
        ("center", (0,)),
        ("right", range(-1, -right - 1, -1)),
    ):
        if not numbers:
            continue
        side = SubElement(section, tag)
        for number in numbers:
            told = {"id": str(number), "type": kind if number else "none"}
            lane = SubElement(side, "lane", {**told, "level": "false"})
            if number == 0:
                continue
            links = SubElement(lane, "link")
            for link, end in (("predecessor", road.before), ("successor", road.after)):
                if end is not None:
                    there = _lane_on(end, number, goes_on=link == "successor")
                    SubElement(links, link, {"id": str(there)})
            for record in _straight_pieces("sOffset", places, widths):
                SubElement(lane, "width", record)


def _lane_on(end: RoadEnd, number: int, *, goes_on: bool) -> int:
    """Return the lane of another road, at an end of it, that a road's lane joins.

    Lanes keep their side where the other road runs in the same direction.
    """
    return number if (end.contact == "start") == goes_on else -number


def _add_junction(root: Element, junction: RoadJunction, inside: list[Road]) -> None:
    told = {"name": junction.name, "id": str(junction.id)}
    made = SubElement(root, "junction", told)
    for number, road in enumerate(inside):
        # Readers know the roads of a junction by a way that leads onto each.
        end = road.before or junction.ends[0]
        told = {"id": str(number), "incomingRoad": str(end.road)}
        told |= {"connectingRoad": str(road.id), "contactPoint": "start"}
        connection = SubElement(made, "connection", told)
        if road.before is not None:
            lane = str(_lane_on(end, -1, goes_on=False))
            SubElement(connection, "laneLink", {"from": lane, "to": "-1"})


def _straight_pieces(
    name: str, places: Sequence[float], values: Sequence[float]
) -> Iterator[dict[str, str]]:
    """Yield what is straight between values as polynomials from each place on."""
    points = zip(places, values, strict=True)
    for (begin, value), (end, there) in pairwise(points):
        slope = (there - value) / (end - begin)
        yield _numbers(**{name: begin, "a": value, "b": slope, "c": 0.0, "d": 0.0})


def _numbers(**values: float) -> dict[str, str]:
    return {name: f"{value:.9g}" for name, value in values.items()}
