from pathlib import Path

import pytest
from pxr import Usd, UsdGeom, UsdSemantics, UsdShade, UsdValidation

from memorymaze.basics.errors import SettingsError
from memorymaze.world.construction import make_building
from memorymaze.world.exporting import export_site
from memorymaze.world.sites import Site
from memorymaze.world.sites.plan import site_plan


@pytest.fixture(scope="module")
def corridor_usd(corridor_site: Site, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("usd") / "exported"
    files = export_site(corridor_site, "usd", out)
    assert sorted(files) == sorted(each for each in out.rglob("*") if each.is_file())
    assert files[0] == out / "corridor.usdc"
    return files[0]


def errors_in(path: Path) -> list[str]:
    """What all validators that come with OpenUSD find."""
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) > 20
    context = UsdValidation.ValidationContext(validators)
    found = context.Validate(Usd.Stage.Open(str(path)))
    return [each.GetErrorAsString() for each in found]


def test_openusd_finds_nothing_wrong_with_a_small_building(corridor_usd: Path):
    assert errors_in(corridor_usd) == []


def test_openusd_would_find_what_is_wrong(corridor_usd: Path):
    picture = next(corridor_usd.parent.glob("textures/*.png"))
    moved = picture.rename(picture.with_suffix(".away"))
    assert any(picture.name in each for each in errors_in(corridor_usd))
    moved.rename(picture)


def test_a_stage_is_in_metres_with_z_up(corridor_usd: Path):
    stage = Usd.Stage.Open(str(corridor_usd))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z


def test_every_feature_is_a_prim_with_its_properties_and_a_class(
    corridor_usd: Path, corridor_site: Site
):
    stage = Usd.Stage.Open(str(corridor_usd))
    prims = {
        each.GetDisplayName(): each
        for each in stage.GetPrimAtPath("/corridor").GetChildren()
    }
    door, bench = corridor_site.doors[0], corridor_site.landmarks[0]
    for feature in site_plan(corridor_site)["features"]:
        if feature["properties"]["kind"] == "route":
            continue
        prim = prims[feature["id"]]
        assert prim.GetAttribute("userProperties:id").Get() == feature["id"]
        kind = prim.GetAttribute("userProperties:kind").Get()
        assert kind == feature["properties"]["kind"]
    assert prims[door.id].GetAttribute("userProperties:room").Get() == door.room
    labels = UsdSemantics.LabelsAPI(prims[bench.id], "class").GetLabelsAttr().Get()
    assert list(labels) == [bench.category]


def test_things_stand_where_the_plan_has_them(corridor_usd: Path, corridor_site: Site):
    stage = Usd.Stage.Open(str(corridor_usd))
    bounds = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default"])
    for thing in corridor_site.landmarks:
        box = bounds.ComputeWorldBound(stage.GetPrimAtPath(f"/corridor/{thing.id}"))
        extent = box.ComputeAlignedRange()
        west, south, east, north = thing.footprint.bounds
        assert list(extent.GetMin()) == pytest.approx([west, south, 0.0], abs=1e-3)
        assert list(extent.GetMax()) == pytest.approx(
            [east, north, thing.size[2]], abs=1e-3
        )


def test_every_mesh_has_a_material(corridor_usd: Path):
    stage = Usd.Stage.Open(str(corridor_usd))
    meshes = [each for each in stage.Traverse() if each.IsA(UsdGeom.Mesh)]
    assert meshes
    for mesh in meshes:
        material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
        assert material.ComputeSurfaceSource()[0].GetShaderId() == "UsdPreviewSurface"


def test_without_the_package_it_says_what_to_install(
    corridor_site: Site, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("memorymaze.basics.extras.is_installed", lambda *_: False)
    with pytest.raises(SettingsError, match=r"--to usd: the package pxr .*\[usd\]"):
        export_site(corridor_site, "usd", tmp_path / "exported")


@pytest.mark.proof
def test_openusd_finds_nothing_wrong_with_large_buildings(
    builtin_sites: dict[str, Site], tmp_path: Path
):
    for site in (*builtin_sites.values(), make_building("hospital", 3)):
        files = export_site(site, "usd", tmp_path / site.name)
        assert errors_in(files[0]) == [], site.name
