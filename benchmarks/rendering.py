"""How many pictures a second the robot's camera gives on a route, beside Miniworld.

Ours: RGB, depth and instance ids together, without multisampling, on the museum's fifth
floor along route R1. Miniworld's: RGB alone. Both draw in turns, so that whatever else
the machine does falls on both; of several turns the fastest counts.
"""

import importlib.util
import math
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from benchmarks.measuring import Row, timed
from memorymaze.geometry.pose import Pose, heading_to
from memorymaze.pictures.rendering import (
    RenderedCamera,
    VisualScene,
    build_visual_scene,
)
from memorymaze.sites import Site, load_site

SITE, ROUTE = "museum_5f", "R1"
SIZES = ((224, 224), (640, 480))
POSES = 40
TURNS = 7
PYTHON_VARIABLE = "MINIWORLD_PYTHON"
HINT = f"""\
rendering: Miniworld is not installed, so nothing to compare with. Type
    python3 -m venv /tmp/miniworld && /tmp/miniworld/bin/pip install miniworld
    {PYTHON_VARIABLE}=/tmp/miniworld/bin/python python -m benchmarks --only rendering"""

BASELINES = (
    # scene, samples, whether the promise is made against it, in words
    ("furnished", 0, True, "Miniworld RGB, furnished maze, no multisampling"),
    ("maze", 4, False, "Miniworld RGB, Maze-v0 as it comes, 4 samples"),
    ("maze", 0, False, "Miniworld RGB, bare Maze-v0, no multisampling"),
)


def run() -> list[Row]:
    site = load_site(SITE)
    scene, took = timed(lambda: build_visual_scene(site))
    rows = [Row(f"looks of {SITE} built", took / 1e3, "s")]
    python = miniworld_python()
    for width, height in SIZES:
        rows += compared(scene, site, width, height, python)
    return rows


def compared(
    scene: VisualScene, site: Site, width: int, height: int, python: str | None
) -> list[Row]:
    poses = along_route(site)
    ours: list[float] = []
    colours: list[float] = []
    theirs: list[list[float]] = [[] for _ in BASELINES]
    others = [
        Miniworld(python, name, width, height, samples)
        for name, samples, *_ in BASELINES
        if python is not None
    ]
    for other in others:
        other.milliseconds(POSES)
    with RenderedCamera(scene, width, height) as camera:
        for pose in poses:
            camera.frame(pose)
        for _ in range(TURNS):
            ours.append(milliseconds(camera.frame, poses))
            colours.append(milliseconds(camera.picture, poses))
            for times, other in zip(theirs, others, strict=False):
                times.append(other.milliseconds(POSES))
    for other in others:
        other.close()
    size = f"{width}x{height}"
    rate = 1e3 / min(ours)
    rows = [Row(f"RGB alone, {size}", 1e3 / min(colours), "frames/s")]
    if python is None:
        return [Row(f"RGB + depth + ids, {size}", rate, "frames/s"), *rows]
    for times, (_, _, promised, words) in zip(theirs, BASELINES, strict=True):
        baseline = 1e3 / min(times)
        rows.append(
            Row(
                f"RGB + depth + ids, {size}",
                rate,
                "frames/s",
                baseline,
                words,
                target=baseline if promised else None,
                higher_is_better=True,
            )
        )
    return rows


def milliseconds(draw: Callable[[Pose], object], poses: list[Pose]) -> float:
    """Return the mean time of a picture."""

    def all_poses() -> None:
        for pose in poses:
            draw(pose)

    return timed(all_poses)[1] / len(poses)


def along_route(site: Site) -> list[Pose]:
    """Return evenly spaced poses that look along the route."""
    line = site.reference_route(ROUTE).line
    poses: list[Pose] = []
    for number in range(POSES):
        along = (line.length - 0.6) * number / (POSES - 1)
        here, there = line.interpolate(along), line.interpolate(along + 0.5)
        heading = heading_to((here.x, here.y), (there.x, there.y))
        poses.append(Pose(here.x, here.y, heading % (2 * math.pi)))
    return poses


class Miniworld:
    """Miniworld in a process of its own, for it keeps to one window per process."""

    def __init__(
        self, python: str, scene: str, width: int, height: int, samples: int
    ) -> None:
        """Start it, with an interpreter that has it."""
        script = str(Path(__file__).with_name("miniworld_frames.py"))
        self._worker = subprocess.Popen(
            [python, script, scene, str(width), str(height), str(samples)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def milliseconds(self, frames: int) -> float:
        """Return the mean time of a picture."""
        assert self._worker.stdin is not None
        assert self._worker.stdout is not None
        print(frames, file=self._worker.stdin, flush=True)
        for line in self._worker.stdout:
            try:
                return float(line)
            except ValueError:
                continue  # it tells of its frame buffers on stdout
        raise SystemExit("rendering: Miniworld's process ended; see its message above")

    def close(self) -> None:
        """End it."""
        assert self._worker.stdin is not None
        self._worker.stdin.close()
        self._worker.wait()


def miniworld_python() -> str | None:
    """Return an interpreter that has Miniworld; None, and a hint, without one."""
    python = os.environ.get(PYTHON_VARIABLE)
    if python is None and importlib.util.find_spec("miniworld") is not None:
        python = sys.executable
    if python is None:
        print(HINT, file=sys.stderr)
    return python
