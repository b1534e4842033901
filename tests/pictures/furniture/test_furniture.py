"""Furniture models from a library to the picture of a thing."""

from pathlib import Path

import numpy as np
import pytest

from memorymaze.errors import SettingsError
from memorymaze.pictures.furniture.conversion import (
    build_cache,
    library_files,
    library_pieces,
)
from memorymaze.pictures.furniture.models import (
    cache_folder,
    check_looks,
    furniture_for,
)
from memorymaze.pictures.looks.assembly import Order

CONE = Order("traffic cone", 0.4, 0.4, 0.9)
TABLE = Order("table", 1.2, 0.8, 0.7)


def test_libraries_tell_names_sizes_and_creators(library_folder: Path) -> None:
    [library] = library_files(library_folder)
    cone, table = library_pieces(library).values()
    assert (cone.id, cone.name, cone.creator) == ("Scopia/cone", "Kägel", "Ada Maker")
    assert cone.size == (0.4, 0.4, 0.7)
    assert (table.creator, table.licence) == ("Scopia", "CC BY 3.0")


def test_converted_models_come_with_creators_and_licences(
    library_folder: Path, own_cache: Path
) -> None:
    told: list[str] = []
    made = build_cache(library_folder, told.append)
    assert {each.id for each in made} == {"Scopia/cone", "Scopia/table4"}
    assert [each.triangles for each in made] == [12, 12]
    page = (cache_folder() / "CREDITS.md").read_text(encoding="utf-8")
    assert "| Scopia/cone | Kägel | traffic cone | Ada Maker | CC BY 3.0 | 12 |" in page
    assert any("left out" in line for line in told)
    assert own_cache in cache_folder().parents


@pytest.mark.usefixtures("own_cache")
def test_a_model_fills_the_box_of_the_thing(library_folder: Path) -> None:
    build_cache(library_folder)
    model = furniture_for("traffic cone", CONE)
    assert model is not None
    assert np.allclose(model.bounds(), [(-0.2, -0.2, 0), (0.2, 0.2, 0.9)])
    assert model.parts[0].material.rgba == pytest.approx((1, 0.5, 0, 1), abs=0.01)


@pytest.mark.usefixtures("own_cache")
def test_things_of_other_proportions_and_things_with_words_stay_ours(
    library_folder: Path,
) -> None:
    build_cache(library_folder)
    assert furniture_for("traffic cone", Order("cone", 0.4, 0.4, 2.0)) is None
    assert (
        furniture_for("traffic cone", Order("cone", 0.4, 0.4, 0.9, text="No")) is None
    )
    assert furniture_for("sofa", Order("sofa", 1.9, 0.8, 0.8)) is None


@pytest.mark.usefixtures("own_cache")
def test_the_colour_of_the_plan_goes_over_the_picture(library_folder: Path) -> None:
    build_cache(library_folder)
    plain = furniture_for("table", TABLE)
    blue = furniture_for("table", Order("table", 1.2, 0.8, 0.7, "blue"))
    assert plain is not None
    assert blue is not None
    first, second = (model.parts[0].material.texture for model in (plain, blue))
    assert first is not None
    assert second is not None
    assert first.shape == (256, 128, 3)
    red, _, dark = first.reshape(-1, 3).mean(axis=0)
    assert red > dark
    red, _, light = second.reshape(-1, 3).mean(axis=0)
    assert light > red


@pytest.mark.usefixtures("own_cache")
def test_models_are_used_once_converted_unless_the_user_says_otherwise(
    library_folder: Path,
) -> None:
    assert check_looks(None) == "own"
    with pytest.raises(SettingsError, match="memorymaze sites models"):
        check_looks("models")
    build_cache(library_folder)
    assert check_looks(None) == "models"
    assert check_looks("models") == "models"
    assert check_looks("own") == "own"


def test_looks_of_another_name_are_refused() -> None:
    with pytest.raises(SettingsError, match=r"own, models, mesh; got 'blender'"):
        check_looks("blender")  # pyright: ignore[reportArgumentType]


@pytest.mark.usefixtures("own_cache")
def test_no_environment_variable_changes_the_looks(
    library_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build_cache(library_folder)
    monkeypatch.setenv("MEMORYMAZE_LOOKS", "own")
    assert check_looks(None) == "models"


@pytest.mark.usefixtures("own_cache")
def test_a_damaged_cache_is_told_with_what_to_do(library_folder: Path) -> None:
    build_cache(library_folder)
    (cache_folder() / "Scopia-cone.npz").write_bytes(b"no model")
    with pytest.raises(SettingsError, match=r"Scopia-cone\.npz.*sites models"):
        furniture_for("traffic cone", CONE)


def test_a_folder_without_libraries_is_told_with_what_to_install(
    tmp_path: Path,
) -> None:
    with pytest.raises(SettingsError, match="sweethome3d-furniture"):
        library_files(tmp_path)
    (tmp_path / "Scopia.sh3f").write_bytes(b"no archive")
    with pytest.raises(SettingsError, match=r"Scopia\.sh3f: expected a furniture"):
        library_pieces(tmp_path / "Scopia.sh3f")
