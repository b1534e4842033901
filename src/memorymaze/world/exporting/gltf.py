"""A building as glTF 2.0 in one binary file (GLB): y up, metres, pictures inside."""

import json
import math
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.durable_files import write_new
from memorymaze.world.exporting.named_materials import (
    NamedMaterial,
    NamedMaterials,
    linear,
    png_of,
)
from memorymaze.world.exporting.named_meshes import (
    Attributes,
    NamedMesh,
    named_meshes,
    plan_members,
)
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.glb import BINARY_CHUNK, HEADER, JSON_CHUNK, MAGIC, VERSION
from memorymaze.world.looks.materials import Rgb
from memorymaze.world.sites.records import Site

COMPONENTS = {"float32": 5126, "uint32": 5125}
SHAPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
LINEAR, LINEAR_MIPMAP_LINEAR, REPEAT = 9729, 9987, 10497

Json = dict[str, Any]


def write_gltf(site: Site, out: Path) -> list[Path]:
    """Write a building as GLB."""
    glb = Glb(site.name, plan_members(site))
    for mesh in named_meshes(site):
        glb.add(mesh)
    write_new(out, glb.content())
    return [out]


class Glb:
    """A file that grows: one node per mesh, under a root that stands for the site."""

    def __init__(self, name: str, extras: Attributes, scale: float = 1.0) -> None:
        """Begin with the root; where a unit is no metre, give how many make one."""
        self._materials = NamedMaterials()
        self._binary = bytearray()
        self._views: list[Json] = []
        self._accessors: list[Json] = []
        self._meshes: list[Json] = []
        # Not the bare name: a feature may be called as its site.
        self._nodes: list[Json] = [{"name": f"site/{name}", "extras": dict(extras)}]
        self._scale = scale
        self._mesh_numbers: dict[tuple[object, ...], int] = {}
        self._kept: list[MeshPart] = []

    def add(self, mesh: NamedMesh, colour: Rgb | None = None) -> None:
        """Add a node; things of one model share a mesh.

        A colour, as shares of light, takes the place of all materials at every vertex.
        """
        placed = mesh.placed
        node: Json = {"name": mesh.name, "extras": dict(mesh.attributes)}
        if (placed.x, placed.y, placed.z) != (0.0, 0.0, 0.0):
            place = placed.x, placed.z, -placed.y
            node["translation"] = [self._scale * part for part in place]
        if placed.heading:
            half = placed.heading / 2
            node["rotation"] = [0.0, math.sin(half), 0.0, math.cos(half)]
        if placed.parts:
            key = (colour, *(id(part) for part in placed.parts))
            if key not in self._mesh_numbers:
                self._mesh_numbers[key] = len(self._meshes)
                # While they are kept, no other part gets their identity.
                self._kept += placed.parts
                if colour is None:
                    looks = self._materials.of(mesh)
                    primitives = [self._drawn(part, look) for part, look in looks]
                else:
                    primitives = [self._painted(each, colour) for each in placed.parts]
                self._meshes.append({"name": mesh.name, "primitives": primitives})
            node["mesh"] = self._mesh_numbers[key]
        self._nodes.append(node)

    def content(self) -> bytes:
        """Return the file."""
        images = [
            {
                "name": f"{name}.png",
                "mimeType": "image/png",
                "bufferView": self._view(png_of(pixels)),
            }
            for name, pixels in self._materials.pictures
        ]
        children = list(range(1, len(self._nodes)))
        document: Json = {
            "asset": {"version": "2.0", "generator": "memorymaze"},
            "scene": 0,
            "scenes": [{"name": self._nodes[0]["name"], "nodes": [0]}],
            "nodes": [{**self._nodes[0], "children": children}, *self._nodes[1:]],
            "meshes": self._meshes,
            "materials": [_material(each) for each in self._materials.all],
            "textures": [{"source": n, "sampler": 0} for n in range(len(images))],
            "images": images,
            "samplers": [
                {
                    "magFilter": LINEAR,
                    "minFilter": LINEAR_MIPMAP_LINEAR,
                    "wrapS": REPEAT,
                    "wrapT": REPEAT,
                }
            ]
            if images
            else [],
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": len(self._binary)}],
        }
        filled = {name: value for name, value in document.items() if value != []}
        text = json.dumps(filled, ensure_ascii=False, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self._binary) + b"\0" * (-len(self._binary) % 4)
        length = 12 + 8 + len(text) + 8 + len(binary)
        return b"".join((
            HEADER.pack(MAGIC, VERSION, length),
            struct.pack("<II", len(text), JSON_CHUNK),
            text,
            struct.pack("<II", len(binary), BINARY_CHUNK),
            binary,
        ))

    def _drawn(self, part: MeshPart, look: NamedMaterial) -> Json:
        made = self._primitive(part)
        made["material"] = look.number
        if look.picture is not None:
            uv = part.with_normals().uv
            if uv is None:
                raise RuntimeError(f"{look.name}: a mesh with a picture has no uv")
            made["attributes"]["TEXCOORD_0"] = self._vertices(uv)
        return made

    def _painted(self, part: MeshPart, colour: Rgb) -> Json:
        made = self._primitive(part)
        colours = np.tile(np.array(colour), (len(part.with_normals().vertices), 1))
        made["attributes"]["COLOR_0"] = self._vertices(colours)
        return made

    def _primitive(self, part: MeshPart) -> Json:
        part = part.with_normals()
        assert part.normals is not None
        indices = np.ascontiguousarray(part.faces, dtype=np.uint32).ravel()
        return {
            "attributes": {
                "POSITION": self._vertices(
                    self._scale * y_up(part.vertices), bounds=True
                ),
                "NORMAL": self._vertices(y_up(unit(part.normals))),
            },
            "indices": self._accessor(indices, ELEMENT_ARRAY_BUFFER),
        }

    def _vertices(self, rows: NDArray[np.floating], *, bounds: bool = False) -> int:
        values = np.ascontiguousarray(rows, dtype=np.float32)
        more: Json = {}
        if bounds:
            more = {
                "min": values.min(axis=0).astype(float).tolist(),
                "max": values.max(axis=0).astype(float).tolist(),
            }
        return self._accessor(values, ARRAY_BUFFER, **more)

    def _accessor(self, values: NDArray[Any], target: int, **more: Any) -> int:
        width = 1 if values.ndim == 1 else values.shape[1]
        self._accessors.append({
            "bufferView": self._view(values.tobytes(), target=target),
            "componentType": COMPONENTS[values.dtype.name],
            "count": len(values),
            "type": SHAPES[width],
            **more,
        })
        return len(self._accessors) - 1

    def _view(self, content: bytes, **more: int) -> int:
        self._binary += b"\0" * (-len(self._binary) % 4)
        self._views.append({
            "buffer": 0,
            "byteOffset": len(self._binary),
            "byteLength": len(content),
            **more,
        })
        self._binary += content
        return len(self._views) - 1


def y_up(points: NDArray[np.floating]) -> NDArray[np.floating]:
    """Turn points (N, 3) from the plan's frame, z up, into that of glTF, y up."""
    return np.column_stack([points[:, 0], points[:, 2], -points[:, 1]])


def unit(normals: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return normals (N, 3) of length 1; upwards where a sliver has no side."""
    lengths = np.linalg.norm(normals.astype(np.float64), axis=1, keepdims=True)
    return np.where(lengths > 1e-6, normals / np.maximum(lengths, 1e-6), (0, 0, 1.0))


def _material(named: NamedMaterial) -> Json:
    look = named.material
    surface: Json = {
        "baseColorFactor": [*linear(look.rgba[:3]), look.rgba[3]],
        "metallicFactor": 0.0,
        "roughnessFactor": 1.0 - look.shininess,
    }
    made: Json = {"name": named.name, "pbrMetallicRoughness": surface}
    if look.emission:
        made["emissiveFactor"] = [
            look.emission * each for each in linear(look.rgba[:3])
        ]
    if named.picture is not None:
        surface["baseColorTexture"] = {"index": named.picture}
        if look.emission:
            made["emissiveTexture"] = {"index": named.picture}
    if look.is_clear:
        made["alphaMode"] = "BLEND"
    return made
