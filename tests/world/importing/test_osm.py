import json
from dataclasses import replace

import pytest

from memorymaze.basics.errors import ImportFileError
from memorymaze.world.importing.imported import ImportNotes
from memorymaze.world.importing.osm import import_osm
from memorymaze.world.importing.osm_elements import Element, read_elements


def test_one_outline_for_all_hallways_becomes_corridors_an_oracle_walks(
    lantern_building, walked
):
    imported = import_osm(lantern_building, "3")
    site = walked(imported, "Seminar room 302", "The Lamplighter")
    assert site.title == "Lantern Building"
    shapes = sorted(point.shape for point in site.turning_points)
    assert shapes == ["corner", "opening", "t_junction", "t_junction", "t_junction"]
    assert {each.name for each in site.corridors} == {"Third floor hallway"}


def test_rooms_have_the_uses_that_their_tags_say(lantern_building, kinds):
    rooms = {
        each["name"]: each["use"]
        for each in kinds(import_osm(lantern_building, "3"), "room")
    }
    assert rooms["301"] == "office"
    assert rooms["Seminar room 302"] == "classroom"
    assert rooms["Cafe Lantern"] == "kitchen"
    assert rooms["Toilets"] == "restroom"
    assert "Tower room" not in rooms


def test_doors_on_the_outline_lead_to_the_rooms_behind_them(lantern_building, kinds):
    imported = import_osm(lantern_building, "3")
    rooms = {room.id: room.name for room in imported.site.rooms}
    doors = {
        rooms.get(each["room"]) or each["label"]: each
        for each in kinds(imported, "door")
    }
    assert doors["Reading room"]["style"] == "automatic_glass"
    assert doors["Bridge to the annex"]["room"] is None
    styles = [each["style"] for each in kinds(imported, "door")]
    assert (styles.count("fire"), styles.count("elevator")) == (1, 1)


def test_a_footway_beyond_the_outlines_is_floor_too(lantern_building):
    imported = import_osm(lantern_building, "3")
    corridors = [each.polygon.bounds for each in imported.site.corridors]
    west, east = min(each[0] for each in corridors), max(each[2] for each in corridors)
    assert east - west > 40


def test_what_stands_about_is_things(lantern_building, kinds):
    things = {
        each["category"]
        for each in kinds(import_osm(lantern_building, "3"), "landmark")
    }
    assert things == {
        "vending machine", "fire extinguisher", "floor map", "trash can", "statue", "bench",
    }  # fmt: skip


def test_what_is_left_out_is_told_with_ids(lantern_building):
    imported = import_osm(lantern_building, "3")
    assert any("highway=steps (1): way/" in line for line in imported.missing)
    assert any("shop=kiosk (1): node/" in line for line in imported.missing)
    assert any(line.startswith("named nodes in no room") for line in imported.missing)
    assert any(line.startswith("rooms cut where") for line in imported.guessed)


@pytest.mark.parametrize(
    ("level", "repeated", "levels"),
    [
        pytest.param("2", None, {2}, id="one"),
        pytest.param("-1", None, {-1}, id="below the ground"),
        pytest.param("0;2", None, {0, 2}, id="two"),
        pytest.param("1-3", None, {1, 2, 3}, id="from to"),
        pytest.param("0-2.5", None, {0, 1, 2, 2.5}, id="to half a storey"),
        pytest.param("-2--1", None, {-2, -1}, id="from to below the ground"),
        pytest.param("0.5", "4-5", {0.5, 4, 5}, id="repeated"),
        pytest.param("first", None, set(), id="no number"),
        pytest.param("0-9999999999", None, None, id="endless"),
    ],
)
def test_levels_are_read_as_simple_indoor_tagging_has_them(level, repeated, levels):
    tags = {"level": level} | ({"repeat_on": repeated} if repeated else {})
    found = Element("node/1", tags).levels()
    assert found == levels if levels is not None else len(found) <= 202


def test_an_answer_of_overpass_is_the_same_building(lantern_building, tmp_path):
    elements = []
    for element in read_elements(lantern_building, ImportNotes()).values():
        kind, number = element.id.split("/")
        raw = {"type": kind, "id": int(number), "tags": element.tags}
        if element.place:
            raw |= {"lon": element.place[0], "lat": element.place[1]}
        raw["nodes"] = [int(member.split("/")[1]) for member, _ in element.members]
        elements.append(raw)
    path = tmp_path / "lantern_building.json"
    path.write_text(json.dumps({"version": 0.6, "elements": elements}), "utf-8")
    sites = [import_osm(each, "3").site for each in (path, lantern_building)]
    assert replace(sites[0], description=sites[1].description) == sites[1]


def test_a_way_that_is_made_of_itself_is_told(tmp_path):
    raw = {"type": "way", "id": 1, "tags": {"indoor": "corridor", "level": "0"}}
    raw["members"] = [{"type": "way", "ref": 1, "role": ""}]
    node = {"type": "node", "id": 2, "lon": 8, "lat": 47, "tags": {"level": "0"}}
    path = tmp_path / "round.json"
    path.write_text(json.dumps({"elements": [raw, node]}), "utf-8")
    with pytest.raises(ImportFileError, match="expected some floor"):
        import_osm(path)


@pytest.fixture
def court(tmp_path):
    """A corridor round a court, as a relation of two rings."""
    ring = '<nd ref="{0}1"/><nd ref="{0}2"/><nd ref="{0}3"/><nd ref="{0}4"/><nd ref="{0}1"/>'
    corners = {"1": (0, 0), "2": (0, 2), "3": (2, 2), "4": (2, 0)}
    nodes = "".join(
        f'<node id="{way}{n}" lon="{8 + (x * size + shift) * 1e-4}" '
        f'lat="{47 + (y * size + shift) * 1e-4}"/>'
        for way, size, shift in (("1", 1.0, 0.0), ("2", 0.4, 0.6))
        for n, (x, y) in corners.items()
    )
    path = tmp_path / "court.osm"
    path.write_text(
        f'<osm version="0.6">{nodes}<way id="1">{ring.format(1)}</way>'
        f'<way id="2">{ring.format(2)}</way><relation id="3">'
        '<member type="way" ref="1" role="outer"/>'
        '<member type="way" ref="2" role="inner"/>'
        '<tag k="type" v="multipolygon"/><tag k="indoor" v="corridor"/>'
        '<tag k="level" v="0"/></relation></osm>',
        encoding="utf-8",
    )
    return path


def test_a_multipolygon_has_its_holes(court, kinds):
    assert len(kinds(import_osm(court), "turning_point")) == 4


@pytest.mark.parametrize(
    ("whole", "part"),
    [
        pytest.param('<node id="13"', '<node id="99"', id="a node is missing"),
        pytest.param('<nd ref="24"/><nd ref="21"/>', '<nd ref="24"/>', id="open"),
    ],
)
def test_a_multipolygon_that_is_not_all_there_is_told(court, whole, part):
    tags = '<tag k="indoor" v="corridor"/><tag k="level" v="0"/></way>'
    text = court.read_text("utf-8").replace(whole, part)
    head, inner = text.replace("</osm>", "").split('<way id="2">')
    ring = inner.split("</way>")[0]
    court.write_text(
        f'{head}<way id="2">{inner}<way id="4">{ring}{tags}</osm>', "utf-8"
    )
    imported = import_osm(court)
    assert "ways and relations with broken outlines (1): relation/3" in imported.missing


def test_only_emergency_exits_are_fire_doors(lantern_building, tmp_path, kinds):
    path = tmp_path / "exits.osm"
    text = lantern_building.read_text("utf-8")
    path.write_text(text.replace('v="emergency"', 'v="exit"'), "utf-8")
    styles = [each["style"] for each in kinds(import_osm(path, "3"), "door")]
    assert "fire" not in styles


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param("<osm><node", ":1: expected XML", id="cut off"),
        pytest.param(
            '<!DOCTYPE osm [<!ENTITY a "aaaa">]><osm>&a;</osm>',
            ":1: .*without a document type",
            id="entities",
        ),
        pytest.param("<html></html>", "expected <osm>", id="a page"),
        pytest.param('<osm version="0.6"/>', "elements, got none", id="empty"),
        pytest.param('{"elements": 3}', 'with "elements"', id="other JSON"),
        pytest.param(
            '<osm><node id="1" lat="1" lon="1"/></osm>',
            "expected Simple Indoor Tagging",
            id="outdoors",
        ),
    ],
)
def test_what_is_no_indoor_data_is_an_error_that_names_the_file(
    content, message, tmp_path
):
    path = tmp_path / "map.osm"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ImportFileError, match=f"map.osm.*{message}"):
        import_osm(path)
