from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.errors import StudyError
from memorymaze.studies.films import make_films
from memorymaze.studies.study_file import Study, load_study

MakeStudy = Callable[..., Study]
QUICK = ("fps = 1", "width = 320", "speed = 20")


def test_videos_are_made_once_and_kept_beside_the_study(
    make_study: MakeStudy, capsys: pytest.CaptureFixture[str]
) -> None:
    study = make_study("online", *QUICK)
    films = make_films(study)
    assert sorted(films) == ["R1", "R2"]
    assert {path.parent for path in films.values()} == {
        study.path.with_suffix(".films")
    }
    assert "making the video of R1 (1 of 2), once" in capsys.readouterr().err
    made = {path: path.stat().st_mtime_ns for path in films.values()}
    assert make_films(study) == films
    assert {path: path.stat().st_mtime_ns for path in made} == made
    assert capsys.readouterr().err == ""
    slower = make_study("online", "fps = 1", "width = 320", "speed = 10")
    assert not set(make_films(slower).values()) & set(made)


def test_a_video_of_ones_own_is_shown_instead(
    make_study: MakeStudy, film: Path
) -> None:
    study = make_study("online", *QUICK)
    text = study.text
    for route in ("R1", "R2"):
        (study.path.parent / f"{route}.mp4").write_bytes(film.read_bytes())
        text = text.replace(
            f'route = "{route}"\n', f'route = "{route}"\nvideo = "{route}.mp4"\n'
        )
    study.path.write_text(text, encoding="utf-8")
    films = make_films(load_study(study.path))
    assert films["R2"] == study.path.parent / "R2.mp4"
    assert not study.path.with_suffix(".films").exists()


def test_a_video_that_is_not_there_is_named(make_study: MakeStudy) -> None:
    study = make_study()
    text = study.text.replace('route = "R1"\n', 'route = "R1"\nvideo = "none.mp4"\n')
    study.path.write_text(text, encoding="utf-8")
    with pytest.raises(StudyError, match=r"expected a video file.*'none.mp4'"):
        load_study(study.path)
