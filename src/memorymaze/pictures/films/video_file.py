"""Writing H.264 video into an mp4 file, frame by frame, by the library PyAV."""

import os
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.errors import SettingsError
from memorymaze.extras import require_extra
from memorymaze.pictures.films.spherical import mark_spherical

QUALITY = {"crf": "20", "preset": "fast", "threads": "1"}
"""Of x264; a single thread, because threads have a part in what comes out."""

BT709, LIMITED_RANGE = 1, 1
"""Numbers of colour space, primaries, transfer and range in H.264."""


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
    require_extra("video", "av", purpose="videos")
    import av

    return av
