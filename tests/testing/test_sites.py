from pathlib import Path

import pytest

from memorymaze.testing import check_site
from memorymaze.world.sites import BUILTIN_SITE_NAMES, plan_file


@pytest.mark.parametrize("name", BUILTIN_SITE_NAMES)
def test_every_site_of_the_benchmark_keeps_the_contract(name: str) -> None:
    check_site(plan_file(name))


def test_every_tiny_site_keeps_the_contract(tiny_sites_folder: Path) -> None:
    for plan in sorted(tiny_sites_folder.glob("*.geojson")):
        check_site(plan)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        pytest.param(
            '"length_m": 16.0', '"length_m": 15.0', "without errors.*route-length"
        ),
        pytest.param(
            '"direction": "left"}],', '"direction": "left"}, ' * 2, "without errors"
        ),
        pytest.param(
            '"turns": [{"at": "tp_corner"', '"turns": [{"at": "tp_north_end"', "turns"
        ),
        pytest.param(
            "[[1, 0], [11, 0], [11, 6]]", "[[1, 0], [11, 0], [11, 5]]", "length"
        ),
        pytest.param(
            '"coordinates": [11.75, -0.75]', '"coordinates": [6, 0.0]', "clearance"
        ),
    ],
    ids=["length", "json", "turn elsewhere", "other line", "plant in the way"],
)
def test_a_plan_that_breaks_the_contract_is_told_how(
    tiny_sites_folder: Path, tmp_path: Path, old: str, new: str, said: str
) -> None:
    text = (tiny_sites_folder / "l_shape.geojson").read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "l_shape.geojson"
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(AssertionError, match=said):
        check_site(path)
