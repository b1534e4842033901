"""Tiny GLB files, as modelling tools write them."""

import json
import struct
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

# A box from -1 to 1 along x, from 0 to 1 up, from -0.5 to 0.5 towards the front.
CORNERS = np.array([
    [x, y, z] for x in (-1.0, 1.0) for y in (0.0, 1.0) for z in (-0.5, 0.5)
])
SIDES = [
    (0, 1, 3, 2),
    (4, 6, 7, 5),
    (0, 4, 5, 1),
    (2, 3, 7, 6),
    (0, 2, 6, 4),
    (1, 5, 7, 3),
]
FACES = np.array([each for a, b, c, d in SIDES for each in ((a, b, c), (a, c, d))])

GlbFile = Callable[..., Path]


@pytest.fixture
def glb_file(tmp_path: Path) -> GlbFile:
    """Write a file with one box for each node; further members may be given."""

    def write(
        nodes: Sequence[Mapping[str, Any]],
        materials: Sequence[Mapping[str, Any]] = ({},),
        targets: Mapping[str, np.ndarray] | None = None,
        corners: np.ndarray = CORNERS,
        **members: Any,
    ) -> Path:
        shapes = targets or {}
        arrays = [corners, *shapes.values()]
        blocks = [np.asarray(each, dtype="<f4").tobytes() for each in arrays]
        blocks.append(FACES.astype("<u2").tobytes())
        starts = np.cumsum([0, *map(len, blocks)]).tolist()
        views = [
            {"buffer": 0, "byteOffset": start, "byteLength": len(block)}
            for start, block in zip(starts, blocks, strict=False)
        ]
        accessors: list[dict[str, Any]] = [
            {"bufferView": n, "componentType": 5126, "count": 8, "type": "VEC3"}
            for n in range(len(arrays))
        ]
        accessors.append({
            "bufferView": len(arrays),
            "componentType": 5123,
            "count": FACES.size,
            "type": "SCALAR",
        })
        meshes = [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 0},
                        "indices": len(arrays),
                        "material": number,
                        "targets": [{"POSITION": 1 + n} for n in range(len(shapes))],
                    }
                ],
                "extras": {"targetNames": list(shapes)},
            }
            for number in range(len(materials))
        ]
        document = {
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": list(range(len(nodes)))}],
            "nodes": [{"mesh": 0, **node} for node in nodes],
            "meshes": meshes,
            "materials": list(materials),
            "accessors": accessors,
            "bufferViews": views,
            "buffers": [{"byteLength": starts[-1]}],
        } | members
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        content = b"".join(blocks)
        path = tmp_path / "my_things.glb"
        path.write_bytes(
            struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(content))
            + struct.pack("<II", len(text), 0x4E4F534A)
            + text
            + struct.pack("<II", len(content), 0x004E4942)
            + content
        )
        return path

    return write
