from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import trimesh
from shapely import LineString, Polygon, box

from memorymaze.basics.errors import ImportFileError
from memorymaze.front.cli.main import run_command_line
from memorymaze.testing import check_site
from memorymaze.world.exporting import export_site
from memorymaze.world.importing.mesh import import_mesh
from memorymaze.world.sites import Site, load_site
from memorymaze.world.sites.loading import new_plan

FLOOR = box(0, 0, 20, 2.4) | box(17.6, 0, 20, 14)
HIGH = 2.7
Z_UP_TO_Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])


def wall(*points: tuple[float, float], gap: float = 0.0) -> trimesh.Trimesh:
    """Return a wall without thickness; a gap is left out of each of its ends."""
    corners, faces = [], []
    for (x, y), (to_x, to_y) in pairwise(points):
        first = len(corners)
        line = LineString([(x, y), (to_x, to_y)])
        ends = [line.interpolate(gap), line.interpolate(line.length - gap)]
        corners += [(end.x, end.y, z) for end in ends for z in (0.0, HIGH)]
        faces += [(first, first + 2, first + 1), (first + 1, first + 2, first + 3)]
    return trimesh.Trimesh(corners, faces, process=False)


def level(shape: Polygon, z: float) -> trimesh.Trimesh:
    """Return a level mesh of rectangles."""
    xs, ys = (sorted({round(p[i], 6) for p in shape.exterior.coords}) for i in (0, 1))
    corners, faces = [], []
    for west, east in pairwise(xs):
        for south, north in pairwise(ys):
            if shape.contains(box(west, south, east, north).centroid):
                n = len(corners)
                corners += [(west, south, z), (east, south, z), (east, north, z)]
                corners.append((west, north, z))
                faces += [(n, n + 1, n + 2), (n, n + 2, n + 3)]
    return trimesh.Trimesh(corners, faces, process=False)


def block(west: float, south: float, east: float, north: float, high: float):
    middle = [(west + east) / 2, (south + north) / 2, high / 2]
    made = trimesh.creation.box((east - west, north - south, high))
    return made.apply_translation(middle)


def corridor_mesh(**more: trimesh.Trimesh) -> dict[str, trimesh.Trimesh]:
    ring = [(x, y) for x, y in FLOOR.exterior.coords]
    return {
        "Slab": level(box(-9, -9, 40, 25), 0.0),
        "Ceiling": level(box(-2, -2, 25, 16), HIGH),
        "Wall.001": wall(*ring, gap=0.015),
        **more,
    }


@pytest.fixture
def written(tmp_path: Path) -> Callable[..., Path]:
    def write(
        meshes: Mapping[str, trimesh.Trimesh], suffix: str = ".glb", scale: float = 1.0
    ) -> Path:
        scene = trimesh.Scene()
        for name, mesh in meshes.items():
            scene.add_geometry(mesh, node_name=name, geom_name=name)
        scene.apply_scale(scale)
        if suffix == ".glb":
            scene.apply_transform(Z_UP_TO_Y_UP)
        path = tmp_path / f"Annex 2{suffix}"
        scene.export(path)
        return path

    return write


def test_level_faces_between_walls_become_the_floor(
    written: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    imported = import_mesh(written(corridor_mesh()))
    site = loaded(imported)

    assert site.name == "annex_2"
    assert site.walkable_floor.symmetric_difference(FLOOR).area < 0.01 * FLOOR.area
    assert [each.shape for each in site.turning_points] == ["corner"]
    assert site.ceiling_height == pytest.approx(HIGH)


def test_names_tell_doors_and_things(
    written: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    meshes = corridor_mesh(**{
        "Door_12": block(5, 2.35, 5.9, 2.5, 2.0),
        "VendingMachine.003": block(17.7, 8, 18.4, 9, 1.8),
        "Lamp": block(10, 1, 10.4, 1.4, 0.2).apply_translation((0, 0, 2.3)),
        "Cube.7": block(2, 0, 2.5, 0.4, 0.9),
    })

    imported = import_mesh(written(meshes))
    site = loaded(imported)

    (door,) = site.doors
    assert door.id == "door_12"
    assert door.line.distance(FLOOR.boundary) < 0.05
    (machine,) = site.landmarks
    assert (machine.category, machine.obstacle) == ("vending machine", True)
    assert machine.size == pytest.approx((1.0, 0.7, 1.8), abs=0.02)
    assert site.walkable_floor.contains(machine.position)
    assert not site.walkable_floor.contains(box(2.1, 0.1, 2.4, 0.3))
    assert any(
        "things that do not stand on the floor (1)" in line for line in imported.missing
    )


def test_things_and_doors_whose_names_are_alike_are_all_there(
    written: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    meshes = corridor_mesh(**{
        "Bench 1": block(2, 0.1, 3, 0.5, 0.5),
        "Bench-1": block(5, 0.1, 6, 0.5, 0.5),
        "bench_1": block(8, 0.1, 9, 0.5, 0.5),
        "Door Büro": block(5, 2.35, 5.9, 2.5, 2.0),
        "Door Bäro": block(9, 2.35, 9.9, 2.5, 2.0),
    })

    site = loaded(import_mesh(written(meshes)))

    assert {each.id for each in site.landmarks} == {"bench_1", "bench_1_2", "bench_1_3"}
    assert {each.id for each in site.doors} == {"door_b_ro", "door_b_ro_2"}


def test_a_room_behind_a_door_is_left_out_and_told(
    written: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    ring = [(5, 2.4), (0, 2.4), (0, 0), (20, 0), (20, 14), (17.6, 14), (17.6, 2.4)]
    meshes = corridor_mesh(**{
        "Wall.001": wall(*ring, (6, 2.4)),
        "Wall.002": wall((5, 2.4), (3, 2.4), (3, 6), (8, 6), (8, 2.4), (6, 2.4)),
        "Door_12": block(5, 2.39, 6, 2.41, 2.0),
    })

    imported = import_mesh(written(meshes))

    assert loaded(imported).walkable_floor.area == pytest.approx(FLOOR.area, rel=0.01)
    assert any("18 m² of other floor" in line for line in imported.missing)


@pytest.mark.parametrize(
    ("scale", "unit"),
    [(1.0, "metres"), (100.0, "centimetres"), (1000.0, "millimetres")],
)
def test_axis_and_unit_of_other_files_are_guessed_and_told(
    written: Callable[..., Path], loaded: Callable[..., Site], scale: float, unit: str
) -> None:
    imported = import_mesh(written(corridor_mesh(), ".obj", scale))

    assert loaded(imported).walkable_floor.area == pytest.approx(FLOOR.area, rel=0.01)
    assert imported.guessed[:2] == (
        "up: along z, where most faces are level",
        f"unit: {unit}, as the mesh is {HIGH * scale:.4g} high",
    )


def test_a_route_over_the_floor_of_a_mesh_can_be_driven(
    written: Callable[..., Path], tmp_path: Path
) -> None:
    machine = block(17.7, 10, 18.4, 11, 1.8)
    path = written(corridor_mesh(Vending_Machine=machine))
    plan = tmp_path / "annex.geojson"

    code = run_command_line([
        "sites", "import", str(path), "--from", "mesh", "--out", str(plan),
        "--route", "1,1.2", "the vending machine",
    ])  # fmt: skip

    assert code == 0
    check_site(plan)


def test_an_import_tells_which_things_have_no_look(
    written: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(corridor_mesh(Stuhl=block(17.7, 10, 18.4, 11, 1.0)))

    run_command_line([
        "sites", "import", str(path), "--from", "mesh", "--out",
        str(tmp_path / "annex.geojson"),
    ])  # fmt: skip

    out, err = capsys.readouterr()
    assert ":stuhl:known-look: warning: expected a category that has a look" in out
    assert err.endswith("0 errors, 1 warning\n")


def test_degenerate_faces_do_not_matter(
    written: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    sliver = trimesh.Trimesh(
        [(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2), (0, 0, 0)], process=False
    )

    site = loaded(import_mesh(written(corridor_mesh(Sliver_floor=sliver))))

    assert site.walkable_floor.area == pytest.approx(FLOOR.area, rel=0.01)


def test_a_door_of_several_materials_is_one_door(
    tmp_path: Path, tiny_sites: dict[str, Site], loaded: Callable[..., Site]
) -> None:
    site = tiny_sites["two_rooms"]
    export_site(site, "gltf", tmp_path / "exported.glb")

    imported = loaded(import_mesh(tmp_path / "exported.glb"))

    assert {each.id for each in imported.doors} == {each.id for each in site.doors}
    floor = site.walkable_floor
    assert imported.walkable_floor.symmetric_difference(floor).area < 0.005 * floor.area


@pytest.mark.parametrize("corner", ["tp_corner", "tp_at_the_door"])
def test_the_floor_of_an_exported_building_is_no_thing_and_no_door(
    tmp_path: Path, loaded: Callable[..., Site], corner: str
) -> None:
    plan = tmp_path / "annex.geojson"
    plan.write_bytes(new_plan("annex").replace(b"tp_corner", corner.encode()))
    site = load_site(plan)
    export_site(site, "gltf", tmp_path / "exported.glb")

    imported = import_mesh(tmp_path / "exported.glb")

    floor = site.walkable_floor
    back = loaded(imported).walkable_floor
    assert back.symmetric_difference(floor).area < 0.005 * floor.area
    assert len(imported.site.doors) == len(site.doors)
    assert len(imported.missing) == 1


def raw(tmp_path: Path, name: str, content: bytes) -> Path:
    (tmp_path / name).write_bytes(content)
    return tmp_path / name


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.stl", b"solid", "expected a mesh as .glb or .obj"),
        ("a.glb", b"", "expected a mesh as GLB"),
        ("a.glb", b"glTF\x02\0\0\0\xff\xff\xff\xff", "expected a mesh as GLB"),
        ("a.obj", b"v 0 0 0\n", "expected"),
        ("a.obj", b"v 0 0 nan\nv 1 0 0\nv 0 1 3\nf 1 2 3\n", "finite"),
        ("a.obj", b"v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n", "mesh of one floor"),
        ("a.obj", b"v 0 0 0\nv 9 0 2.5\nv 0 9 2.5\nf 1 2 3\n", "level faces to walk"),
        ("a.obj", b"v 0 0 0\nv .2 0 0\nv 0 .2 0\nv 0 0 2\nf 1 2 3\nf 2 3 4\n", "robot"),
    ],
)
def test_what_is_no_floor_is_refused_by_name(
    tmp_path: Path, name: str, content: bytes, message: str
) -> None:
    path = raw(tmp_path, name, content)

    with pytest.raises(ImportFileError, match=message) as refused:
        import_mesh(path)

    assert str(path) in str(refused.value)
