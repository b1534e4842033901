import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import av
import numpy as np
import pyarrow.parquet as parquet
import pytest

from memorymaze.robot.simulation.scene import build_scene
from memorymaze.texts.corpus import Instruction, load_instructions
from memorymaze.texts.corpus.records import Failure
from memorymaze.texts.datasets import DatasetRequest, make_dataset
from memorymaze.texts.datasets.buildings import FinishedBuilding
from memorymaze.texts.datasets.frame_videos import depth_codes
from memorymaze.texts.datasets.lerobot import COLOURS, DEPTH, write_frames
from memorymaze.texts.datasets.splits import PlannedBuilding
from memorymaze.texts.datasets.walks import walk_by_steps
from memorymaze.world.cameras.camera import RenderedCamera
from memorymaze.world.cameras.visual_scene import build_visual_scene
from memorymaze.world.sites import load_site

SIZE = (64, 48)
TEXTS = ("Left at the bend.", "To the right, then stop.", "Left at the bend.")


@pytest.fixture(scope="module")
def building(tiny_sites_folder: Path) -> FinishedBuilding:
    """A building with three texts on one route, the second of them wrong."""
    site = load_site(tiny_sites_folder / "l_shape.geojson")
    route = site.find_route("R1")
    texts = [
        Instruction(
            id=f"text-{number}",
            site=site.name,
            route="R1",
            text=text,
            reference_route=route.id,
            source="synthetic",
            split="train",
        )
        for number, text in enumerate(TEXTS)
    ]
    texts[1] = replace(texts[1], failures=(Failure("wrong_direction", "t1", "left"),))
    walk = walk_by_steps(build_scene(site), route)
    planned = PlannedBuilding("school", 0, "train", None)
    return FinishedBuilding(planned, site, tuple(texts), {route.id: walk})


@pytest.fixture(scope="module")
def written(
    building: FinishedBuilding, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    root = tmp_path_factory.mktemp("lerobot") / "train"
    write_frames(root, "train", [building], SIZE, workers=1, progress=None)
    return root


def rows_of(path: Path) -> list[dict[str, object]]:
    return parquet.read_table(path).to_pylist()


def info_of(root: Path) -> Mapping[str, object]:
    return json.loads((root / "meta/info.json").read_bytes())


def test_every_text_is_an_episode_with_its_words_as_the_task(
    written: Path, building: FinishedBuilding
) -> None:
    episodes = rows_of(written / "meta/episodes/chunk-000/file-000.parquet")
    tasks = rows_of(written / "meta/tasks.parquet")
    rows = rows_of(written / "data/chunk-000/file-000.parquet")
    assert [each["tasks"] for each in episodes] == [[text] for text in TEXTS]
    assert [each["errors"] for each in episodes] == [[], ["wrong_direction"], []]
    text_of = {each["task_index"]: each["task"] for each in tasks}
    assert sorted(text_of.values()) == sorted(set(TEXTS))
    for episode, text in zip(episodes, TEXTS, strict=True):
        own = rows[episode["dataset_from_index"] : episode["dataset_to_index"]]
        assert {text_of[row["task_index"]] for row in own} == {text}
        assert {row["episode_index"] for row in own} == {episode["episode_index"]}
        assert [row["frame_index"] for row in own] == list(range(episode["length"]))


def test_the_actions_lead_from_frame_to_frame_and_end_with_a_stop(
    written: Path, building: FinishedBuilding
) -> None:
    table = parquet.read_table(written / "data/chunk-000/file-000.parquet")
    length = len(building.walks["route_r1_reference"])
    actions = np.array(table["action"].to_pylist())[:length]
    states = np.array(table["observation.state"].to_pylist())[:length]
    assert np.allclose(states[0], 0)
    assert np.allclose(np.diff(states[:, 2]), actions[:-1, 1], atol=0.005)
    ways = np.hypot(*np.diff(states[:, :2], axis=0).T)
    assert np.allclose(ways, actions[:-1, 0], atol=0.005)
    assert actions[:, 2].tolist() == [0.0] * (length - 1) + [1.0]


def test_the_frames_are_what_the_camera_sees_on_the_walk(
    written: Path, building: FinishedBuilding
) -> None:
    walk = building.walks["route_r1_reference"]
    with RenderedCamera(
        build_visual_scene(building.site, looks="own"), *SIZE
    ) as camera:
        seen = camera.frame(walk.pose(7))
    found = {}
    for key, pixels in ((COLOURS, "rgb24"), (DEPTH, "gray12le")):
        path = written / f"videos/{key}/chunk-000/file-000.mp4"
        with av.open(str(path)) as video:
            frames = [each.to_ndarray(format=pixels) for each in video.decode()]
        assert len(frames) == len(walk)
        found[key] = frames[7]
    assert (found[DEPTH] == depth_codes(seen.depth)).all()
    assert np.abs(found[COLOURS].astype(float) - seen.rgb).mean() < 6


def test_the_description_fits_what_is_there(written: Path) -> None:
    info = info_of(written)
    rows = parquet.read_table(written / "data/chunk-000/file-000.parquet")
    assert info["codebase_version"] == "v3.0"
    assert info["total_episodes"] == 3
    assert info["total_tasks"] == 2
    assert info["total_frames"] == rows.num_rows
    assert info["splits"] == {"train": "0:3"}
    in_rows = {
        name for name, each in info["features"].items() if each["dtype"] != "video"
    }
    assert set(rows.column_names) == in_rows
    stats = json.loads((written / "meta/stats.json").read_bytes())
    assert stats["action"]["max"][2] == 1
    assert np.shape(stats[COLOURS]["mean"]) == (3, 1, 1)
    assert 0.5 < stats[DEPTH]["mean"][0][0][0] < 30


LOADING = """
import json, sys
from lerobot.datasets.lerobot_dataset import LeRobotDataset
dataset = LeRobotDataset("memorymaze/made", root=sys.argv[1], video_backend="pyav")
told = []
for number in range(0, len(dataset), 9):
    item = dataset[number]
    told.append({
        "episode": int(item["episode_index"]),
        "frame": int(item["frame_index"]),
        "task": item["task"],
        "colours": list(item["observation.images.front"].shape),
        "depth": float(item["observation.images.front_depth"].mean()),
        "action": item["action"].tolist(),
    })
print(json.dumps({
    "episodes": dataset.num_episodes,
    "metric": bool(getattr(dataset.meta, "depth_keys", None)),
    "frames": told,
}))
"""


def _python_for_lerobot() -> str:
    """Return the newest Python there is: LeRobot of this year wants 3.12."""
    for name in ("python3.13", "python3.12"):
        try:
            subprocess.run([name, "-c", "import venv"], check=True, capture_output=True)
        except (OSError, subprocess.CalledProcessError):
            continue
        return name
    return sys.executable


@pytest.fixture(scope="module")
def lerobot_python() -> Iterator[Path]:
    """The Python of an environment of its own, with the package `lerobot` in it."""
    # pytest would keep the gigabytes of its temporary folders for three more runs.
    with tempfile.TemporaryDirectory(prefix="lerobot-") as folder:
        python = Path(folder) / "bin/python"
        for command in (
            [_python_for_lerobot(), "-m", "venv", folder],
            [
                *(str(python), "-m", "pip", "install", "--quiet", "--no-compile"),
                "lerobot[dataset]",  # an extra from 0.6 on; before, it is all there
            ],
        ):
            done = subprocess.run(command, capture_output=True, text=True)
            assert done.returncode == 0, (
                "expected an environment with the package lerobot, which needs a "
                f"package index and 9 GB of disk; {' '.join(command)} said: "
                f"{done.stderr[-2000:]}"
            )
        yield python


@pytest.mark.proof
def test_the_real_lerobot_reads_what_is_written(
    lerobot_python: Path, tmp_path: Path
) -> None:
    request = DatasetRequest(buildings=3, per_route=2, frame_size=(128, 96))
    make_dataset(request, tmp_path / "made")
    for split in ("train", "val_seen", "val_unseen", "test"):
        root = tmp_path / "made/frames" / split
        done = subprocess.run(
            [str(lerobot_python), "-c", LOADING, str(root)],
            capture_output=True,
            text=True,
            env={"HF_HUB_OFFLINE": "1", "HOME": str(tmp_path)},
        )
        assert done.returncode == 0, done.stderr
        told = json.loads(done.stdout.splitlines()[-1])
        texts = [
            each.text for each in load_instructions([tmp_path / f"made/{split}.jsonl"])
        ]
        assert told["episodes"] == len(texts)
        for frame in told["frames"]:
            assert frame["task"] == texts[frame["episode"]]
            assert frame["colours"] == [3, 96, 128]
            assert sum(map(bool, frame["action"])) == 1
            if told["metric"]:  # millimetres, from 0.6 on
                assert 300 < frame["depth"] < 50_000
