"""A building as OpenUSD: a folder with one `.usdc` and its pictures, z up, metres."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import (
    Gf,
    Kind,
    Sdf,
    Tf,
    Usd,
    UsdGeom,
    UsdPhysics,
    UsdSemantics,
    UsdShade,
    Vt,
)

from memorymaze.basics.durable_files import new_folder
from memorymaze.world.exporting.named_materials import (
    NamedMaterial,
    NamedMaterials,
    linear,
    png_of,
)
from memorymaze.world.exporting.named_meshes import (
    FLOOR_FEATURES,
    Attributes,
    NamedMesh,
    named_meshes,
    plan_members,
    site_file_stem,
)
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.sites.records import Site

TEXTURES = "textures"
SOLID_KINDS = (*FLOOR_FEATURES, "wall")
"""What a robot stands on or drives against, beside obstacles."""


def write_usd(site: Site, out: Path) -> list[Path]:
    """Write a building as a folder with `NAME.usdc`."""
    stage = _Stage(site)
    for mesh in named_meshes(site):
        stage.add(mesh)
    stage.add_materials()
    with new_folder(out) as folder:
        (folder / TEXTURES).mkdir()
        names = [f"{site_file_stem(site)}.usdc"]
        stage.stage.GetRootLayer().Export(str(folder / names[0]))
        for name, pixels in stage.materials.pictures:
            names.append(f"{TEXTURES}/{name}.png")
            (folder / names[-1]).write_bytes(png_of(pixels))
    return [out / name for name in names]


class _Stage:
    """A stage that grows: a prim per mesh under one that stands for the site."""

    def __init__(self, site: Site) -> None:
        self.stage = Usd.Stage.CreateInMemory()
        self.materials = NamedMaterials()
        UsdGeom.SetStageMetersPerUnit(self.stage, 1.0)
        UsdGeom.SetStageUpAxis(self.stage, UsdGeom.Tokens.z)
        self._root = f"/{Tf.MakeValidIdentifier(site.name)}"
        self._taken = {"Materials"}
        root = UsdGeom.Xform.Define(self.stage, self._root).GetPrim()
        Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
        self.stage.SetDefaultPrim(root)
        UsdGeom.Scope.Define(self.stage, f"{self._root}/Materials")
        _describe(root, site.name, plan_members(site))

    def add(self, mesh: NamedMesh) -> None:
        """Add a prim with a mesh per material."""
        placed = mesh.placed
        path = f"{self._root}/{self._free(mesh.name)}"
        frame = UsdGeom.Xform.Define(self.stage, path)
        if (placed.x, placed.y, placed.z) != (0.0, 0.0, 0.0):
            frame.AddTranslateOp().Set(Gf.Vec3d(placed.x, placed.y, placed.z))
        if placed.heading:
            frame.AddRotateZOp().Set(math.degrees(placed.heading))
        prim = frame.GetPrim()
        _describe(prim, mesh.name, mesh.attributes)
        UsdSemantics.LabelsAPI.Apply(prim, "class").CreateLabelsAttr([mesh.label])
        is_solid = mesh.kind in SOLID_KINDS or mesh.attributes.get("obstacle") is True
        for number, (part, look) in enumerate(self.materials.of(mesh)):
            made = self._mesh(f"{path}/mesh_{number}", part.with_normals(), look)
            if is_solid:
                UsdPhysics.CollisionAPI.Apply(made)

    def add_materials(self) -> None:
        """Write the materials; once, after all meshes."""
        for look in self.materials.all:
            self._material(look)

    def _mesh(self, path: str, part: MeshPart, look: NamedMaterial) -> Any:
        assert part.normals is not None
        mesh = UsdGeom.Mesh.Define(self.stage, path)
        points = Vt.Vec3fArray.FromNumpy(_rows(part.vertices))
        mesh.CreatePointsAttr(points)
        mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
        mesh.CreateFaceVertexCountsAttr([3] * len(part.faces))
        corners = np.ascontiguousarray(part.faces, dtype=np.int32).ravel()
        mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(corners))
        mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
        mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(_rows(part.normals)))
        mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
        if look.picture is not None and part.uv is not None:
            # Here pictures begin at the bottom.
            upwards = np.column_stack([part.uv[:, 0], 1 - part.uv[:, 1]])
            UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
                "st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex
            ).Set(Vt.Vec2fArray.FromNumpy(_rows(upwards)))
        binding = UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim())
        material = UsdShade.Material.Define(self.stage, self._path_of(look))
        binding.Bind(material)
        return mesh.GetPrim()

    def _material(self, look: NamedMaterial) -> None:
        path = self._path_of(look)
        material = UsdShade.Material.Define(self.stage, path)
        shader = UsdShade.Shader.Define(self.stage, f"{path}/surface")
        shader.CreateIdAttr("UsdPreviewSurface")
        types = Sdf.ValueTypeNames
        seen = look.material
        colour = linear(seen.rgba[:3])
        glow = [seen.emission * each for each in colour]
        shader.CreateInput("metallic", types.Float).Set(0.0)
        shader.CreateInput("roughness", types.Float).Set(1.0 - seen.shininess)
        diffuse = shader.CreateInput("diffuseColor", types.Color3f)
        emissive = shader.CreateInput("emissiveColor", types.Color3f)
        opacity = shader.CreateInput("opacity", types.Float)
        if look.picture is None:
            diffuse.Set(Gf.Vec3f(*colour))
            emissive.Set(Gf.Vec3f(*glow))
            opacity.Set(seen.rgba[3])
        else:
            picture = self._picture(path, "picture", look, (*colour, seen.rgba[3]))
            diffuse.ConnectToSource(picture.CreateOutput("rgb", types.Float3))
            if seen.is_clear:
                opacity.ConnectToSource(picture.CreateOutput("a", types.Float))
            if seen.emission:
                shining = self._picture(path, "glow", look, (*glow, 1.0))
                emissive.ConnectToSource(shining.CreateOutput("rgb", types.Float3))
        material.CreateSurfaceOutput().ConnectToSource(
            shader.ConnectableAPI(), "surface"
        )

    def _picture(
        self, path: str, name: str, look: NamedMaterial, scale: tuple[float, ...]
    ) -> Any:
        types = Sdf.ValueTypeNames
        reader = UsdShade.Shader.Define(self.stage, f"{path}/st")
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", types.String).Set("st")
        shader = UsdShade.Shader.Define(self.stage, f"{path}/{name}")
        shader.CreateIdAttr("UsdUVTexture")
        assert look.picture is not None
        file = f"./{TEXTURES}/{self.materials.pictures[look.picture][0]}.png"
        shader.CreateInput("file", types.Asset).Set(Sdf.AssetPath(file))
        shader.CreateInput("sourceColorSpace", types.Token).Set("sRGB")
        shader.CreateInput("scale", types.Float4).Set(Gf.Vec4f(*scale))
        for way in ("wrapS", "wrapT"):
            shader.CreateInput(way, types.Token).Set("repeat")
        shader.CreateInput("st", types.Float2).ConnectToSource(
            reader.CreateOutput("result", types.Float2)
        )
        return shader

    def _path_of(self, look: NamedMaterial) -> str:
        return f"{self._root}/Materials/{look.name}"

    def _free(self, wanted: str) -> str:
        """Return a prim's name like the one wanted: letters, digits, underscores."""
        like = Tf.MakeValidIdentifier(wanted)
        name, number = like, 2
        while name in self._taken:
            name, number = f"{like}_{number}", number + 1
        self._taken.add(name)
        return name


def _describe(prim: Any, name: str, attributes: Attributes) -> None:
    """Keep a name as it is, and attributes where other programs show them."""
    types = Sdf.ValueTypeNames
    prim.SetDisplayName(name)
    for key, value in attributes.items():
        kind = types.Bool if isinstance(value, bool) else types.String
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            kind, value = types.Double, float(value)
        elif not isinstance(value, (str, bool)):
            value = json.dumps(value, ensure_ascii=False)
        prim.CreateAttribute(f"userProperties:{key}", kind, custom=True).Set(value)


def _rows(values: NDArray[Any]) -> NDArray[np.float32]:
    return np.ascontiguousarray(values, dtype=np.float32)
