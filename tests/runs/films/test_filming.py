import math
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import av
import numpy as np
import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.video_file import BT709, LIMITED_RANGE, video_frame
from memorymaze.robot.simulation.cameras import visual_scene_of
from memorymaze.robot.simulation.scene import Scene
from memorymaze.runs.films import WalkthroughSettings
from memorymaze.runs.films.drawing import Artist, panorama_turned, places_drawn
from memorymaze.runs.films.walkthrough import film_walkthrough
from memorymaze.world.cameras import RenderedCamera


def frames_of(path: Path) -> list[np.ndarray]:
    with av.open(str(path)) as film:
        return [each.to_ndarray(format="rgb24") for each in film.decode(video=0)]


def likeness(one: np.ndarray, other: np.ndarray) -> float:
    """Return the correlation of two pictures."""
    return float(np.corrcoef(one.ravel(), other.ravel())[0, 1])


@pytest.mark.proof
def test_a_film_shows_the_way_from_its_start_to_its_goal(
    scenes: dict[str, Scene], tmp_path: Path
) -> None:
    scene, path = scenes["corridor"], tmp_path / "film.mp4"
    settings = WalkthroughSettings(size=(96, 64), fps=2, speed=4)
    count = film_walkthrough(scene, scene.site.routes[0], path, settings)
    frames = frames_of(path)
    assert len(frames) == count
    looks = visual_scene_of(scene, "own")
    with RenderedCamera(looks, 96, 64, math.pi / 2, multisamples=4) as camera:
        first = camera.picture(Pose(2.0, 0.0, 0.0), 1.6)
        last = camera.picture(Pose(16.5, 0.0, 0.0), 1.6)
    assert likeness(frames[0], first) > 0.98 > likeness(frames[0], last)
    assert likeness(frames[-1], last) > 0.98


@pytest.mark.proof
def test_the_same_settings_give_the_same_film_with_a_bar_on_stderr_if_asked_for(
    scenes: dict[str, Scene], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = scenes["corridor"]
    settings = WalkthroughSettings(size=(64, 48), fps=1, speed=8)
    films = [tmp_path / "one.mp4", tmp_path / "other.mp4"]
    for path in films:
        count = film_walkthrough(
            scene, scene.site.routes[0], path, settings, progress=path is films[1]
        )
        assert (f"{count}/{count}" in capsys.readouterr().err) is (path is films[1])
    assert films[0].read_bytes() == films[1].read_bytes()


def test_a_panorama_looks_all_round(scenes: dict[str, Scene], tmp_path: Path) -> None:
    scene, path = scenes["corridor"], tmp_path / "film.mp4"
    settings = WalkthroughSettings(size=(128, 64), fps=1, speed=10, panorama=True)
    film_walkthrough(scene, scene.site.routes[0], path, settings)
    with closing(Artist(scene.site, settings)) as artist:
        around = colours(artist.planes(Pose(2.0, 0.0, 0.0)))
    assert likeness(frames_of(path)[0], around) > 0.95


def test_a_panorama_shows_in_each_direction_what_is_there(
    corridor_artist: Artist, scenes: dict[str, Scene]
) -> None:
    pose, (rows, columns) = Pose(6.0, 0.3, 0.4), np.mgrid[8:256:16, 4:512:16]
    with RenderedCamera(
        visual_scene_of(scenes["corridor"], "own"),
        3,
        3,
        math.radians(2),
        multisamples=4,
    ) as camera:
        around = np.array([
            camera.picture(
                Pose(6.0, 0.3, 0.4 + math.pi - 2 * math.pi * (column + 0.5) / 512),
                1.6,
                math.pi / 2 - math.pi * (row + 0.5) / 256,
            )[1, 1]
            for row, column in zip(rows.flat, columns.flat, strict=True)
        ]).reshape(*rows.shape, 3)
    drawn = colours(corridor_artist.planes(pose))
    assert difference(drawn[rows, columns], around) < 5.0
    # Nothing is out of its place: two columns off it is less like it.
    for off in (-2, 2):
        aside = drawn[rows, columns + off]
        assert (
            difference(aside, around) > difference(drawn[rows, columns], around) + 0.5
        )


def test_a_turn_on_the_spot_is_a_panorama_turned(corridor_artist: Artist) -> None:
    start, quarter = Pose(6.0, 0.3, 0.0), Pose(6.0, 0.3, math.pi / 2)
    onwards = Pose(6.1, 0.3, math.pi / 2)
    places = places_drawn([start, start, quarter, onwards], panorama=True)
    assert places == [(start, [0, 0, pytest.approx(math.pi / 2)]), (onwards, [0])]
    drawn, again = map(corridor_artist.planes, (start, quarter))
    rolled = colours(panorama_turned(drawn, math.pi / 2))
    assert difference(rolled, colours(again)) < 3.0
    assert difference(colours(drawn), colours(again)) > 6.0


def test_a_film_ahead_draws_anew_where_the_eye_has_turned() -> None:
    start, aside = Pose(6.0, 0.3, 0.0), Pose(6.0, 0.3, 0.1)
    places = places_drawn([start, start, aside], panorama=False)
    assert places == [(start, [0, 0]), (aside, [0])]


@pytest.fixture(scope="module")
def corridor_artist(scenes: dict[str, Scene]) -> Iterator[Artist]:
    """Who draws the corridor all round, 512 pixels wide."""
    settings = WalkthroughSettings(size=(512, 256), panorama=True)
    artist = Artist(scenes["corridor"].site, settings)
    yield artist
    artist.close()


def difference(one: np.ndarray, other: np.ndarray) -> float:
    """Return the mean difference of two pictures' colours, of 255."""
    return float(np.abs(one.astype(float) - other).mean())


def colours(planes: np.ndarray) -> np.ndarray:
    frame = video_frame(planes).reformat(
        format="rgb24", src_colorspace=BT709, src_color_range=LIMITED_RANGE
    )
    return frame.to_ndarray()


@pytest.mark.proof
def test_a_film_that_is_broken_off_leaves_the_old_one_alone(
    scenes: dict[str, Scene], tmp_path: Path
) -> None:
    def interrupt(done: int, count: int) -> None:
        assert len(list(tmp_path.iterdir())) == 2
        assert (done, count) == (1, 5)
        raise KeyboardInterrupt

    scene = scenes["corridor"]
    settings = WalkthroughSettings(size=(64, 48), fps=1, speed=4)
    path = tmp_path / "a.mp4"
    path.write_bytes(b"as it was")
    with pytest.raises(KeyboardInterrupt):
        film_walkthrough(scene, scene.site.routes[0], path, settings, told=interrupt)
    assert list(tmp_path.iterdir()) == [path]
    assert path.read_bytes() == b"as it was"


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"size": (9000, 48)}, "16 to 4096"),
        ({"fps": "20"}, r"fps: expected a number from 1 to 120, got .20."),
        ({"fps": 0}, "fps: expected a number from 1 to 120"),
        ({"height": 5}, "height: expected a number from"),
    ],
)
def test_settings_without_meaning_are_refused(
    settings: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        WalkthroughSettings(**settings)
