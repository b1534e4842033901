"""Puts meshes into a MuJoCo model: few geoms, few textures, equal ones only once."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.materials import Material
from memorymaze.world.looks.meshes import PlacedMeshes

PALETTE_EDGE = 64
"""Colours along an edge of the palette."""
SWATCH = 4
"""Pixels per colour, so that filtering never mixes neighbours."""


@dataclass(eq=False)
class SpecAssembler:
    """Grows the visual model; geoms come in the order in which they are added."""

    spec: mujoco.MjSpec
    _palette: dict[tuple[int, int, int], int] = field(default_factory=dict)
    _palette_materials: dict[tuple[float, float], str] = field(default_factory=dict)
    _materials: dict[int, str] = field(default_factory=dict)
    _textures: dict[bytes, str] = field(default_factory=dict)
    _meshes: dict[bytes, str] = field(default_factory=dict)
    _kept: list[object] = field(default_factory=list)
    geom_count: int = 0

    def add(
        self,
        placed: PlacedMeshes,
        group: int,
        *,
        body: mujoco.MjsBody | None = None,
        transparent: bool | None = None,
    ) -> int:
        """Add meshes to a geom group and return how many geoms they became.

        Only what is (True) or is not (False) seen through is added; None adds all. The
        body carries them; None is the ground. Bodies must be filled in the order in
        which they were made, the ground first.
        """
        plain: dict[tuple[float, float], list[MeshPart]] = {}
        rest: list[MeshPart] = []
        for part in placed.parts:
            clear = part.material.is_clear
            if transparent is not None and clear != transparent:
                continue
            if clear or part.material.texture is not None:
                rest.append(part)
            else:
                look = (part.material.emission, part.material.shininess)
                plain.setdefault(look, []).append(part)
        before = self.geom_count
        for look, parts in plain.items():
            material = self._palette_material(look)
            self._geom(self._merged(parts), material, placed, group, body)
        for part in rest:
            self._geom(part, self._material(part.material), placed, group, body)
        return self.geom_count - before

    def finish(self) -> None:
        """Write the palette; call once, before compiling."""
        colours = np.zeros((PALETTE_EDGE**2, 3), dtype=np.uint8)
        colours[: len(self._palette)] = np.array([*self._palette]).reshape(-1, 3)
        grid = colours.reshape(PALETTE_EDGE, PALETTE_EDGE, 3)
        self._texture("palette", grid.repeat(SWATCH, 0).repeat(SWATCH, 1))

    def _merged(self, parts: Sequence[MeshPart]) -> MeshPart:
        """Join plain parts; each vertex points to its colour in the palette."""
        vertices, faces, normals, uv = [], [], [], []
        count = 0
        for part in parts:
            flat = part.with_normals()
            red, green, blue = (round(255 * c) for c in part.material.rgba[:3])
            number = self._palette.setdefault((red, green, blue), len(self._palette))
            if number >= PALETTE_EDGE**2:
                raise RuntimeError(
                    f"more than {PALETTE_EDGE**2} plain colours in one building"
                )
            vertices.append(flat.vertices)
            assert flat.normals is not None
            normals.append(flat.normals)
            faces.append(flat.faces + count)
            row, column = divmod(number, PALETTE_EDGE)
            spot = np.array([column + 0.5, row + 0.5]) / PALETTE_EDGE
            uv.append(np.tile(spot, (len(flat.vertices), 1)).astype(np.float32))
            count += len(flat.vertices)
        return MeshPart(
            np.concatenate(vertices),
            np.concatenate(faces),
            np.concatenate(normals),
            np.concatenate(uv),
            parts[0].material,
        )

    def _geom(
        self,
        part: MeshPart,
        material: str,
        placed: PlacedMeshes,
        group: int,
        body: mujoco.MjsBody | None,
    ) -> None:
        (body or self.spec.worldbody).add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH,
            meshname=self._mesh(part),
            material=material,
            pos=[placed.x, placed.y, placed.z],
            quat=about_z(placed.heading),
            group=group,
            contype=0,
            conaffinity=0,
            density=0,
        )
        self.geom_count += 1

    def _mesh(self, part: MeshPart) -> str:
        part = part.with_normals()
        assert part.normals is not None
        uv = part.uv
        if uv is None:
            uv = np.zeros((len(part.vertices), 2), dtype=np.float32)
        arrays = (part.vertices, part.faces, part.normals, uv)
        key = hashlib.blake2b(
            b"".join(np.ascontiguousarray(each).tobytes() for each in arrays),
            digest_size=16,
        ).digest()
        if key in self._meshes:
            return self._meshes[key]
        name = f"mesh_{len(self._meshes)}"
        faces = part.faces
        # The compiler wants four vertices even for one triangle.
        spare = max(0, 4 - len(part.vertices))
        vertices, normals, uv = (
            np.concatenate([each, each[:1].repeat(spare, axis=0)]).astype(np.float64)
            for each in (part.vertices, part.normals, uv)
        )
        mesh = self.spec.add_mesh(
            name=name,
            uservert=vertices.ravel(),
            userface=faces.ravel(),
            usernormal=normals.ravel(),
            userfacenormal=faces.ravel(),
            usertexcoord=uv.ravel(),
            userfacetexcoord=faces.ravel(),
        )
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        self._meshes[key] = name
        return name

    def _palette_material(self, look: tuple[float, float]) -> str:
        if look not in self._palette_materials:
            name = f"plain_{len(self._palette_materials)}"
            emission, shininess = look
            self._new_material(name, (1, 1, 1, 1), "palette", emission, shininess)
            self._palette_materials[look] = name
        return self._palette_materials[look]

    def _material(self, material: Material) -> str:
        key = id(material)
        if key not in self._materials:
            name = f"material_{len(self._materials)}"
            texture = None
            if material.texture is not None:
                texture = self._texture_of(material.texture)
            self._new_material(
                name, material.rgba, texture, material.emission, material.shininess
            )
            self._materials[key] = name
            self._kept.append(material)
        return self._materials[key]

    def _new_material(
        self,
        name: str,
        rgba: tuple[float, float, float, float],
        texture: str | None,
        emission: float,
        shininess: float,
    ) -> None:
        made = self.spec.add_material(name=name)
        made.rgba = list(rgba)
        made.emission = emission
        made.specular = 0.0
        made.shininess = shininess
        if texture is not None:
            made.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = texture

    def _texture_of(self, pixels: NDArray[np.uint8]) -> str:
        key = hashlib.blake2b(
            np.ascontiguousarray(pixels).tobytes() + str(pixels.shape).encode(),
            digest_size=16,
        ).digest()
        if key not in self._textures:
            name = f"texture_{len(self._textures)}"
            self._texture(name, pixels)
            self._textures[key] = name
        return self._textures[key]

    def _texture(self, name: str, pixels: NDArray[np.uint8]) -> None:
        height, width, channels = pixels.shape
        texture = self.spec.add_texture(
            name=name,
            type=mujoco.mjtTexture.mjTEXTURE_2D,
            width=width,
            height=height,
            nchannel=channels,
        )
        texture.data = np.ascontiguousarray(pixels).tobytes()
