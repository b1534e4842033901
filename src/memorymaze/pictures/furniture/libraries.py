"""Furniture libraries of Sweet Home 3D (`.sh3f`): what they hold and who made it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile, ZipFile

import numpy as np
from numpy.typing import NDArray

from memorymaze.errors import SettingsError

DEBIAN_FOLDER = Path("/usr/share/sweethome3d/furniture")
INSTALLING = "apt-get install sweethome3d-furniture"

CATALOGUE = "PluginFurnitureCatalog.properties"
LICENCES = {
    "BlendSwap-CC-0": "CC0 1.0",
    "BlendSwap-CC-BY": "CC BY 3.0",
    "KatorLegaz": "CC BY 3.0 US",
    "Reallusion": "CC BY 3.0 US",
    "Scopia": "CC BY 3.0",
}
"""Of the libraries that Debian ships, as its copyright file tells."""


@dataclass(frozen=True, slots=True)
class Piece:
    """An entry of a library's catalogue."""

    id: str
    """Library and file, such as `Scopia/ficus`."""
    name: str
    """As people call it."""
    member: str
    """Its OBJ file in the archive."""
    size: tuple[float, float, float]
    """Length across the front, depth and height, metres."""
    rotation: NDArray[np.float64]
    """(3, 3), to be applied to the vertices of the file before all else."""
    creator: str
    licence: str


def library_files(folder: Path = DEBIAN_FOLDER) -> list[Path]:
    """Return the libraries in a folder whose licence is known.

    Raises:
        SettingsError: There are none; says how to get them.
    """
    files = [folder / f"{name}.sh3f" for name in LICENCES]
    found = [file for file in files if file.is_file()]
    if not found:
        raise SettingsError(
            f"furniture models: expected {', '.join(f'{n}.sh3f' for n in LICENCES)} in "
            f"{folder}, got none of them; on Debian and Ubuntu: {INSTALLING}"
        )
    return found


def pieces_of(library: Path) -> dict[str, Piece]:
    """Return the pieces of a library by id.

    Raises:
        SettingsError: The file is no furniture library.
    """
    try:
        with ZipFile(library) as archive:
            text = archive.read(CATALOGUE).decode("latin-1")
            members = set(archive.namelist())
    except (BadZipFile, KeyError, OSError) as problem:
        raise SettingsError(
            f"{library}: expected a furniture library of Sweet Home 3D with "
            f"{CATALOGUE}, got {problem}"
        ) from None
    name = library.stem
    pieces = (_piece(name, entry) for entry in _entries(text))
    return {piece.id: piece for piece in pieces if piece.member in members}


def _entries(text: str) -> Iterator[dict[str, str]]:
    """Read `key#number=value` lines, a dictionary for each number."""
    entries: dict[int, dict[str, str]] = {}
    for key, number, value in re.findall(
        r"^(\w+)#(\d+)[ \t]*=[ \t]*(.*?)\s*$", text, re.MULTILINE
    ):
        plain = re.sub(
            r"\\u([0-9a-fA-F]{4})", lambda code: chr(int(code[1], 16)), value
        )
        entries.setdefault(int(number), {})[key] = plain
    for _, entry in sorted(entries.items()):
        if "model" in entry:
            yield entry


def _piece(library: str, entry: dict[str, str]) -> Piece:
    member = entry["model"].lstrip("/")
    centimetres = (float(entry[key]) for key in ("width", "depth", "height"))
    length, depth, height = (each / 100 for each in centimetres)
    turned = [float(each) for each in entry.get("modelRotation", "").split()]
    rotation = np.array(turned).reshape(3, 3) if turned else np.eye(3)
    return Piece(
        f"{library}/{Path(member).stem}",
        entry.get("name", Path(member).stem),
        member,
        (length, depth, height),
        rotation,
        entry.get("creator") or library,
        LICENCES.get(library, "unknown"),
    )
