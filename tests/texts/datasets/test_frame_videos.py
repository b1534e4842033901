from pathlib import Path

import av
import numpy as np
import pytest
from numpy.typing import NDArray

from memorymaze.basics.video_file import VideoFile
from memorymaze.texts.datasets.frame_videos import (
    COLOURS,
    DEPTHS,
    FARTHEST,
    FPS,
    LAST_CODE,
    NEAREST,
    SHIFT,
    colour_frame,
    depth_codes,
    depth_frame,
)


def metres_of(codes: NDArray[np.uint16]) -> NDArray[np.float64]:
    first, last = np.log(NEAREST + SHIFT), np.log(FARTHEST + SHIFT)
    return np.exp(codes / LAST_CODE * (last - first) + first) - SHIFT


@pytest.mark.parametrize(("depth", "off"), [(0.5, 0.002), (3.0, 0.003), (30.0, 0.02)])
def test_depth_is_kept_finely_near_by(depth: float, off: float) -> None:
    assert metres_of(depth_codes(np.array([depth]))) == pytest.approx([depth], abs=off)


def test_depth_comes_out_of_the_video_as_it_went_in(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    frames = [rng.uniform(0.3, 40.0, (48, 64)).astype(np.float32) for _ in range(5)]
    frames[2][:, 10] = np.inf
    path = tmp_path / "depth.mp4"
    with VideoFile(path, (64, 48), FPS, DEPTHS) as video:
        for frame in frames:
            video.add(depth_frame(frame))
    with av.open(str(path)) as container:
        found = [each.to_ndarray(format="gray12le") for each in container.decode()]
    assert len(found) == len(frames)
    for one, other in zip(frames, found, strict=True):
        assert (depth_codes(one) == other).all()


def test_colours_keep_their_order_and_their_times(tmp_path: Path) -> None:
    path = tmp_path / "colours.mp4"
    levels = range(0, 250, 25)
    with VideoFile(path, (64, 48), FPS, COLOURS) as video:
        for level in levels:
            video.add(colour_frame(np.full((48, 64, 3), level, dtype=np.uint8)))
    with av.open(str(path)) as container:
        frames = [
            (each.time, each.to_ndarray(format="rgb24").mean())
            for each in container.decode()
        ]
    assert [time for time, _ in frames] == [number / 4 for number in range(10)]
    assert [level for _, level in frames] == pytest.approx(list(levels), abs=4)
