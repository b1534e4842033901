"""Reads GLB files (glTF 2.0 in one binary file): meshes, how they stretch, materials.

What it gives is in the frame of `ObjectModel`: glTF has y up and the front along z.
"""

import io
import json
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.points import FloatArray, IntArray
from memorymaze.basics.input_files import read_file
from memorymaze.world.looks.materials import Material, srgb

HEADER = struct.Struct("<III")
MAGIC, VERSION, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
COMPONENTS = {
    5120: "i1",
    5121: "u1",
    5122: "<i2",
    5123: "<u2",
    5125: "<u4",
    5126: "<f4",
}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
TRIANGLES = 4
LARGEST_PICTURE = 512
"""Pixels along a side; larger pictures are shrunk."""
UNDERSTOOD = {"KHR_mesh_quantization", "KHR_materials_unlit"}
"""Extensions that a file may require."""
OURS = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""From glTF's frame (x to the thing's left, y up, z to its front) to ours."""

_Json = dict[str, Any]


@dataclass(frozen=True, slots=True, eq=False)
class GlbMaterial:
    """A material as the file has it, with its name, which may say what it stands for."""

    name: str
    look: Material
    extras: Mapping[str, Any]


@dataclass(frozen=True, slots=True, eq=False)
class GlbPrimitive:
    """Triangles of one material, in metres."""

    vertices: FloatArray
    faces: IntArray
    normals: FloatArray
    uv: FloatArray | None
    targets: Mapping[str, FloatArray]
    """By the name of a morph target: how far each vertex goes, (N, 3)."""
    material: GlbMaterial

    def moved(self, shift: FloatArray) -> "GlbPrimitive":
        """Return it somewhere else."""
        return replace(self, vertices=self.vertices + shift)


@dataclass(frozen=True, slots=True, eq=False)
class GlbNode:
    """A node with its own triangles, where the file puts them."""

    name: str
    place: FloatArray
    """Its origin."""
    primitives: tuple[GlbPrimitive, ...]
    extras: Mapping[str, Any]
    children: tuple["GlbNode", ...]

    def all(self) -> Iterator["GlbNode"]:
        """Yield it and all below it."""
        yield self
        for child in self.children:
            yield from child.all()


def read_glb(path: Path) -> tuple[GlbNode, ...]:
    """Return the nodes at the top of a file's scene.

    Raises:
        SettingsError: It is no GLB file, or holds what is not understood.
    """
    content = read_file(path, SettingsError)
    chunks = dict(_chunks(path, content))
    try:
        document = json.loads(chunks[JSON_CHUNK])
        return _Reader(path, document, chunks.get(BINARY_CHUNK, b"")).nodes()
    except (KeyError, IndexError, TypeError, ValueError, OSError) as problem:
        raise SettingsError(
            f"{path}: expected glTF 2.0 in a GLB file, got a damaged one "
            f"({type(problem).__name__}: {problem}); export it anew"
        ) from None


def _chunks(path: Path, content: bytes) -> Iterator[tuple[int, bytes]]:
    magic, version, _ = HEADER.unpack(content[:12].ljust(12, b"\0"))
    if magic != MAGIC or version != VERSION:
        raise SettingsError(
            f"{path}: expected a GLB file (glTF 2.0, binary), got another format; in "
            "Blender: File, Export, glTF 2.0, format glTF Binary (.glb)"
        )
    at = 12
    while at + 8 <= len(content):
        size, kind = struct.unpack_from("<II", content, at)
        yield kind, content[at + 8 : at + 8 + size]
        at += 8 + size


@dataclass(eq=False)
class _Reader:
    path: Path
    document: _Json
    binary: bytes
    _materials: dict[int, GlbMaterial] = field(default_factory=dict)
    _pictures: dict[int, NDArray[np.uint8]] = field(default_factory=dict)

    def nodes(self) -> tuple[GlbNode, ...]:
        document = self.document
        for name in document.get("extensionsRequired", ()):
            if name not in UNDERSTOOD:
                raise SettingsError(
                    f"{self.path}: expected plain glTF, got the extension {name}; export "
                    "it without (Blender: Data, Compression off)"
                )
        scenes = document.get("scenes")
        if scenes:
            roots = scenes[document.get("scene", 0)].get("nodes", [])
        else:
            roots = range(len(document.get("nodes", ())))
        return tuple(self._node(number, np.eye(4)) for number in roots)

    def _node(self, number: int, above: FloatArray) -> GlbNode:
        node = self.document["nodes"][number]
        matrix = above @ _local(node)
        name = str(node.get("name", f"node {number}"))
        primitives: tuple[GlbPrimitive, ...] = ()
        if "mesh" in node:
            mesh = self.document["meshes"][node["mesh"]]
            primitives = tuple(
                self._primitive(name, mesh, each, matrix) for each in mesh["primitives"]
            )
        return GlbNode(
            name,
            OURS @ matrix[:3, 3],
            primitives,
            node.get("extras") or {},
            tuple(self._node(child, matrix) for child in node.get("children", ())),
        )

    def _primitive(
        self, name: str, mesh: _Json, primitive: _Json, matrix: FloatArray
    ) -> GlbPrimitive:
        if primitive.get("mode", TRIANGLES) != TRIANGLES:
            raise SettingsError(
                f"{self.path}: node {name!r}: expected triangles, got lines, points or "
                "strips; export it as a mesh of triangles"
            )
        attributes = primitive["attributes"]
        linear = OURS @ matrix[:3, :3]
        vertices = self._array(attributes["POSITION"])
        if "indices" in primitive:
            faces = self._array(primitive["indices"]).astype(np.int64).reshape(-1, 3)
        else:
            faces = np.arange(len(vertices)).reshape(-1, 3)
        if np.linalg.det(linear) < 0:
            faces = faces[:, ::-1]
        normals = None
        if "NORMAL" in attributes:
            normals = self._array(attributes["NORMAL"]) @ np.linalg.pinv(linear)
            normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        uv = None
        if "TEXCOORD_0" in attributes:
            uv = self._array(attributes["TEXCOORD_0"])
        names = (mesh.get("extras") or {}).get("targetNames", ())
        targets = {
            str(called).lower(): self._array(target["POSITION"]) @ linear.T
            for called, target in zip(names, primitive.get("targets", ()), strict=False)
        }
        vertices = vertices @ linear.T + OURS @ matrix[:3, 3]
        material = self._material(primitive.get("material"))
        if normals is None:
            chosen, faces, normals = _flat(vertices, faces)
            vertices, uv = vertices[chosen], None if uv is None else uv[chosen]
            targets = {called: shift[chosen] for called, shift in targets.items()}
        return GlbPrimitive(vertices, faces, normals, uv, targets, material)

    def _material(self, number: int | None) -> GlbMaterial:
        key = -1 if number is None else number
        if key not in self._materials:
            made = {} if number is None else self.document["materials"][number]
            plain = made.get("pbrMetallicRoughness", {})
            colour = plain.get("baseColorFactor", (1.0, 1.0, 1.0, 1.0))
            glow, light = (
                max(made.get("emissiveFactor", (0.0,))),
                max(*colour[:3], 1e-3),
            )
            picture = plain.get("baseColorTexture")
            look = Material(
                (
                    *srgb(colour[:3]),
                    float(colour[3]) if made.get("alphaMode") == "BLEND" else 1.0,
                ),
                None if picture is None else self._picture(picture["index"]),
                round(min(1.0, glow / light), 2),
                round(1.0 - plain.get("roughnessFactor", 0.9), 3),
            )
            name = str(made.get("name", ""))
            self._materials[key] = GlbMaterial(name, look, made.get("extras") or {})
        return self._materials[key]

    def _picture(self, texture: int) -> NDArray[np.uint8]:
        number = self.document["textures"][texture]["source"]
        if number not in self._pictures:
            image = self.document["images"][number]
            if "bufferView" not in image:
                raise SettingsError(
                    f"{self.path}: expected pictures inside of the file, got "
                    f"{str(image.get('uri'))[:60]}; export it as one GLB file"
                )
            view = self.document["bufferViews"][image["bufferView"]]
            start = view.get("byteOffset", 0)
            data = self.binary[start : start + view["byteLength"]]
            shown = Image.open(io.BytesIO(data)).convert("RGB")
            shown.thumbnail((LARGEST_PICTURE, LARGEST_PICTURE))
            pixels = np.array(shown, dtype=np.uint8)
            pixels.flags.writeable = False
            self._pictures[number] = pixels
        return self._pictures[number]

    def _array(self, number: int) -> FloatArray:
        """Return what an accessor says, a row for each element."""
        accessor = self.document["accessors"][number]
        rows = np.zeros((accessor["count"], WIDTHS[accessor["type"]]))
        if "bufferView" in accessor:
            rows = self._rows(accessor, accessor["count"], rows.shape[1])
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            count, width = sparse["count"], rows.shape[1]
            at = self._rows(sparse["indices"], count, 1).astype(np.int64).reshape(-1)
            values = {**accessor, **sparse["values"]}
            rows[at] = self._rows(values, count, width)
        return rows

    def _rows(self, accessor: _Json, count: int, width: int) -> FloatArray:
        view = self.document["bufferViews"][accessor["bufferView"]]
        kind = np.dtype(COMPONENTS[accessor["componentType"]])
        packed = width * kind.itemsize
        stored = np.ndarray(
            (count, width),
            kind,
            self.binary,
            view.get("byteOffset", 0) + accessor.get("byteOffset", 0),
            (view.get("byteStride", packed), kind.itemsize),
        )
        rows = stored.astype(np.float64)
        if accessor.get("normalized"):
            rows = np.maximum(rows / np.iinfo(kind).max, -1.0)
        return rows


def _flat(
    vertices: FloatArray, faces: IntArray
) -> tuple[IntArray, IntArray, FloatArray]:
    """Give flat faces vertices of their own, shared with those that look the same way.

    Returns the number of the vertex that each comes from, the faces, and the normals.
    """
    a, b, c = vertices[faces].transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    ways = np.round((across + 1) * 500).astype(np.int64) @ (1, 1001, 1001**2)
    corners = faces.reshape(-1)
    keys = corners * 1001**3 + ways.repeat(3)
    _, first, which = np.unique(keys, return_index=True, return_inverse=True)
    return corners[first], which.reshape(-1, 3), across.repeat(3, axis=0)[first]


def _local(node: _Json) -> FloatArray:
    """Return the matrix of a node, (4, 4)."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    turn = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(node.get("scale", (1.0, 1.0, 1.0)), dtype=float)
    matrix[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return matrix
