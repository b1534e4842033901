"""Writing H.264 video into an mp4 file, frame by frame, by the library PyAV."""

import os
import struct
import sys
import uuid
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, NoReturn

import av
import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from memorymaze.durable_files import replaced_when_whole
from memorymaze.errors import SettingsError

SECONDS_BETWEEN_LINES = 15.0

QUALITY = {"crf": "20", "preset": "veryfast", "threads": "1"}
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


def check_picture(about: str, size: tuple[int, int], smallest: int) -> None:
    """Refuse a size that no video can have; SettingsError says what is meant."""
    width, height = size
    if min(size) < smallest or max(size) > 4096 or width % 2 or height % 2:
        raise SettingsError(
            f"{about}: expected a size of even numbers from {smallest} to 4096 pixels, "
            f"got {width}x{height}"
        )


def check_ranges(settings: object, about: str, **ranges: tuple[float, float]) -> None:
    """Refuse settings out of their ranges; SettingsError names the first one."""
    for name, (lowest, highest) in ranges.items():
        value = getattr(settings, name)
        if not lowest <= value <= highest:
            raise SettingsError(
                f"{about}: expected {name} from {lowest:g} to {highest:g}, got {value!r}"
            )


def check_target(path: str | Path, ending: str, about: str) -> Path:
    """Refuse a file that cannot be written, before anything is drawn for it."""
    target = Path(path)
    folder = target.absolute().parent
    if target.suffix.lower() != ending:
        raise SettingsError(
            f"{about}: expected a file named *{ending}, got {str(path)!r}"
        )
    if target.is_dir():
        raise SettingsError(f"{about}: expected a file, got the folder {str(path)!r}")
    if not folder.is_dir():
        raise SettingsError(
            f"{about}: expected a file in a folder that is there, got {str(path)!r}; "
            f"make {folder} first"
        )
    if not os.access(folder, os.W_OK | os.X_OK):
        raise SettingsError(f"{about}: expected leave to write to {folder}, got none")
    return target


def progress_bar(total: int, unit: str, *, shown: bool) -> "tqdm[NoReturn]":
    """Return a bar on stderr; in files of logs it has a line now and then."""
    return tqdm(
        total=total,
        unit=unit,
        file=sys.stderr,
        disable=not shown,
        mininterval=0.5 if sys.stderr.isatty() else SECONDS_BETWEEN_LINES,
    )


def write_video(
    path: str | Path,
    pictures: Iterable[NDArray[np.uint8]],
    size: tuple[int, int],
    fps: float,
    *,
    title: str,
    total: int,
    spherical: bool = False,
    progress: bool = False,
    told: Callable[[int, int], object] | None = None,
) -> None:
    """Write a video; it is there in full or not at all, and replaces what was there.

    Args:
        path: An mp4 file.
        pictures: Colours, each (height, width, 3); or planes (`planes_of`).
        size: Width and height, pixels, even.
        fps: Frames per second.
        title: Kept in the file.
        total: How many pictures there are.
        spherical: Whether they are equirectangular.
        progress: Whether to show a bar with the time left on stderr.
        told: Is told after each picture how many of how many are written.

    Raises:
        SettingsError: The file cannot be there.
        OSError: The file cannot be written to its end.
    """
    target = check_target(path, ".mp4", "video")
    with replaced_when_whole(target) as unfinished:
        # The encoder would say after minutes, and without a name, that it cannot write.
        unfinished.touch()
        with (
            av.open(
                str(unfinished),
                "w",
                format="mp4",
                # Else the library's version stands in the file.
                container_options={"fflags": "+bitexact"},
            ) as container,
            progress_bar(total, "frame", shown=progress) as bar,
        ):
            container.metadata["title"] = title
            stream = _stream(container, size, fps)
            for number, picture in enumerate(pictures, start=1):
                container.mux(stream.encode(video_frame(picture)))
                bar.update()
                if told is not None:
                    told(number, total)
            container.mux(stream.encode(None))
        if spherical:
            mark_spherical(unfinished)


def video_frame(picture: NDArray[np.uint8]) -> av.VideoFrame:
    """Return a picture, (height, width, 3) or planes, as the encoder takes it."""
    if picture.ndim == 2:
        return av.VideoFrame.from_ndarray(picture, format="yuv420p")
    colours = av.VideoFrame.from_ndarray(picture, format="rgb24")
    return colours.reformat(
        format="yuv420p", dst_colorspace=BT709, dst_color_range=LIMITED_RANGE
    )


def planes_of(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return a picture as its encoder keeps it: brightness, then the two colours.

    Rows are as wide as the picture, and half as many again: the colours have a quarter
    of its pixels each.
    """
    return np.asarray(video_frame(picture).to_ndarray(), dtype=np.uint8)


def _stream(container: Any, size: tuple[int, int], fps: float) -> Any:
    rate = Fraction(fps).limit_denominator(1001)
    stream = container.add_stream("libx264", rate=rate, options=dict(QUALITY))
    stream.width, stream.height = size
    stream.pix_fmt = "yuv420p"
    # Said in the file, because players guess the colours by the size otherwise.
    context = stream.codec_context
    context.colorspace = context.color_primaries = context.color_trc = BT709
    context.color_range = LIMITED_RANGE
    return stream


def mark_spherical(path: Path) -> None:
    """Say in an mp4 file with one track, its `moov` box last, that it is spherical."""
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
