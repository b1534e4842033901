from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from benchmarks.noisy_maps import Noise, write_map
from shapely import box

from memorymaze.basics.errors import ImportFileError, SettingsError
from memorymaze.front.cli.main import run_command_line
from memorymaze.testing import check_site
from memorymaze.world.importing.ros_map import import_ros_map
from memorymaze.world.sites import Site, load_site

FLOOR = box(0, 0, 20, 2.4) | box(17.6, 0, 20, 14) | box(8, 0, 10.4, 9)
CLEAN = Noise()
ROOM = box(4, 2.4, 4.9, 2.6) | box(2, 2.6, 7, 8)


@pytest.fixture
def mapped(tmp_path: Path) -> Callable[..., Path]:
    def write(noise: Noise = CLEAN, floor: object = FLOOR, seed: int = 3) -> Path:
        rng = np.random.default_rng(seed)
        return write_map(tmp_path / "office", floor, noise, rng)[0]

    return write


def test_a_map_becomes_corridors_and_turning_points(
    mapped: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    imported = import_ros_map(mapped())
    site = loaded(imported)

    assert site.walkable_floor.symmetric_difference(FLOOR).area < 0.02 * FLOOR.area
    assert sorted(each.shape for each in site.turning_points) == [
        "corner",
        "t_junction",
    ]
    assert "520 by 400 cells of 0.05 m, in the map's own frame" in " ".join(
        imported.took
    )
    assert "rooms, doors, names" in imported.missing[-1]


def test_a_noisy_map_of_a_building_askew_gives_the_same_ways(
    mapped: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    noise = Noise(ragged=0.04, specks=0.02, missing_wall=0.05, turned_deg=23)

    site = loaded(import_ros_map(mapped(noise)))

    assert site.walkable_floor.area == pytest.approx(FLOOR.area, rel=0.05)
    assert sorted(each.shape for each in site.turning_points) == [
        "corner",
        "t_junction",
    ]


def test_a_route_over_the_floor_of_a_map_can_be_driven(
    mapped: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = mapped(CLEAN, FLOOR - box(18.6, 12.4, 19.0, 12.8))
    plan = tmp_path / "annex.geojson"

    code = run_command_line([
        "sites", "import", str(path), "--from", "ros_map", "--out", str(plan),
        "--route", "1,1.2", "box_1",
    ])  # fmt: skip

    assert code == 0
    assert "guessed: 1 obstacle that stands free" in capsys.readouterr().out
    assert [each.category for each in load_site(plan).landmarks] == ["box"]
    check_site(plan)


def test_rooms_behind_doors_are_kept_or_left_out_as_told(
    mapped: Callable[..., Path], loaded: Callable[..., Site]
) -> None:
    path = mapped(CLEAN, FLOOR | ROOM)

    whole = loaded(import_ros_map(path))
    imported = import_ros_map(path, narrowest=1.2)

    assert whole.walkable_floor.area == pytest.approx((FLOOR | ROOM).area, rel=0.02)
    assert loaded(imported).walkable_floor.area == pytest.approx(FLOOR.area, rel=0.02)
    assert imported.missing[0].startswith("26 m² of free cells behind ways narrower")


def test_an_edge_that_nobody_saw_is_told(mapped: Callable[..., Path]) -> None:
    path = mapped(Noise(missing_wall=0.5))

    assert any("the map ends there" in line for line in import_ros_map(path).missing)


def test_a_map_without_floor_is_refused_by_name(mapped: Callable[..., Path]) -> None:
    path = mapped(floor=box(0, 0, 5, 0.3))

    with pytest.raises(ImportFileError, match=r"map\.yaml: expected floor for a robot"):
        import_ros_map(path)


def test_a_map_whose_cells_make_too_large_a_floor_is_refused_by_its_resolution(
    mapped: Callable[..., Path],
) -> None:
    path = mapped()
    text = path.read_text("utf-8").replace("resolution: 0.05", "resolution: 5")
    path.write_text(text, "utf-8")

    with pytest.raises(ImportFileError, match=r"map\.yaml: expected .* which is 5,"):
        import_ros_map(path)


@pytest.mark.parametrize("narrowest", [0.0, -1.0, float("nan"), float("inf")])
def test_a_width_without_meaning_is_refused(
    mapped: Callable[..., Path], narrowest: float
) -> None:
    with pytest.raises(SettingsError, match="narrowest: expected metres"):
        import_ros_map(mapped(), narrowest=narrowest)
