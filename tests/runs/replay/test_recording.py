from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rerun.chunk import RrdReader

from memorymaze.basics.errors import SettingsError
from memorymaze.runs.replay.film import ReplaySettings
from memorymaze.runs.replay.recording import record_replay
from memorymaze.runs.story import RecordedEpisode

BLIND = ReplaySettings(camera=False)


def rows_of(path: Path) -> dict[str, list[Any]]:
    """Return the chunks of a recording by entity."""
    entities: dict[str, list[Any]] = {}
    for chunk in RrdReader(path).store().stream():
        entities.setdefault(chunk.entity_path, []).append(chunk)
    return entities


def test_rerun_reads_back_poses_people_scans_and_log(
    crowded_episode: RecordedEpisode, tmp_path: Path
) -> None:
    path = tmp_path / "walk.rrd"
    record_replay(crowded_episode, path, BLIND, view_every=10)
    assert [each.name for each in tmp_path.iterdir()] == ["walk.rrd"]
    entities = rows_of(path)
    moving = [each for each in entities["/world/robot"] if not each.is_static]
    poses = crowded_episode.story.walk.poses
    assert sum(each.num_rows for each in moving) == len(poses)
    assert all(each.timeline_names == ["simulated_time"] for each in moving)
    seconds = np.concatenate([
        each.to_record_batch().column("simulated_time").to_numpy() for each in moving
    ]) / np.timedelta64(1, "s")
    np.testing.assert_allclose(np.sort(seconds), [pose.time for pose in poses])
    assert {"/world/robot/lidar", "/log", "/step", "/world/things"} <= set(entities)
    assert any(name.startswith("/world/people/") for name in entities)
    assert "/world/robot/camera/image" not in entities


def test_camera_and_depth_are_there_at_every_view(
    episode: RecordedEpisode, tmp_path: Path
) -> None:
    path = tmp_path / "walk.rrd"
    record_replay(episode, path, view_every=1000)
    entities = rows_of(path)
    views = sum(each.num_rows for each in entities["/world/robot/lidar"])
    for name in ("image", "depth"):
        chunks = entities[f"/world/robot/camera/{name}"]
        assert sum(each.num_rows for each in chunks) == views >= 2


def test_what_breaks_off_leaves_no_recording(
    episode: RecordedEpisode, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("memorymaze.runs.replay.recording._Log.log_moving", interrupted)
    with pytest.raises(KeyboardInterrupt):
        record_replay(episode, tmp_path / "walk.rrd", BLIND)
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "said"), [("walk.mp4", r"\*\.rrd"), ("nowhere/walk.rrd", "make ")]
)
def test_a_recording_must_have_a_place(
    episode: RecordedEpisode, tmp_path: Path, name: str, said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        record_replay(episode, tmp_path / name, BLIND)
