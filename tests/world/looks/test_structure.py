import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely import LineString, box

from memorymaze.world.looks import surfaces
from memorymaze.world.looks.floor_plan import (
    Opening,
    WallSurroundings,
    floor_parts,
    openings_of,
    sliced,
    wall_faces,
)
from memorymaze.world.looks.structure import empty_stretches, structure_of
from memorymaze.world.sites import Site
from memorymaze.world.sites.records import Door, Room


def test_parts_cover_the_floor_once_and_faces_its_boundary(
    tiny_sites: dict[str, Site],
) -> None:
    for site in tiny_sites.values():
        floor, parts = site.walkable_floor, floor_parts(site)
        pieces = shapely.union_all([piece for part in parts for piece in sliced(part)])
        assert pieces.area == pytest.approx(floor.area, abs=1e-3)
        whole = sum(part.polygon.area for part in parts)
        assert whole == pytest.approx(floor.area, abs=1e-3)
        faces = list(wall_faces(floor, parts, ()))
        around = sum(face.length for face in faces)
        assert around == pytest.approx(floor.boundary.length, abs=0.05)
        for face in faces:
            assert floor.covers(shapely.Point(face.at(face.length / 2, 0.02)))


def test_an_opening_breaks_the_wall_it_is_in(corridor_site: Site) -> None:
    north = corridor_site.walkable_floor.bounds[3]
    opening = Opening(8.0, north, -math.pi / 2, 0.6, 1.0, 2.0)
    faces = wall_faces(
        corridor_site.walkable_floor, floor_parts(corridor_site), [opening]
    )
    holes = [
        (face.at(low)[0], face.at(high)[0], bottom, top, face.at(low)[1])
        for face in faces
        for low, high, bottom, top in face.holes
    ]
    assert min(min(hole[:2]) for hole in holes) == pytest.approx(7.4)
    assert max(max(hole[:2]) for hole in holes) == pytest.approx(8.6)
    for *_, bottom, top, y in holes:
        assert (bottom, top, y) == (1.0, 2.0, pytest.approx(north))


def test_ceilings_are_missing_only_in_the_open_air(two_rooms: Site) -> None:
    def kinds(site: Site) -> set[str]:
        return {mesh.kind for mesh in structure_of(site).meshes}

    outside = replace(
        two_rooms,
        corridors=(),
        turning_points=(),
        areas=(replace(two_rooms.areas[0], open_air=True),),
        doors=(),
        landmarks=(),
    )
    assert "ceiling" in kinds(two_rooms)
    assert "ceiling" not in kinds(outside)


def test_what_is_behind_a_wall_decides_what_one_sees(corridor_site: Site) -> None:
    west, _, east, north = corridor_site.walkable_floor.bounds
    room = Room("r", box(west, north + 0.1, west + 5, north + 4), "Office", "office")
    surroundings = WallSurroundings(replace(corridor_site, rooms=(room,)))
    assert surroundings.behind(west + 2, north, math.pi / 2)[0] == "room"
    assert surroundings.behind(east - 2, north, math.pi / 2)[0] == "outdoors"


def test_a_hole_in_the_floor_is_indoors_unless_it_is_beside_the_open_air(
    two_rooms: Site,
) -> None:
    hall = two_rooms.areas[0]
    x, y = hall.polygon.centroid.coords[0]
    hole = box(x - 1, y - 1, x + 1, y + 1)
    ring = replace(hall, polygon=hall.polygon.difference(hole))
    inside = replace(two_rooms, areas=(ring, *two_rooms.areas[1:]))
    terrace = replace(inside, areas=(replace(ring, open_air=True), *inside.areas[1:]))
    assert WallSurroundings(inside).behind(x - 1, y, 0.0)[0] == "room"
    assert WallSurroundings(terrace).behind(x - 1, y, 0.0)[0] == "outdoors"


def empty_metres(site: Site) -> float:
    faces = wall_faces(site.walkable_floor, floor_parts(site), openings_of(site))
    stretches = empty_stretches(list(faces), site)
    return sum(high - low for _, low, high, _ in stretches)


def test_long_walls_with_nothing_on_them_are_dressed_up_to_what_is_there(
    corridor_site: Site,
) -> None:
    west, _, east, north = corridor_site.walkable_floor.bounds
    plain = replace(corridor_site, doors=(), landmarks=())
    x = (west + east) / 2
    door = Door(
        "d", LineString([(x - 0.5, north), (x + 0.5, north)]), None, "wood", None, None,
        "closed",
    )  # fmt: skip
    beside = replace(plain, doors=(door,))
    whole = 2 * (east - west)
    assert whole - 8 < empty_metres(plain) <= whole
    # The door itself, and what is kept clear beside it.
    assert empty_metres(plain) - empty_metres(beside) == pytest.approx(1.7, abs=0.01)
    assert empty_metres(corridor_site) < empty_metres(beside)


def test_what_dresses_a_wall_has_neither_depth_nor_a_name(corridor_site: Site) -> None:
    bare = replace(corridor_site, doors=(), landmarks=())
    panels = surfaces.panelling(bare.ceiling_height)
    kinds = {
        mesh.kind
        for mesh in structure_of(bare).meshes
        if mesh.placed.parts[0].material is panels
    }
    assert kinds == {"decal"}


def test_walls_hide_but_glass_to_the_open_air_does_not(corridor_site: Site) -> None:
    plain = structure_of(replace(corridor_site, rooms=(), doors=(), landmarks=()))
    x = corridor_site.walkable_floor.centroid.x
    north = corridor_site.walkable_floor.bounds[3]
    door = Door(
        "d", LineString([(x - 0.5, north), (x + 0.5, north)]), None, "glass", "clear",
        None, "closed",
    )  # fmt: skip
    glazed = structure_of(replace(corridor_site, rooms=(), doors=(door,), landmarks=()))

    def length(segments: np.ndarray) -> float:
        return float(np.hypot(*(segments[:, 2:] - segments[:, :2]).T).sum())

    assert length(plain.hiding) - length(glazed.hiding) == pytest.approx(0.96, abs=0.01)
