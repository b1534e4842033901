"""Videos that are made while the pages of their study are served."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Event
from typing import Any

import httpx2
import pytest

from memorymaze.basics.errors import MemoryMazeError, SettingsError, StudyError
from memorymaze.web.studies import films as making
from memorymaze.web.studies.films import Films
from memorymaze.web.studies.serving import Addresses, serving_study
from memorymaze.web.studies.store import Store, open_store
from memorymaze.web.studies.study_file import Study, load_study

from .conftest import Visitor

MakeStudy = Callable[..., Study]
QUICK = ("fps = 1", "width = 320", "speed = 20")


def wait_until(holds: Callable[[], object], seconds: float = 240) -> None:
    latest = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < latest
        Event().wait(0.02)


@contextmanager
def served(study: Study) -> Iterator[tuple[Store, Addresses]]:
    with (
        open_store(study) as store,
        serving_study(store, Films(study)) as addresses,
    ):
        yield store, addresses


def overview(addresses: Addresses) -> str:
    """What the experimenter reads first."""
    with httpx2.Client(follow_redirects=True) as client:
        answer = client.get(addresses.experimenter)
    return answer.text


@pytest.mark.proof
def test_videos_are_made_once_and_kept_beside_the_study(
    make_study: MakeStudy, capsys: pytest.CaptureFixture[str]
) -> None:
    study = make_study("online", *QUICK)
    films = Films(study)
    assert sorted(films.paths) == ["R1", "R2"]
    with films.being_made():
        wait_until(lambda: all(films.ready(route) for route in films.paths))
    said = capsys.readouterr().err
    assert "making the video of R1 (1 of 2), once" in said
    assert "frame" in said
    made = {path: path.stat().st_mtime_ns for path in films.paths.values()}
    assert {path.parent for path in made} == {study.path.with_suffix(".films")}
    again = Films(study)
    with again.being_made():
        assert again.state("R1").state == "ready"
    assert {path: path.stat().st_mtime_ns for path in made} == made
    assert capsys.readouterr().err == ""
    slower = make_study("online", "fps = 1", "width = 320", "speed = 10")
    assert not set(Films(slower).paths.values()) & set(made)


def test_who_comes_before_the_video_waits_for_it(
    make_study: MakeStudy, film: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    half, go = Event(), Event()

    def make(*arguments: Any, told: Callable[[int, int], None], **_: Any) -> None:
        told(2, 4)
        half.set()
        assert go.wait(60)
        told(4, 4)
        arguments[2].write_bytes(film.read_bytes())

    monkeypatch.setattr(making, "film_walkthrough", make)
    with served(make_study("memory")) as (store, addresses):
        assert half.wait(60)
        page = overview(addresses)
        assert "R1: being made, 50 %, less than a minute left" in page
        assert "R2: waiting, less than a minute left" in page

        early = Visitor(addresses.participants)
        with early.client:
            early.reach_first_way()
            assert "The video is being made" in early.page
            assert "Time left: less than a minute" in early.page
            route = early.page.partition('data-film="/film/')[2].partition("/")[0]
            state = early.client.get(f"/film/{route}/state")
            assert state.json() == {"ready": False, "left": "less than a minute"}
            assert early.client.get(f"/film/{route}").status_code == 503
            [who] = store.participants()
            assert not store.events(who.id, f"watch.{route}")

            go.set()
            ready = f"/film/{route}/state"
            wait_until(lambda: early.client.get(ready).json()["ready"])
            assert f'<video src="/film/{route}"' in early.get("/study")
            assert early.client.get(f"/film/{route}").status_code == 200
            assert [each.kind for each in store.events(who.id, f"watch.{route}")] == [
                "opened"
            ]
        wait_until(lambda: "R2: ready" in overview(addresses))


def test_a_video_that_cannot_be_made_is_told_to_the_experimenter(
    make_study: MakeStudy,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def fail(*_: Any, **__: Any) -> None:
        raise MemoryMazeError("expected a way that can be driven")

    monkeypatch.setattr(making, "film_walkthrough", fail)
    with served(make_study("memory")) as (_, addresses):
        why = "</strong>: expected a way that can be driven"
        wait_until(lambda: why in overview(addresses))
        early = Visitor(addresses.participants)
        with early.client:
            early.reach_first_way()
            assert "The video is being made" in early.page
            assert "Time left" not in early.page
    assert "cannot be made: expected a way" in capsys.readouterr().err


def test_a_server_that_ends_breaks_its_videos_off(
    make_study: MakeStudy, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, broken_off = Event(), Event()

    def film_for_ever(*_: Any, told: Callable[[int, int], None], **__: Any) -> None:
        try:
            while True:
                told(1, 1000)
                begun.set()
        finally:
            broken_off.set()

    monkeypatch.setattr(making, "film_walkthrough", film_for_ever)
    films = Films(make_study("online"))
    with films.being_made():
        assert begun.wait(60)
    assert broken_off.is_set()
    assert films.ready("R1") is None
    assert films.state("R1").problem == ""


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
    films = Films(load_study(study.path))
    assert films.ready("R2") == study.path.parent / "R2.mp4"
    assert not study.path.with_suffix(".films").exists()


def test_a_video_that_is_not_there_is_named(make_study: MakeStudy) -> None:
    study = make_study()
    text = study.text.replace('route = "R1"\n', 'route = "R1"\nvideo = "none.mp4"\n')
    study.path.write_text(text, encoding="utf-8")
    with pytest.raises(StudyError, match=r"expected a video file.*'none.mp4'"):
        load_study(study.path)


def test_a_video_that_has_to_be_made_needs_the_extra_for_videos(
    make_study: MakeStudy, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(SettingsError, match=r"videos: the package av .*\[video\]"):
        Films(make_study("online"))
