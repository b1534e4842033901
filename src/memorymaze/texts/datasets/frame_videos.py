"""Videos of frames: colours in H.264, depth in 12 bits of lossless H.265.

Depth is written as LeRobot quantizes it: steps even in the logarithm of the distance, so
that near things are measured finely. What each video holds is told in its `info`.
"""

import math
from typing import Any

import av
import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.video_file import Coding

FPS = 4
"""Frames a second: the time of a step of 25 cm at 1 m/s, exact in binary."""
FROM_KEY_TO_KEY = 2
"""Frames from one that stands alone to the next, for reading them in any order."""
# No frame may wait for a later one: readers that seek would miss it. A single thread,
# because threads have a part in what comes out.
COLOURS = Coding(
    "libx264",
    "yuv420p",
    {
        "crf": "23",
        "preset": "veryfast",
        "bf": "0",
        "threads": "1",
        "g": str(FROM_KEY_TO_KEY),
    },
)
DEPTHS = Coding(
    "libx265",
    "gray12le",
    {
        "preset": "ultrafast",
        "x265-params": "lossless=1:bframes=0:open-gop=0:pools=none:frame-threads=1:"
        "log-level=error",
        "g": str(FROM_KEY_TO_KEY),
    },
)
NEAREST, FARTHEST, SHIFT = 0.05, 50.0, 3.5
"""Metres of the first and last step of depth, and what is added before the logarithm."""
LAST_CODE = 4095


def colour_frame(picture: NDArray[np.uint8]) -> av.VideoFrame:
    """Return colours (height, width, 3) as a frame."""
    return av.VideoFrame.from_ndarray(picture, format="rgb24")


def depth_frame(metres: NDArray[np.float32]) -> av.VideoFrame:
    """Return metres (height, width) as a frame."""
    return av.VideoFrame.from_ndarray(depth_codes(metres), format="gray12le")


def depth_codes(metres: NDArray[Any]) -> NDArray[np.uint16]:
    """Return the steps of depths, shape as given; the last one also for what is beyond.

    >>> depth_codes(np.array([[0.05, 50.0, np.inf]])).tolist()
    [[0, 4095, 4095]]
    """
    first, last = math.log(NEAREST + SHIFT), math.log(FARTHEST + SHIFT)
    levels = (np.log(np.clip(metres, NEAREST, FARTHEST) + SHIFT) - first) / (
        last - first
    )
    return np.rint(levels * LAST_CODE).astype(np.uint16)


def info(size: tuple[int, int], *, depth: bool) -> dict[str, Any]:
    """Return what LeRobot's `info.json` says of such a video."""
    width, height = size
    said = {
        "video.height": height,
        "video.width": width,
        "video.codec": "hevc" if depth else "h264",
        "video.pix_fmt": "gray12le" if depth else "yuv420p",
        "video.fps": FPS,
        "video.channels": 1 if depth else 3,
        "video.g": FROM_KEY_TO_KEY,
        "has_audio": False,
        "is_depth_map": depth,
    }
    if depth:
        said |= {
            "depth_unit": "m",
            "video.depth_min": NEAREST,
            "video.depth_max": FARTHEST,
            "video.shift": SHIFT,
            "video.use_log": True,
        }
    return said
