from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]
SMALL = ("--size", "64x48", "--fps", "1", "--speed", "10")


def test_the_film_of_a_route_is_where_it_says(
    memorymaze: Memorymaze,
    tiny_sites_folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    said = memorymaze(
        "sites", "film", tiny_sites_folder / "corridor.geojson", "R1", *SMALL
    )
    assert said.code == 0, said.err
    assert said.out == "walkthrough-corridor-R1.mp4: 2 s, 2 frames\n"
    assert [each.name for each in tmp_path.iterdir()] == ["walkthrough-corridor-R1.mp4"]
    assert b"ftyp" in (tmp_path / "walkthrough-corridor-R1.mp4").read_bytes()[:16]


def test_a_building_that_no_camera_draws_is_refused_before_the_film_begins(
    memorymaze: Memorymaze,
    changed: Callable[..., Path],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    path = changed("loop", "south_way", {"properties.floor_material": "marble"})
    monkeypatch.chdir(path.parent)
    monkeypatch.setattr("memorymaze.runs.films.walkthrough.write_video", pytest.fail)
    said = memorymaze("sites", "film", path, "R1", *SMALL)
    assert said.code == 1
    assert said.err.startswith(f"memorymaze: {path}: south_way: known-word: ")
    assert [each.name for each in path.parent.iterdir()] == [path.name]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        pytest.param(["universty", "R1"], "did you mean 'university'?", id="site"),
        pytest.param(["university", "R9"], "route: expected one of R1", id="route"),
        pytest.param(["university", "R1", "--size", "big"], "WIDTHxHEIGHT", id="size"),
        pytest.param(["university", "R1", "--size", "65x48"], "even", id="odd size"),
        pytest.param(
            ["university", "R1", "--panorama", "--size", "640x480"],
            "twice as wide",
            id="panorama",
        ),
        pytest.param(["university", "R1", "--fps", "x"], "--fps", id="no number"),
        pytest.param(
            ["university", "R1", "--fps", "nan"],
            "fps: expected a number from",
            id="nan",
        ),
        pytest.param(
            ["university", "R1", "--speed", "0"],
            "speed: expected a number from",
            id="speed",
        ),
        pytest.param(["university", "R1", "--out", "a.avi"], "*.mp4", id="kind"),
        pytest.param(["university", "R1", "--out", "x/a.mp4"], "make ", id="folder"),
    ],
)
def test_wrong_input_gives_one_message_and_no_file(
    memorymaze: Memorymaze,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = memorymaze("sites", "film", *arguments)
    assert (done.code, done.out) == (2, "")
    assert said in done.err
    assert "Traceback" not in done.err
    assert not any(tmp_path.iterdir())
