"""Writing video into an mp4 file, frame by frame, by the library PyAV.

That comes with the extra `video`; nothing imports it before a video is made.
"""

import os
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from memorymaze.basics.durable_files import replaced_when_whole
from memorymaze.basics.errors import SettingsError
from memorymaze.basics.extras import require_extra
from memorymaze.basics.options import check_number

if TYPE_CHECKING:
    import av

SECONDS_BETWEEN_LINES = 15.0

BT709, LIMITED_RANGE = 1, 1
"""Numbers of colour space, primaries, transfer and range in H.264."""


@dataclass(frozen=True, slots=True)
class Coding:
    """How an encoder keeps frames."""

    codec: str
    pixels: str
    options: Mapping[str, str]
    bt709: bool = False
    """Whether the colours are said to be those of BT.709; else players guess by the size."""


# A single thread, because threads have a part in what comes out.
FILM = Coding(
    "libx264",
    "yuv420p",
    {"crf": "20", "preset": "veryfast", "threads": "1"},
    bt709=True,
)


class VideoFile:
    """An mp4 file that frames are added to; a `with` statement closes it."""

    def __init__(
        self,
        path: Path,
        size: tuple[int, int],
        fps: float,
        coding: Coding,
        title: str | None = None,
    ) -> None:
        """Begin a file of frames with a width and a height, pixels."""
        import av

        # Else the library's version stands in the file.
        self._container = av.open(
            str(path), "w", format="mp4", container_options={"fflags": "+bitexact"}
        )
        if title is not None:
            self._container.metadata["title"] = title
        self._stream: Any = self._container.add_stream(
            coding.codec,
            rate=Fraction(fps).limit_denominator(1001),
            options=dict(coding.options),
        )
        self._stream.width, self._stream.height = size
        self._stream.pix_fmt = coding.pixels
        if coding.bt709:
            context = self._stream.codec_context
            context.colorspace = context.color_primaries = context.color_trc = BT709
            context.color_range = LIMITED_RANGE

    def add(self, frame: "av.VideoFrame") -> None:
        """Add a frame."""
        self._container.mux(self._stream.encode(frame))

    def __enter__(self) -> "VideoFile":
        """Return itself."""
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        """Write what is left, unless something went wrong."""
        try:
            if kind is None:
                self._container.mux(self._stream.encode(None))
        finally:
            self._container.close()


def require_encoder() -> None:
    """Refuse to go on without PyAV; SettingsError says what to type."""
    require_extra("video", "av", purpose="videos")


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
        check_number(f"{about} {name}", getattr(settings, name), lowest, highest)


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


def check_video_path(path: str | Path) -> Path:
    """Refuse a file that no video can be written to, or a machine without PyAV."""
    require_encoder()
    return check_target(path, ".mp4", "video")


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
        progress: Whether to show a bar with the time left on stderr.
        told: Is told after each picture how many of how many are written.

    Raises:
        SettingsError: The file cannot be there, or the extra `video` is missing.
        OSError: The file cannot be written to its end.
    """
    target = check_video_path(path)
    with replaced_when_whole(target) as unfinished:
        # The encoder would say after minutes, and without a name, that it cannot write.
        unfinished.touch()
        with (
            VideoFile(unfinished, size, fps, FILM, title) as video,
            progress_bar(total, "frame", shown=progress) as bar,
        ):
            for number, picture in enumerate(pictures, start=1):
                video.add(video_frame(picture))
                bar.update()
                if told is not None:
                    told(number, total)


def video_frame(picture: NDArray[np.uint8]) -> "av.VideoFrame":
    """Return a picture, (height, width, 3) or planes, as the encoder takes it."""
    import av

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
