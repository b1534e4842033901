import json
import zipfile

import pytest

from memorymaze.basics.errors import ImportFileError, SettingsError
from memorymaze.world.importing.imdf import import_imdf


def change(archive, kind, edit):
    """Write an archive again, with the document of a kind edited."""
    with zipfile.ZipFile(archive) as old:
        files = {name: old.read(name) for name in old.namelist()}
    name = f"Mill Court/{kind}.geojson"
    document = json.loads(files[name])
    edit(document)
    with zipfile.ZipFile(archive, "w") as new:
        for file, content in (files | {name: json.dumps(document)}).items():
            new.writestr(file, content)


def test_an_oracle_walks_from_the_lobby_to_a_lab(mill_court, walked):
    site = walked(import_imdf(mill_court, "1"), "Reception", "Dye lab")
    assert site.title == "Mill Court"
    assert [area.name for area in site.areas if area.name] == ["West lobby"]
    shapes = sorted(point.shape for point in site.turning_points)
    assert shapes == ["corner", "opening", "t_junction", "t_junction"]
    assert [turn.direction for turn in site.routes[0].turns] == [
        "left", "slight_right", "slight_right",
    ]  # fmt: skip


def test_units_are_rooms_named_by_themselves_or_their_occupants(mill_court, kinds):
    rooms = {
        each["name"]: each["use"]
        for each in kinds(import_imdf(mill_court, "1"), "room")
    }
    assert rooms["Spindle Cafe"] == "shop"
    assert rooms["Loom room"] == "conference_room"
    assert rooms["Storage"] == "storage"
    assert "Plant" not in rooms


def test_openings_are_doors_of_their_rooms(mill_court, kinds):
    imported = import_imdf(mill_court, "1")
    rooms = {room.id: room.name for room in imported.site.rooms}
    doors = {rooms[each["room"]]: each for each in kinds(imported, "door")}
    assert doors["Elevator"]["style"] == "elevator"
    assert doors["South stairs"]["style"] == "fire"
    assert doors["Spindle Cafe"]["style"] == "glass"
    assert doors["Dye lab"]["label"] == "Dye lab"


@pytest.mark.parametrize("times", [0.3, 4.0])
def test_a_width_that_no_door_of_a_plan_has_is_told(mill_court, kinds, times):
    def widened(document):
        for opening in document["features"]:
            (x, y), (to_x, to_y) = opening["geometry"]["coordinates"]
            end = [x + times * (to_x - x), y + times * (to_y - y)]
            opening["geometry"]["coordinates"] = [[x, y], end]

    change(mill_court, "opening", widened)
    imported = import_imdf(mill_court, "1")
    told = next(line for line in imported.guessed if line.startswith("widths of doors"))
    assert told.startswith(
        "widths of doors: 0.8 to 2.4 m, and no wider than their wall"
    )
    assert all(each["source"] in told for each in kinds(imported, "door"))


def test_an_opening_between_two_pieces_of_floor_is_a_passage(mill_court):
    imported = import_imdf(mill_court, "1")
    assert any(line.startswith("doors between two pieces") for line in imported.guessed)


def test_amenities_fixtures_and_kiosks_are_things(mill_court, kinds):
    things = [
        each["category"] for each in kinds(import_imdf(mill_court, "1"), "landmark")
    ]
    assert sorted(things) == [
        "bench", "cash machine", "drinking fountain", "fire extinguisher",
        "information kiosk", "reception desk", "vending machine",
    ]  # fmt: skip


def test_what_is_left_out_is_told_with_ids(mill_court):
    told = "\n".join(import_imdf(mill_court, "1").missing)
    for reason in (
        "units on a level that is not in the file (1): ",
        "units that are no rooms: opentobelow (1): ",
        "amenity that is no thing: strollerrental (1): ",
        "rooms that do not lie beside the floor (1): ",
        "doors with no wall near them (1): ",
    ):
        assert reason in told


def test_a_second_occupant_of_a_unit_is_told(mill_court):
    def doubled(document):
        second = document["features"][0] | {"id": "second"}
        document["features"].append(second)

    change(mill_court, "occupant", doubled)
    told = import_imdf(mill_court, "1").missing
    assert "occupants of a unit that has another one (1): second" in told


def test_files_that_are_not_read_are_told(mill_court):
    with zipfile.ZipFile(mill_court, "a") as archive:
        archive.writestr("detail.geojson", "{}")
    told = import_imdf(mill_court, "1").missing
    assert "files that are not read (1): detail.geojson" in told


def test_levels_are_listed_where_none_is_chosen(mill_court):
    with pytest.raises(SettingsError, match="choose one: --floor G, 1"):
        import_imdf(mill_court)


def test_the_ground_floor_is_another_plan(mill_court):
    assert import_imdf(mill_court, "G").site.floor == "G"


def test_what_is_no_zip_file_is_an_error(tmp_path):
    path = tmp_path / "venue.zip"
    path.write_text("no zip")
    with pytest.raises(ImportFileError, match=r"venue\.zip: expected an IMDF archive"):
        import_imdf(path)


def test_an_archive_without_units_is_an_error(tmp_path):
    path = tmp_path / "venue.zip"
    empty = json.dumps({"type": "FeatureCollection", "features": []})
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("level.geojson", empty)
    with pytest.raises(ImportFileError, match=r"expected levels in level\.geojson"):
        import_imdf(path)
