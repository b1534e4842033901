"""Sites as OpenDRIVE, read by the reader of CARLA's client."""

import math
from collections.abc import Callable
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.world.construction import make_building
from memorymaze.world.exporting.opendrive import LANE_TYPES, LaneType, opendrive
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Site, load_site
from memorymaze.world.sites.records import Anchor

carla = pytest.importorskip("carla", reason="CARLA's client reads the files here")

from benchmarks.opendrive import CarlaReading, OpenDriveVerdict, judge  # noqa: E402

TINY = (
    "corridor",
    "crossing",
    "l_shape",
    "loop",
    "slanted_crossing",
    "t_junction",
    "two_rooms",
)


def complaints(verdict: OpenDriveVerdict) -> list[str]:
    """What is not as it should be."""
    found: list[str] = []
    if verdict.said:
        found.append(f"the reader says: {verdict.said}")
    if verdict.off_lane > 0.05:
        found.append(f"a route is {verdict.off_lane:.2f} m off all lanes")
    if verdict.covered < 0.95:
        found.append(f"lanes cover {verdict.covered:.3f} of the floor")
    if verdict.outside > 0.5:
        found.append(f"{verdict.outside:.2f} m² of lanes lie beyond the floor")
    if verdict.missing or verdict.extra or verdict.beside:
        found.append(
            f"missing {verdict.missing}, extra {verdict.extra}, beside {verdict.beside}"
        )
    return found


@pytest.mark.parametrize("lanes", LANE_TYPES)
@pytest.mark.parametrize("name", TINY)
def test_a_tiny_site_is_read_as_it_is(
    tiny_sites: dict[str, Site], name: str, lanes: LaneType
):
    assert complaints(judge(tiny_sites[name], lanes)) == []


@pytest.mark.proof
@pytest.mark.parametrize("name", BUILTIN_SITE_NAMES)
def test_a_shipped_floor_is_read_as_it_is(name: str):
    verdict = judge(load_site(name))
    assert complaints(verdict) == []
    assert verdict.ways > 100


@pytest.mark.proof
@pytest.mark.parametrize("kind", ["mall", "museum", "airport"])
def test_a_made_floor_is_read_as_it_is(kind: str):
    assert complaints(judge(make_building(kind, 1))) == []


def narrowed(root: ElementTree.Element) -> None:
    for width in next(root.iter("road")).iter("width"):
        width.set("a", "0.3")


def broken_off(root: ElementTree.Element) -> None:
    road = next(each for each in root.iter("road") if each.attrib["junction"] != "-1")
    for parent in [*root.iter("link")]:
        if parent in [*road.iter("link")]:
            parent[:] = [each for each in parent if each.tag != "successor"]


def mirrored(root: ElementTree.Element) -> None:
    for geometry in root.iter("geometry"):
        for name in ("y", "hdg"):
            geometry.set(name, str(-float(geometry.attrib[name])))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        pytest.param(narrowed, "of the floor", id="narrow"),
        pytest.param(broken_off, "missing frozenset({(", id="broken off"),
        pytest.param(mirrored, "off all lanes", id="mirrored"),
    ],
)
def test_a_verdict_tells_a_wrong_map_from_a_right_one(
    l_site: Site,
    monkeypatch: pytest.MonkeyPatch,
    change: Callable[[ElementTree.Element], None],
    told: str,
):
    def changed(site: Site, lanes: LaneType) -> str:
        root = ElementTree.fromstring(opendrive(site, lanes))
        change(root)
        return ElementTree.tostring(root, encoding="unicode")

    monkeypatch.setattr("benchmarks.opendrive.opendrive", changed)
    assert told in "\n".join(complaints(judge(l_site)))


def test_what_the_reader_says_is_heard(l_site: Site):
    text = opendrive(l_site).replace("geoReference", "nothing")
    assert "georeference" in CarlaReading("l_shape", text).said


def test_points_of_a_corridor_go_to_carla_and_back(l_site: Site):
    reading = CarlaReading("l_shape", opendrive(l_site))
    south, east = l_site.corridors
    for corridor in (south, east):
        start, stop = (Pose(*each, 0.0) for each in corridor.centre_line.coords)
        heading = math.atan2(stop.y - start.y, stop.x - start.x)
        for share in (0.2, 0.5, 0.7):
            # A quarter of its width to the right is the middle of the right lane.
            aside = corridor.width / 4
            x = start.x + share * (stop.x - start.x) + aside * math.sin(heading)
            y = start.y + share * (stop.y - start.y) - aside * math.cos(heading)
            point = reading.map.get_waypoint(
                carla.Location(x=x, y=-y), lane_type=carla.LaneType.Sidewalk
            )
            place, yaw = point.transform.location, point.transform.rotation.yaw
            assert (place.x, -place.y) == pytest.approx((x, y), abs=1e-3)
            assert abs(turn_between(-math.radians(yaw), heading)) < 1e-3
            assert point.lane_width == pytest.approx(corridor.width / 2, abs=1e-3)
            assert point.lane_id == -1


def test_left_of_a_corridor_one_comes_back(l_site: Site):
    reading = CarlaReading("l_shape", opendrive(l_site))
    point = reading.map.get_waypoint(
        carla.Location(x=5.0, y=-0.5), lane_type=carla.LaneType.Sidewalk
    )
    assert abs(point.transform.rotation.yaw) == pytest.approx(180.0, abs=1e-3)


def test_vehicles_find_the_same_ways_in_carlas_topology(crossing_site: Site):
    reading = CarlaReading("crossing", opendrive(crossing_site, "driving"))
    told = {
        ((one.road_id, one.lane_id), (other.road_id, other.lane_id))
        for one, other in reading.map.get_topology()
        if one.road_id != other.road_id
    }
    ours = {
        ((lane.road, lane.number), there)
        for lane in reading.lanes
        for there in lane.leads_to
    }
    assert told == ours
    assert len(reading.map.generate_waypoints(1.0)) > 50
    on_foot = CarlaReading("crossing", opendrive(crossing_site))
    assert on_foot.map.get_topology() == []
    assert on_foot.ways == reading.ways
    assert len(reading.ways) == 12


def test_halls_are_beside_the_ways_of_vehicles(two_rooms: Site):
    reading = CarlaReading("two_rooms", opendrive(two_rooms, "driving"))
    assert {lane.kind for lane in reading.lanes} == {"Driving", "Shoulder"}
    on_foot = CarlaReading("two_rooms", opendrive(two_rooms))
    assert {lane.kind for lane in on_foot.lanes} == {"Sidewalk"}


@pytest.mark.proof
def test_no_road_and_no_junction_have_the_same_id(builtin_sites: dict[str, Site]):
    for site in builtin_sites.values():
        root = ElementTree.fromstring(opendrive(site))
        ids = [
            each.attrib["id"] for each in (*root.iter("road"), *root.iter("junction"))
        ]
        assert len(set(ids)) == len(ids)
        assert "0" not in ids


def test_the_anchor_is_where_it_is_on_the_globe(l_site: Site):
    anchor = Anchor(latitude=50.1, longitude=8.7, bearing=0.0)
    reading = CarlaReading("l_shape", opendrive(replace(l_site, anchor=anchor)))
    here = reading.map.transform_to_geolocation(carla.Location())
    assert (here.latitude, here.longitude) == pytest.approx((50.1, 8.7))


def test_the_same_site_is_the_same_text(two_rooms: Site):
    assert opendrive(two_rooms) == opendrive(two_rooms)
