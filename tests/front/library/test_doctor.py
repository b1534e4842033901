import sys

import pytest

from memorymaze.front.cli.main import run_command_line
from memorymaze.front.library.doctor import EXTRAS, examine


def test_every_extra_of_the_project_is_looked_for() -> None:
    import tomllib
    from pathlib import Path

    project = tomllib.loads(
        (Path(__file__).parents[3] / "pyproject.toml").read_text(encoding="utf-8")
    )
    known = project["project"]["optional-dependencies"]
    assert {extra for extra, *_ in EXTRAS} == set(known)


def test_what_is_missing_comes_with_what_to_type(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "wordcloud", None)
    assert run_command_line(["doctor"]) == 0
    said = capsys.readouterr().out
    assert "missing  extra analysis" in said
    assert "-m pip install" in said
    assert "works    Python: 3." in said


def test_graphics_that_are_switched_off_are_told_and_not_raised(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "disable")
    [graphics] = [check for check in examine() if check.what == "graphics"]
    assert not graphics.works
    assert "MUJOCO_GL=disable" in graphics.found
