import numpy as np
import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.world.looks import surfaces
from memorymaze.world.sites.checking import FLOOR_MATERIALS


@pytest.mark.parametrize("name", FLOOR_MATERIALS)
def test_floors_repeat_without_a_seam(name: str) -> None:
    texture = surfaces.floor(name).texture
    assert texture is not None
    # Joints of tiles lie on the edges; what they enclose must go on as if uncut.
    for picture in (texture.astype(float), texture.swapaxes(0, 1).astype(float)):
        across = np.abs(picture[:, 6:18].mean(axis=1) - picture[:, -18:-6].mean(axis=1))
        inside = np.abs(
            picture[:, 90:102].mean(axis=1) - picture[:, 66:78].mean(axis=1)
        )
        assert across.mean() < 2.5 * inside.mean() + 3


def test_pictures_are_the_same_in_every_process() -> None:
    first = surfaces.floor("carpet").texture
    surfaces.floor.cache_clear()
    second = surfaces.floor("carpet").texture
    assert first is not second
    np.testing.assert_array_equal(first, second)


def test_materials_can_be_told_apart() -> None:
    means = {
        (kind.__name__, name): tuple(kind(name).texture.mean(axis=(0, 1)).round())
        for kind, names in (
            (surfaces.floor, FLOOR_MATERIALS),
            (surfaces.wall, ("plaster", "wood_panel", "brick", "concrete")),
        )
        for name in names
    }
    assert len(set(means.values())) == len(means)


@pytest.mark.parametrize("kind", [surfaces.floor, surfaces.wall])
def test_an_unknown_material_is_named(kind) -> None:
    with pytest.raises(SettingsError, match="got 'lava'"):
        kind("lava")
