"""Drawing the frames of a film: no picture twice, and by as many processes as help."""

import math
import os
from collections import deque
from collections.abc import Generator, Iterable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.basics.geometry.pose import Pose, turn_between
from memorymaze.basics.processes import (
    PROCESSES,
    available_cores,
    begin_worker,
    main_left_out,
    start_server,
)
from memorymaze.basics.video_file import planes_of, require_encoder, video_frame
from memorymaze.runs.films.settings import WalkthroughSettings
from memorymaze.world.cameras.camera import RenderedCamera
from memorymaze.world.cameras.visual_scene import build_visual_scene
from memorymaze.world.sites.records import Site

MOST_PROCESSES = 8
"""That draw; the encoder, a single thread, keeps up with no more."""
POSES_EACH = 10
"""Fewer poses than this are not worth a process, which takes seconds to begin."""
AHEAD = 3
"""Pictures per process that are drawn before they are wanted."""
SAME_PLACE = 0.002
"""Metres within which a panorama is turned instead of drawn anew."""
CUBE: tuple[tuple[float, float], ...] = (
    (-math.pi / 2, 0.0),
    (math.pi / 2, 0.0),
    (0.0, math.pi / 2),
    (0.0, -math.pi / 2),
    (0.0, 0.0),
    (math.pi, 0.0),
)
"""Bearing and pitch of a cube's faces, in the order that FFmpeg's filter v360 takes."""
FINER = math.sqrt(2)
"""Pixels of a face for one of the panorama, at the middle of both: two on a square.

They smooth edges as well as the samples of graphics cards, in half the time where a
processor draws.
"""
MARGIN = 1
"""Pixels that a face reaches over its edges."""


def frames_from(
    site: Site, settings: WalkthroughSettings, poses: Iterable[Pose]
) -> Generator[NDArray[np.uint8]]:
    """Draw what is seen from each pose, in order: planes of each (`planes_of`).

    Raises:
        SettingsError: The extra `video` is missing.
        RenderingError: This machine cannot draw; says what to install.
        MemoryMazeError: A process was killed.
    """
    require_encoder()
    places = places_drawn(poses, panorama=settings.panorama)
    drawn = [pose for pose, _ in places]
    with closing(_drawn_by_processes(site, settings, drawn)) as pictures:
        for (_, turns), picture in zip(places, pictures, strict=True):
            for turn in turns:
                yield panorama_turned(picture, turn) if turn else picture


def places_drawn(
    poses: Iterable[Pose], *, panorama: bool
) -> list[tuple[Pose, list[float]]]:
    """Return the poses to draw from, each with how its picture is turned for its frames.

    All round, one picture serves for every heading at a place: radians to the left.
    """
    places: list[tuple[Pose, list[float]]] = []
    for pose in poses:
        last, turns = places[-1] if places else (None, [])
        if last is not None and (
            math.dist(pose[:2], last[:2]) < SAME_PLACE if panorama else pose == last
        ):
            turns.append(turn_between(last.heading, pose.heading))
        else:
            places.append((pose, [0.0]))
    return places


def panorama_turned(planes: NDArray[np.uint8], angle: float) -> NDArray[np.uint8]:
    """Turn a panorama to the left, by whole columns of its colours (two of its pixels)."""
    width, size = planes.shape[1], planes.size * 2 // 3
    columns = round(angle * width / (4 * math.pi))
    pixels, colours = planes.reshape(-1)[:size], planes.reshape(-1)[size:]
    return np.concatenate([
        np.roll(pixels.reshape(-1, width), 2 * columns, axis=1).reshape(-1),
        np.roll(colours.reshape(-1, width // 2), columns, axis=1).reshape(-1),
    ]).reshape(planes.shape)


def _drawn_by_processes(
    site: Site, settings: WalkthroughSettings, poses: Sequence[Pose]
) -> Generator[NDArray[np.uint8]]:
    useful = min(MOST_PROCESSES, math.ceil(len(poses) / POSES_EACH))
    workers = max(1, min(available_cores(), useful))
    start_server(__name__, "av.filter")
    pool = ProcessPoolExecutor(
        workers, PROCESSES, initializer=_begin, initargs=(site, settings)
    )
    under_way: deque[Future[NDArray[np.uint8]]] = deque()
    left = iter(poses)
    try:
        with main_left_out():
            for _, pose in zip(range(AHEAD * workers), left, strict=False):
                under_way.append(pool.submit(_draw, pose))
        while under_way:
            picture = under_way.popleft().result()
            if (pose := next(left, None)) is not None:
                under_way.append(pool.submit(_draw, pose))
            yield picture
    except BrokenProcessPool:
        raise MemoryMazeError(
            "a process that drew was killed; there may be too little memory"
        ) from None
    finally:
        pool.shutdown(cancel_futures=True)


_task: tuple[Site, WalkthroughSettings]
_artist: "Artist | None" = None
"""Of this process; opened by the first picture, so that a failure is told as its own."""


def _begin(site: Site, settings: WalkthroughSettings) -> None:
    global _task
    begin_worker()
    # There is a process for each core: threads of Mesa's would only wait for another.
    os.environ.setdefault("LP_NUM_THREADS", "0")
    _task = (site, settings)


def _draw(pose: Pose) -> NDArray[np.uint8]:
    global _artist
    if _artist is None:
        _artist = Artist(*_task)
    return _artist.planes(pose)


class Artist:
    """Draws what is seen in a building."""

    def __init__(self, site: Site, settings: WalkthroughSettings) -> None:
        """Build the looks and open a camera, which takes seconds."""
        size, fov = settings.pixels, settings.horizontal_fov
        samples = settings.multisamples
        self._height = settings.height
        self._projection = None
        if settings.panorama:
            inner = 2 * math.ceil(FINER * size[0] / math.pi / 2)
            edge = inner + 2 * MARGIN
            self._projection = _Projection(edge, size[0])
            size, fov, samples = (edge, edge), 2 * math.atan(edge / inner), 0
        looks = build_visual_scene(site, looks=settings.looks)
        self._camera = RenderedCamera(
            looks, *size, fov, multisamples=samples, trilinear=False
        )

    def planes(self, pose: Pose) -> NDArray[np.uint8]:
        """Draw what is seen from a pose, as planes (`planes_of`)."""
        camera, height = self._camera, self._height
        if self._projection is None:
            return planes_of(camera.picture(pose, height))
        faces = [
            camera.picture(Pose(pose.x, pose.y, pose.heading + bearing), height, pitch)
            for bearing, pitch in CUBE
        ]
        return self._projection.panorama(faces)

    def close(self) -> None:
        """Give back its memory; it draws no more."""
        self._camera.close()


class _Projection:
    """Puts the faces of a cube together to a panorama, by FFmpeg's filter v360."""

    def __init__(self, edge: int, width: int) -> None:
        import av
        from av.filter import Graph

        self._graph = graph = Graph()
        graph.threads = 1
        graph.link_nodes(
            graph.add_buffer(
                width=3 * edge,
                height=2 * edge,
                format=av.VideoFormat("yuv420p"),
                time_base=Fraction(1),
            ),
            graph.add(
                "v360",
                f"input=c3x2:output=equirect:interp=linear:fin_pad={2 * MARGIN}"
                f":w={width}:h={width // 2}",
            ),
            graph.add("buffersink"),
        ).configure()
        self._made = 0

    def panorama(self, faces: Sequence[NDArray[np.uint8]]) -> NDArray[np.uint8]:
        """Return the planes of the panorama."""
        from av import VideoFrame

        rows = [np.concatenate(faces[:3], axis=1), np.concatenate(faces[3:], axis=1)]
        frame = video_frame(np.concatenate(rows))
        frame.pts = self._made
        self._made += 1
        self._graph.push(frame)
        made = self._graph.pull()
        assert isinstance(made, VideoFrame)
        return np.asarray(made.to_ndarray(), dtype=np.uint8)
