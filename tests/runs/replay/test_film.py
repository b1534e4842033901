from pathlib import Path

import av
import numpy as np
import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.runs.replay.film import (
    ReplaySettings,
    film_replay,
    frames_of,
)
from memorymaze.runs.story import RecordedEpisode

QUICK = ReplaySettings(size=(320, 240), fps=1, speed=10, camera=False, hold=0)


def test_a_replay_has_a_frame_for_every_equal_step_and_one_for_the_end(
    episode: RecordedEpisode, tmp_path: Path
) -> None:
    path = tmp_path / "walk.mp4"
    count = film_replay(episode, path, QUICK)
    duration = episode.story.walk.duration
    assert count == int(np.ceil(duration / 10)) + 1
    with av.open(path) as film:
        frames = [each.to_ndarray(format="rgb24") for each in film.decode(video=0)]
    assert len(frames) == count
    assert frames[0].shape == (240, 320, 3)


def test_the_same_episode_gives_the_same_pictures(
    crowded_episode: RecordedEpisode, tmp_path: Path
) -> None:
    films: list[list[np.ndarray]] = []
    for name in ("one.mp4", "other.mp4"):
        film_replay(crowded_episode, tmp_path / name, QUICK)
        with av.open(tmp_path / name) as film:
            films.append([f.to_ndarray(format="rgb24") for f in film.decode(video=0)])
    assert len(films[0]) == len(films[1])
    for one, other in zip(*films, strict=True):
        assert np.abs(one.astype(int) - other).mean() < 0.5


def test_what_breaks_off_leaves_the_file_as_it_was(
    episode: RecordedEpisode, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "walk.mp4"
    path.write_bytes(b"older")

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("memorymaze.runs.replay.film.PlanView.picture", interrupted)
    with pytest.raises(KeyboardInterrupt):
        film_replay(episode, path, QUICK)
    assert path.read_bytes() == b"older"
    assert list(tmp_path.iterdir()) == [path]


def test_the_camera_shows_the_people_of_the_episode(
    crowded_episode: RecordedEpisode,
) -> None:
    settings = ReplaySettings(
        size=(320, 240), fps=1, speed=100, smooth=False, hold=0
    )  # begin and end
    with_camera = list(frames_of(crowded_episode, settings))
    assert len(with_camera) == 2
    view = with_camera[0][15:100, :200]
    # Not a plain wall: the view of a building has many colours.
    assert len(np.unique(view.reshape(-1, 3), axis=0)) > 100


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        pytest.param({"size": (321, 240)}, "even numbers", id="odd size"),
        pytest.param({"size": (64, 64)}, "from 240", id="small"),
        pytest.param({"fps": 0.0}, "fps: expected", id="no frames"),
        pytest.param(
            {"speed": float("nan")}, "speed: expected a number from 0.1", id="speed"
        ),
    ],
)
def test_settings_without_meaning_are_refused(
    wrong: dict[str, object], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        ReplaySettings(**wrong)  # type: ignore[arg-type]
