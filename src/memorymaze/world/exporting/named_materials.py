"""Names for the looks of a building: equal ones are one material, one picture."""

import hashlib
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from memorymaze.world.exporting.named_meshes import NamedMesh
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.materials import Material

Look = tuple[object, ...]


@dataclass(frozen=True, slots=True, eq=False)
class NamedMaterial:
    """A look with a name of its own in a file."""

    number: int
    """From 0, in order of first use."""
    name: str
    """Letters, digits and underscores."""
    material: Material
    picture: int | None
    """Number of its picture, where it has one."""


@dataclass(eq=False)
class NamedMaterials:
    """The looks of a building so far."""

    all: list[NamedMaterial] = field(default_factory=list)
    pictures: list[tuple[str, NDArray[np.uint8]]] = field(default_factory=list)
    """Names and pixels, first row at the top."""
    _by_look: dict[Look, NamedMaterial] = field(default_factory=dict)
    _picture_numbers: dict[bytes, int] = field(default_factory=dict)
    _taken: set[str] = field(default_factory=set)

    def of(self, mesh: NamedMesh) -> Iterator[tuple[MeshPart, NamedMaterial]]:
        """Yield the parts of a mesh with their materials."""
        for part in mesh.placed.parts:
            user = mesh.attributes.get("floor_material", mesh.label)
            yield part, self._named(part.material, str(user))

    def _named(self, material: Material, user: str) -> NamedMaterial:
        picture = None
        if material.texture is not None:
            picture = self._picture(material.texture, user)
        look = (material.rgba, material.emission, material.shininess, picture)
        if look not in self._by_look:
            if picture is None:
                red, green, blue = (round(255 * each) for each in material.rgba[:3])
                kind = "glass" if material.is_clear else "paint"
                name = self._free(f"{kind}_{red:02x}{green:02x}{blue:02x}")
            else:
                name = self._free(self.pictures[picture][0])
            made = NamedMaterial(len(self.all), name, material, picture)
            self.all.append(made)
            self._by_look[look] = made
        return self._by_look[look]

    def _picture(self, pixels: NDArray[np.uint8], user: str) -> int:
        key = hashlib.blake2b(
            np.ascontiguousarray(pixels).tobytes() + str(pixels.shape).encode()
        ).digest()
        if key not in self._picture_numbers:
            self._picture_numbers[key] = len(self.pictures)
            word = re.sub(r"[^a-z0-9]+", "_", user).strip("_") or "thing"
            self.pictures.append((f"{word}_{len(self.pictures)}", pixels))
        return self._picture_numbers[key]

    def _free(self, wanted: str) -> str:
        name, number = wanted, 2
        while name in self._taken:
            name, number = f"{wanted}_{number}", number + 1
        self._taken.add(name)
        return name


def png_of(pixels: NDArray[np.uint8]) -> bytes:
    """Return a picture as a PNG file."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, format="png", compress_level=6)
    return file.getvalue()


def linear(colour: tuple[float, ...]) -> list[float]:
    """Return sRGB colours in [0, 1] as shares of light, which formats want."""
    return [
        each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4
        for each in colour
    ]
