"""Marking an mp4 file as a 360-degree video, by Google's "Spherical Video" metadata.

Version 1 of the specification: a `uuid` box with a piece of XML at the end of the video
track (https://github.com/google/spatial-media, docs/spherical-video-rfc.md).
"""

import struct
import uuid
from collections.abc import Iterator
from pathlib import Path

SPHERICAL_ID = uuid.UUID("ffcc8263-f855-4a93-8814-587a02521fdd")
PROPERTIES = {
    "Spherical": "true",
    "Stitched": "true",
    "StitchingSoftware": "memorymaze",
    "ProjectionType": "equirectangular",
}
HEADER = struct.Struct(">I4s")


def mark_spherical(path: Path) -> None:
    """Say in an mp4 file with one track that its frames are equirectangular.

    Args:
        path: Its `moov` box comes last, as where a file is written front to back.

    Raises:
        ValueError: It is no such file.
    """
    with path.open("r+b") as file:
        place = _last_box(path)
        file.seek(place)
        moov = file.read()
        if moov[4:8] != b"moov":
            raise ValueError(f"{path}: expected the box moov last, got {moov[4:8]!r}")
        file.seek(place)
        file.write(_with_metadata(moov))


def _last_box(path: Path) -> int:
    """Return where the last box of a file begins, bytes."""
    with path.open("rb") as file:
        end, place, last = path.stat().st_size, 0, 0
        while place < end:
            last = place
            file.seek(place)
            size, _ = HEADER.unpack(file.read(HEADER.size))
            if size == 1:  # a box of more than 4 GB
                (size,) = struct.unpack(">Q", file.read(8))
            if size < HEADER.size:
                raise ValueError(f"{path}: expected a box at {place}, got size {size}")
            place += size
    return last


def _with_metadata(moov: bytes) -> bytes:
    names = "".join(
        f"<GSpherical:{name}>{value}</GSpherical:{name}>"
        for name, value in PROPERTIES.items()
    )
    text = (
        '<?xml version="1.0"?><rdf:SphericalVideo '
        'xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" '
        'xmlns:GSpherical="http://ns.google.com/videos/1.0/spherical/">'
        f"{names}</rdf:SphericalVideo>"
    )
    said = _box(b"uuid", SPHERICAL_ID.bytes + text.encode())
    parts = [
        _box(kind, content + said) if kind == b"trak" else _box(kind, content)
        for kind, content in _boxes(moov[HEADER.size :])
    ]
    return _box(b"moov", b"".join(parts))


def _boxes(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    place = 0
    while place < len(content):
        size, kind = HEADER.unpack_from(content, place)
        yield kind, content[place + HEADER.size : place + size]
        place += size


def _box(kind: bytes, content: bytes) -> bytes:
    return HEADER.pack(HEADER.size + len(content), kind) + content
