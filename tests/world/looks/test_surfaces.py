from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from memorymaze.basics.errors import SitePlanError
from memorymaze.world.looks import OWN, surfaces
from memorymaze.world.looks.building import building
from memorymaze.world.sites import load_site
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


@pytest.mark.parametrize(
    ("feature", "member", "known"),
    [
        ("corridor", "floor_material", "carpet, linoleum, wood, concrete, tile"),
        ("corridor", "wall_material", "plaster, glass, wood_panel, brick, concrete"),
        ("door_1", "style", "wood, glass, steel, automatic_glass, elevator, fire"),
    ],
)
def test_a_word_that_has_no_look_is_named_with_its_file_and_feature(
    changed: Callable[..., Path], feature: str, member: str, known: str
) -> None:
    path = changed("corridor", feature, {f"properties.{member}": "lava"})
    with pytest.raises(SitePlanError) as refused:
        building(load_site(path), OWN)
    assert str(refused.value) == (
        f"{path}: {feature}: known-word: {member}: expected one of {known}, got 'lava', "
        "which is refused by cameras and exports"
    )
