"""How many frames a second of a study's 360-degree film are made, beside how it was before.

Before: one process draws the six faces for every frame, one after another, and encodes.
Ours: `film_walkthrough`'s own parts. Both make the same frames, of pieces spread evenly over route R1 of the university, so that
turns and straights are as frequent as in the whole film. What begins a film (the looks, the
camera, processes) is not counted.
"""

import math
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import closing
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.measuring import Row
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.processes import available_cores
from memorymaze.basics.video_file import write_video
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.runs.films import WalkthroughSettings
from memorymaze.runs.films.drawing import (
    AHEAD,
    MOST_PROCESSES,
    Artist,
    frames_from,
)
from memorymaze.runs.films.walkthrough import tour_of
from memorymaze.world.sites import Site, load_site

SITE, ROUTE = "university", "R1"
SETTINGS = WalkthroughSettings(size=(1920, 960), panorama=True, fps=10)
"""Those of a new study file."""
PIECES, LENGTH = 6, 8
"""Pieces of the film, and frames of each."""


def run() -> list[Row]:
    site = load_site(SITE)
    tour = tour_of(build_scene(site), site.find_route(ROUTE))
    whole = list(tour.poses(SETTINGS.fps))
    starts = np.linspace(0, len(whole) - LENGTH, PIECES).astype(int)
    poses = [pose for start in starts for pose in whole[start : start + LENGTH]]
    before, now = rate_before(site, poses), rate_now(site, poses)
    return [
        Row(
            f"360-degree film, 1920x960, {available_cores()} cores",
            now,
            "frames/s",
            before,
            "every frame drawn in one process",
            higher_is_better=True,
        )
    ]


def rate_before(site: Site, poses: list[Pose]) -> float:
    with closing(Artist(site, SETTINGS)) as artist:
        artist.planes(poses[0])
        began = time.perf_counter()
        encode(artist.planes(pose) for pose in poses)
        return len(poses) / (time.perf_counter() - began)


def rate_now(site: Site, poses: list[Pose]) -> float:
    # Some pictures more come first: when they are there, every process is at work.
    begun = AHEAD * min(available_cores(), MOST_PROCESSES)
    first = [Pose(poses[0].x + n / 100, *poses[0][1:]) for n in range(1, begun + 1)]
    began = math.inf

    def timed(frames: Iterable[NDArray[np.uint8]]) -> Iterator[NDArray[np.uint8]]:
        nonlocal began
        for number, frame in enumerate(frames):
            if number == begun:
                began = time.perf_counter()
            yield frame

    with closing(frames_from(site, SETTINGS, [*first, *poses])) as drawn:
        encode(timed(drawn))
    # Those drawn ahead when the clock began are not counted.
    return (len(poses) - begun) / (time.perf_counter() - began)


def encode(frames: Iterable[NDArray[np.uint8]]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        write_video(path, frames, SETTINGS.pixels, SETTINGS.fps, title="", total=0)
