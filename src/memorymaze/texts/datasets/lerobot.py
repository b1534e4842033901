"""Frames of perfect walks in the layout of LeRobot's datasets, version 3.0.

One dataset per split; every text of the split is an episode, its words the task. A
building has one file of rows and one of each video. Texts of one route share the frames
of its walk: their episodes name the same part of the same video.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet
from numpy.typing import NDArray

from memorymaze.basics.video_file import VideoFile
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.datasets import frame_videos
from memorymaze.texts.datasets.buildings import FinishedBuilding
from memorymaze.texts.datasets.frame_videos import FPS
from memorymaze.texts.datasets.moments import RowMoments
from memorymaze.texts.datasets.walks import StepWalk
from memorymaze.texts.datasets.workers import done_by_processes
from memorymaze.texts.exchange.vln_ce import FORWARD, LEFT, RIGHT, STEP, STOP, TURN
from memorymaze.world.sites import Site

VERSION = "v3.0"
FILES_IN_A_CHUNK = 1000
PLACE = "chunk-{chunk_index:03d}/file-{file_index:03d}"
DATA = f"data/{PLACE}.parquet"
VIDEOS = f"videos/{{video_key}}/{PLACE}.mp4"
EPISODES = "meta/episodes/chunk-000/file-000.parquet"
COLOURS, DEPTH = "observation.images.front", "observation.images.front_depth"
EVERY_PIXEL = 8
"""Of so many pixels in a row or column one counts for the means of pictures."""
VECTORS: Mapping[str, tuple[str, ...]] = {
    "observation.state": ("x", "y", "heading"),
    "action": ("forward", "turn", "stop"),
    "pose": ("x", "y", "heading"),
}
"""What the rows hold in floats: the way since the start in the frame of the start (true,
not odometry); metres, radians (left positive) and 1 at the end; where it is in the plan."""
WHOLE = ("vln_ce_action", "frame_index", "episode_index", "index", "task_index")


@dataclass(frozen=True, slots=True)
class DatasetEpisode:
    """A text, the walk that belongs to it, and where both lie in the files."""

    number: int
    first: int
    """Row of the dataset."""
    task: int
    instruction: Instruction
    walk: StepWalk
    starts: int
    """Frame of its building's videos."""


@dataclass(frozen=True, slots=True)
class BuildingFrames:
    """What a worker needs to write the files of a building."""

    root: Path
    number: int
    """Of the building in its split."""
    site: Site
    walks: tuple[StepWalk, ...]
    """In the order of the videos."""
    episodes: tuple[DatasetEpisode, ...]
    size: tuple[int, int]
    """Width and height of frames, pixels."""


def write_frames(
    root: Path,
    split: str,
    buildings: Sequence[FinishedBuilding],
    size: tuple[int, int],
    workers: int,
    progress: Callable[[int, int, str], None] | None,
) -> None:
    """Write the dataset of a split.

    Raises:
        RenderingError: This machine cannot draw; says what to install.
    """
    tasks: dict[str, int] = {}
    jobs: list[BuildingFrames] = []
    rows = episodes = 0
    for building in buildings:
        texts = [each for each in building.instructions if each.split == split]
        if not texts:
            continue
        walks: list[StepWalk] = []
        starts: dict[str, int] = {}
        members: list[DatasetEpisode] = []
        for text in texts:
            walk = building.walks[text.reference_route]
            if text.reference_route not in starts:
                starts[text.reference_route] = sum(map(len, walks))
                walks.append(walk)
            task = tasks.setdefault(text.text, len(tasks))
            start = starts[text.reference_route]
            members.append(DatasetEpisode(episodes, rows, task, text, walk, start))
            episodes, rows = episodes + 1, rows + len(walk)
        jobs.append(
            BuildingFrames(
                root, len(jobs), building.site, tuple(walks), tuple(members), size
            )
        )
    moments = {name: RowMoments.none() for name in (*VECTORS, COLOURS, DEPTH)}
    for done, found in enumerate(done_by_processes(write_building, jobs, workers), 1):
        for name, more in found.items():
            moments[name] = moments[name] + more
        if progress is not None:
            progress(done, len(jobs), f"frames of {split}")
    _write_episodes(root / EPISODES, jobs)
    pd.DataFrame(
        {"task_index": range(len(tasks))}, index=pd.Index(tasks, name="task")
    ).to_parquet(root / "meta/tasks.parquet")
    _write_json(
        root / "meta/stats.json",
        {
            name: each.record(picture=name.startswith("observation.images"))
            for name, each in moments.items()
        },
    )
    said = _info(split, size, episodes=episodes, frames=rows, tasks=len(tasks))
    _write_json(root / "meta/info.json", said)


def write_building(job: BuildingFrames) -> dict[str, RowMoments]:
    """Write rows and videos of a building; return what they have in the mean."""
    moments = _draw(job)
    columns = [_columns(each) for each in job.episodes]
    joined = {
        name: np.concatenate([each[name] for each in columns]) for name in VECTORS
    }
    moments |= {name: RowMoments.of(values) for name, values in joined.items()}
    table = pa.table({
        **{
            name: pa.FixedSizeListArray.from_arrays(values.ravel(), values.shape[1])
            for name, values in joined.items()
        },
        "timestamp": np.concatenate([each["timestamp"] for each in columns]),
        **{name: np.concatenate([each[name] for each in columns]) for name in WHOLE},
    })
    path = job.root / DATA.format(**_place(job.number))
    path.parent.mkdir(parents=True, exist_ok=True)
    pyarrow.parquet.write_table(table, path)
    return moments


def _draw(job: BuildingFrames) -> dict[str, RowMoments]:
    # Datasets without frames load neither OpenGL nor the looks of things.
    from memorymaze.world.cameras.camera import RenderedCamera
    from memorymaze.world.cameras.visual_scene import build_visual_scene

    colours = depth = RowMoments.none()
    videos = {
        name: job.root / VIDEOS.format(video_key=name, **_place(job.number))
        for name in (COLOURS, DEPTH)
    }
    for file in videos.values():
        file.parent.mkdir(parents=True, exist_ok=True)
    with (
        RenderedCamera(build_visual_scene(job.site), *job.size) as camera,
        VideoFile(videos[COLOURS], job.size, FPS, frame_videos.COLOURS) as colour_video,
        VideoFile(videos[DEPTH], job.size, FPS, frame_videos.DEPTHS) as depth_video,
    ):
        for walk in job.walks:
            episodes = sum(each.walk is walk for each in job.episodes)
            for number in range(len(walk)):
                frame = camera.frame(walk.pose(number))
                colour_video.add(frame_videos.colour_frame(frame.rgb))
                depth_video.add(frame_videos.depth_frame(frame.depth))
                some = slice(None, None, EVERY_PIXEL)
                pixels = frame.rgb[some, some].reshape(-1, 3) / 255
                metres = np.clip(
                    frame.depth[some, some], frame_videos.NEAREST, frame_videos.FARTHEST
                )
                colours += RowMoments.of(pixels, episodes)
                depth += RowMoments.of(metres.reshape(-1, 1), episodes)
    return {COLOURS: colours, DEPTH: depth}


def _columns(episode: DatasetEpisode) -> dict[str, NDArray[Any]]:
    """Return the rows of an episode, column by column."""
    walk, count = episode.walk, len(episode.walk)
    way = walk.poses - walk.poses[0]
    cos, sin = np.cos(walk.poses[0, 2]), np.sin(walk.poses[0, 2])
    ahead, left = way[:, 0] * cos + way[:, 1] * sin, way[:, 1] * cos - way[:, 0] * sin
    turned = np.remainder(way[:, 2] + math.pi, math.tau) - math.pi
    turns = (walk.actions == LEFT) * TURN - (walk.actions == RIGHT) * TURN
    action = [(walk.actions == FORWARD) * STEP, turns, walk.actions == STOP]
    frames = np.arange(count)
    return {
        "observation.state": np.column_stack([ahead, left, turned]).astype(np.float32),
        "action": np.column_stack(action).astype(np.float32),
        "pose": walk.poses.astype(np.float32),
        "timestamp": (frames / FPS).astype(np.float32),
        "vln_ce_action": walk.actions.astype(np.int64),
        "frame_index": frames,
        "episode_index": np.full(count, episode.number),
        "index": episode.first + frames,
        "task_index": np.full(count, episode.task),
    }


def _write_episodes(path: Path, jobs: Sequence[BuildingFrames]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    rows: list[dict[str, Any]] = []
    for job in jobs:
        place = _place(job.number)
        for each in job.episodes:
            length = len(each.walk)
            row: dict[str, Any] = {
                "episode_index": each.number,
                "tasks": [each.instruction.text],
                "length": length,
                "dataset_from_index": each.first,
                "dataset_to_index": each.first + length,
                "meta/episodes/chunk_index": 0,
                "meta/episodes/file_index": 0,
                "instruction_id": each.instruction.id,
                "site": each.instruction.site,
                "route": each.instruction.reference_route,
                "source": each.instruction.source,
                "errors": [failure.kind for failure in each.instruction.failures],
            }
            for name, value in place.items():
                row[f"data/{name}"] = value
            for video in (COLOURS, DEPTH):
                for name, value in place.items():
                    row[f"videos/{video}/{name}"] = value
                row[f"videos/{video}/from_timestamp"] = each.starts / FPS
                row[f"videos/{video}/to_timestamp"] = (each.starts + length) / FPS
            rows.append(row)
    pyarrow.parquet.write_table(pa.Table.from_pylist(rows), path)


def _info(
    split: str, size: tuple[int, int], *, episodes: int, frames: int, tasks: int
) -> dict[str, Any]:
    width, height = size
    features: dict[str, Any] = {
        name: {
            "dtype": "video",
            "shape": [height, width, channels],
            "names": ["height", "width", "channels"],
            "info": frame_videos.info(size, depth=channels == 1),
        }
        for name, channels in ((COLOURS, 3), (DEPTH, 1))
    }
    for name, parts in VECTORS.items():
        features[name] = {"dtype": "float32", "shape": [3], "names": list(parts)}
    for name in ("timestamp", *WHOLE):
        dtype = "float32" if name == "timestamp" else "int64"
        features[name] = {"dtype": dtype, "shape": [1], "names": None}
    return {
        "codebase_version": VERSION,
        "robot_type": "memorymaze",
        "total_episodes": episodes,
        "total_frames": frames,
        "total_tasks": tasks,
        "chunks_size": FILES_IN_A_CHUNK,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 200,
        "fps": FPS,
        "splits": {split: f"0:{episodes}"},
        "data_path": DATA,
        "video_path": VIDEOS,
        "features": features,
    }


def _place(number: int) -> dict[str, int]:
    chunk, file = divmod(number, FILES_IN_A_CHUNK)
    return {"chunk_index": chunk, "file_index": file}


def _write_json(path: Path, value: Mapping[str, Any]) -> None:
    path.write_text(json.dumps(value, indent=4) + "\n", encoding="utf-8")
