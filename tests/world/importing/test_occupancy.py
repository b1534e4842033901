import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from shapely import Point

from memorymaze.basics.errors import ImportFileError
from memorymaze.world.importing.occupancy import read_occupancy

MAP = {
    "image": "map.pgm",
    "resolution": 0.05,
    "origin": [-1.0, 2.0, 0.0],
    "negate": 0,
    "occupied_thresh": 0.65,
    "free_thresh": 0.196,
}
WALL, FREE, UNKNOWN = 0, 254, 205


def written(folder: Path, shades: list[list[int]], **changed: object) -> Path:
    """Write a map; a member that is None is left out."""
    Image.fromarray(np.array(shades, dtype=np.uint8)).save(folder / "map.pgm")
    members = {**MAP, **changed}
    (folder / "map.yaml").write_text(
        "".join(
            f"{key}: {value}\n" for key, value in members.items() if value is not None
        )
    )
    return folder / "map.yaml"


def test_the_first_row_is_the_south_of_the_map(tmp_path: Path) -> None:
    grid = read_occupancy(written(tmp_path, [[WALL, WALL], [FREE, UNKNOWN]]))

    assert grid.free.tolist() == [[True, False], [False, False]]
    assert grid.occupied.tolist() == [[False, False], [True, True]]


@pytest.mark.parametrize(
    ("changed", "shade", "is_free", "is_occupied"),
    [
        pytest.param({}, 255, True, False, id="white is free"),
        pytest.param({"negate": 1}, 255, False, True, id="white negated"),
        pytest.param({"free_thresh": 0.1}, 220, False, False, id="between thresholds"),
        pytest.param({"mode": "scale"}, 240, True, False, id="scale"),
        pytest.param({"mode": "raw"}, 0, True, False, id="raw 0 is free"),
        pytest.param({"mode": "raw"}, 100, False, True, id="raw 100 is occupied"),
        pytest.param({"mode": "raw"}, 255, False, False, id="raw 255 is unknown"),
    ],
)
def test_cells_mean_what_the_map_server_says(
    tmp_path: Path,
    changed: dict[str, object],
    shade: int,
    is_free: bool,
    is_occupied: bool,
) -> None:
    grid = read_occupancy(written(tmp_path, [[shade]], **changed))

    assert (grid.free[0, 0], grid.occupied[0, 0]) == (is_free, is_occupied)


def test_transparent_cells_are_unknown_in_mode_scale(tmp_path: Path) -> None:
    path = written(tmp_path, [[FREE]], image="map.png", mode="scale")
    Image.fromarray(np.array([[[255, 0], [255, 255]]], dtype=np.uint8)).save(
        tmp_path / "map.png"
    )

    assert read_occupancy(path).free.tolist() == [[False, True]]


def test_what_map_saver_wrote_as_unknown_is_unknown(tmp_path: Path) -> None:
    path = written(tmp_path, [[FREE, UNKNOWN, WALL]], free_thresh=0.25)

    grid = read_occupancy(path)

    assert grid.free.tolist() == [[True, False, False]]
    assert grid.unknown_as_saved == 1


def test_the_same_shade_in_another_picture_is_left_to_its_threshold(
    tmp_path: Path,
) -> None:
    path = written(tmp_path, [[FREE, UNKNOWN, 230, WALL]], free_thresh=0.25)

    grid = read_occupancy(path)

    assert grid.free.tolist() == [[True, True, True, False]]
    assert grid.unknown_as_saved == 0


def test_cells_are_placed_as_the_origin_says(tmp_path: Path) -> None:
    path = written(tmp_path, [[FREE]], origin=[1.0, 2.0, math.pi / 2])

    placed = read_occupancy(path).in_map(Point(20, 0))

    assert (placed.x, placed.y) == pytest.approx((1.0, 3.0))


def test_sixteen_bits_are_shades_too(tmp_path: Path) -> None:
    path = written(tmp_path, [[FREE]], image="map.png")
    Image.fromarray(np.array([[0, 65535]], dtype=np.uint16)).save(tmp_path / "map.png")

    assert read_occupancy(path).free.tolist() == [[False, True]]


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        pytest.param({"resolution": ".nan"}, "resolution: expected", id="nan"),
        pytest.param({"resolution": 0}, "resolution: expected", id="zero"),
        pytest.param({"resolution": None}, "resolution: expected this", id="missing"),
        pytest.param({"origin": "[0, 0]"}, r"origin\[2\]: expected", id="short origin"),
        pytest.param(
            {"origin": "[.inf, 0, 0]"}, r"origin\[0\]: expected", id="infinite"
        ),
        pytest.param({"mode": "ternary"}, "mode: expected 'trinary'", id="mode"),
        pytest.param({"free_thresh": 0.9}, "free_thresh: expected at", id="thresholds"),
        pytest.param({"image": "gone.pgm"}, "there is no .*gone.pgm", id="no image"),
        pytest.param({"image": "map.yaml"}, "expected an image", id="no picture"),
        pytest.param({"image": "."}, "there is no", id="folder"),
        pytest.param(
            {"resolution": "{a: [1, 2"}, r"yaml:\d: expected YAML", id="syntax"
        ),
        pytest.param({"negate": "&a 0"}, "got a reference .* line 4", id="reference"),
        pytest.param(
            {"free_tresh": 0.1, "free_thresh": None}, "did you mean", id="typo"
        ),
        pytest.param({"origin": "[" * 1000 + "]" * 1000}, "nested too deep", id="deep"),
    ],
)
def test_a_map_that_says_nothing_usable_is_refused_by_name(
    tmp_path: Path, changed: dict[str, object], message: str
) -> None:
    path = written(tmp_path, [[FREE]], **changed)

    with pytest.raises(ImportFileError, match=message) as refused:
        read_occupancy(path)

    assert str(tmp_path) in str(refused.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        pytest.param("", "got none", id="empty"),
        pytest.param("- 1\n", "got none", id="list"),
        pytest.param("image: a\nimage: b\n", "expected it once", id="twice"),
        pytest.param("# " + "x" * 70_000, "at most 65536", id="long"),
        pytest.param("image: !!python/object:os.x {}\n", "expected YAML", id="object"),
    ],
)
def test_other_yaml_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "map.yaml"
    path.write_text(text)

    with pytest.raises(ImportFileError, match=message):
        read_occupancy(path)


def test_an_image_with_too_many_cells_is_refused_unread(tmp_path: Path) -> None:
    path = written(tmp_path, [[FREE]])
    (tmp_path / "map.pgm").write_bytes(b"P5 8000 8000 255\n")

    with pytest.raises(ImportFileError, match="8000 by 8000; cut the map"):
        read_occupancy(path)


def test_an_image_that_ends_early_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path, [[FREE]])
    (tmp_path / "map.pgm").write_bytes(b"P5 80 80 255\n123")

    with pytest.raises(ImportFileError, match=r"map\.pgm: expected an image"):
        read_occupancy(path)
