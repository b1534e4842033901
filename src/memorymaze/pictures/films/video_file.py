"""Writing H.264 video into an mp4 file, frame by frame, by the library PyAV."""

import os
import struct
import uuid
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.errors import SettingsError

QUALITY = {"crf": "20", "preset": "fast", "threads": "1"}
"""Of x264; a single thread, because threads have a part in what comes out."""
BT709, LIMITED_RANGE = 1, 1
"""Numbers of colour space, primaries, transfer and range in H.264."""
SPHERICAL_ID = uuid.UUID("ffcc8263-f855-4a93-8814-587a02521fdd")
PROPERTIES = {
    "Spherical": "true",
    "Stitched": "true",
    "StitchingSoftware": "memorymaze",
    "ProjectionType": "equirectangular",
}
HEADER = struct.Struct(">I4s")


def check_video_path(path: str | Path) -> Path:
    """Refuse a file that cannot be written, before anything is drawn for it.

    Raises:
        SettingsError: It is no mp4 file, there is no folder for it, or no leave to
            write.
    """
    target = Path(path)
    folder = target.absolute().parent
    if target.suffix.lower() != ".mp4":
        raise SettingsError(f"video: expected a file named *.mp4, got {str(path)!r}")
    if target.is_dir():
        raise SettingsError(f"video: expected a file, got the folder {str(path)!r}")
    if not folder.is_dir():
        raise SettingsError(
            f"video: expected a file in a folder that is there, got {str(path)!r}; "
            f"make {folder} first"
        )
    if not os.access(folder, os.W_OK | os.X_OK):
        raise SettingsError(f"video: expected leave to write to {folder}, got none")
    _library()
    return target


class VideoFile:
    """A video that grows frame by frame; use it in a `with`.

    Whatever breaks off the `with` leaves the file as it was before: the video is
    written beside it, under another name, and takes its place when it is whole.
    """

    def __init__(
        self,
        path: Path,
        width: int,
        height: int,
        fps: float,
        *,
        title: str,
        spherical: bool = False,
    ) -> None:
        """Begin a video.

        Args:
            path: An mp4 file, which is replaced.
            width: Pixels, even.
            height: Pixels, even.
            fps: Frames per second.
            title: Kept in the file.
            spherical: Whether the frames are equirectangular.

        Raises:
            SettingsError: The package for videos is missing.
            OSError: The file cannot be written.
        """
        self._av = _library()
        self._path = path
        self._unfinished = path.with_name(f"{path.name}.{os.getpid()}.unfinished")
        self._spherical = spherical
        rate = Fraction(fps).limit_denominator(1001)
        self._container: Any = self._av.open(
            str(self._unfinished),
            "w",
            format="mp4",
            # Else the library's version stands in the file.
            container_options={"fflags": "+bitexact"},
        )
        self._container.metadata["title"] = title
        self._stream: Any = self._container.add_stream(
            "libx264", rate=rate, options=dict(QUALITY)
        )
        self._stream.width, self._stream.height = width, height
        self._stream.pix_fmt = "yuv420p"
        # Said in the file, because players guess the colours by the size otherwise.
        context = self._stream.codec_context
        context.colorspace = context.color_primaries = context.color_trc = BT709
        context.color_range = LIMITED_RANGE

    def add(self, picture: NDArray[np.uint8]) -> None:
        """Append a frame.

        Args:
            picture: Colours, (height, width, 3).
        """
        colours = self._av.VideoFrame.from_ndarray(picture, format="rgb24")
        frame = colours.reformat(
            format="yuv420p",
            dst_colorspace=BT709,
            dst_color_range=LIMITED_RANGE,
        )
        self._container.mux(self._stream.encode(frame))

    def __enter__(self) -> "VideoFile":
        """Return itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Finish the file, or remove what there is of it."""
        try:
            if error is None:
                self._container.mux(self._stream.encode(None))
            self._container.close()
            if error is None:
                if self._spherical:
                    mark_spherical(self._unfinished)
                self._unfinished.replace(self._path)
        finally:
            self._unfinished.unlink(missing_ok=True)


def _library() -> Any:
    import av

    return av


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
