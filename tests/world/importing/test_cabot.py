import json

import pytest

from memorymaze.basics.errors import ImportFileError, SettingsError
from memorymaze.world.importing.cabot import import_cabot


def test_links_in_line_are_one_corridor_and_an_oracle_walks_it(quay_house, walked):
    site = walked(import_cabot(quay_house, "2F"), "Elevator", "Rope Workshop")
    widths = sorted(round(each.width, 1) for each in site.corridors)
    assert widths == [1.5, 2.0, 2.0, 2.4]
    assert max(each.length for each in site.corridors) == pytest.approx(36, abs=0.1)
    assert sorted(point.shape for point in site.turning_points) == [
        "corner", "corner", "t_junction", "t_junction",
    ]  # fmt: skip
    assert site.anchor.latitude == pytest.approx(47.3, abs=0.001)
    assert [turn.direction for turn in site.routes[0].turns] == ["left", "right"]


def test_entrances_are_doors_labelled_by_their_facilities(quay_house, kinds):
    doors = {
        each["label"]: each for each in kinds(import_cabot(quay_house, "2"), "door")
    }
    assert doors.keys() == {
        "Map Room", "Canteen, North side", "Chart Store", "Harbour Office",
        "Rope Workshop", "Elevator", "Stairs",
    }  # fmt: skip
    assert doors["Canteen, North side"]["style"] == "automatic_glass"
    assert doors["Elevator"]["style"] == "elevator"
    assert doors["Stairs"]["source"] == "EDITOR_node_st"


def test_named_points_of_interest_are_things(quay_house, kinds):
    things = {
        each["category"]: each
        for each in kinds(import_cabot(quay_house, "2"), "landmark")
    }
    assert things.keys() == {"vending machine", "potted plant", "pillar"}


def test_what_is_guessed_and_missing_is_told_with_ids(quay_house):
    imported = import_cabot(quay_house, "2")
    assert "widths of 2 links: 1.5 m" in imported.guessed
    assert "facilities without an entrance (1): EDITOR_facil_6" in imported.missing
    assert (
        "doors across a way, which plans do not have (1): EDITOR_facil_12"
        in imported.missing
    )
    assert (
        "points of interest that are no things: _nav_info_ (1): EDITOR_facil_18"
        in imported.missing
    )


@pytest.mark.parametrize(
    ("identity", "member", "value", "told"),
    [
        pytest.param(
            "EDITOR_link_9",
            "properties.end_id",
            "nowhere",
            "links that do not join two nodes of the file (1): EDITOR_link_9",
            id="a link to no node",
        ),
        pytest.param(
            "EDITOR_link_1",
            "properties.hulop_road_width",
            150,
            "widths of links out of (0.9, 10.0): 1.5 m (1): EDITOR_link_1",
            id="a width that no corridor has",
        ),
        pytest.param(
            "EDITOR_link_1",
            "properties",
            {"tree": "oak"},
            "features that are no node, link or facility (1): EDITOR_link_1",
            id="a feature of another kind",
        ),
        pytest.param(
            "EDITOR_facil_15",
            "properties.hulop_height",
            1.5,
            "points of interest on no floor of the file (1): EDITOR_facil_15",
            id="a point of interest between two floors",
        ),
        pytest.param(
            "EDITOR_node_r5",
            "geometry.coordinates",
            [9.0, 47.3],
            "features more than 1000 m from the middle of the rest (1): EDITOR_node_r5",
            id="a node in another town",
        ),
    ],
)
def test_what_is_odd_is_told_and_the_rest_is_taken(
    quay_house, tmp_path, identity, member, value, told
):
    document = json.loads(quay_house.read_text("utf-8"))
    target = next(each for each in document["features"] if each["_id"] == identity)
    *steps, last = member.split(".")
    for step in steps:
        target = target[step]
    target[last] = value
    path = tmp_path / "MapData.geojson"
    path.write_text(json.dumps(document), encoding="utf-8")
    imported = import_cabot(path, "2")
    assert told in (*imported.guessed, *imported.missing)


@pytest.mark.parametrize(
    "name", ["地図\u3000室", "地図\u00a0室", "地図\n室", "地図 \u200e室"]
)
def test_names_with_spaces_of_any_kind_are_kept(quay_house, tmp_path, kinds, name):
    path = tmp_path / "MapData.geojson"
    text = quay_house.read_text("utf-8").replace('"Map Room"', json.dumps(name))
    path.write_text(text, encoding="utf-8")
    labels = {each["label"] for each in kinds(import_cabot(path, "2"), "door")}
    assert "地図 室" in labels


def test_of_several_floors_one_is_chosen(quay_house):
    with pytest.raises(SettingsError, match="choose one: --floor 1F, 2F"):
        import_cabot(quay_house)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param("{", "expected JSON", id="no JSON"),
        pytest.param("[]", 'expected a GeoJSON FeatureCollection', id="a list"),
        pytest.param('{"features": []}', 'points with a "node_id"', id="nothing in it"),
    ],
)  # fmt: skip
def test_what_is_no_map_data_is_an_error_that_names_the_file(
    content, message, tmp_path
):
    path = tmp_path / "MapData.geojson"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ImportFileError, match=f"MapData.geojson: .*{message}"):
        import_cabot(path)
