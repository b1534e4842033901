from pathlib import Path

import pytest

from memorymaze.errors import SettingsError
from memorymaze.evaluation.eyes import looks_of_run
from memorymaze.evaluation.settings import RunSettings


def test_runs_without_cameras_do_not_depend_on_looks() -> None:
    assert looks_of_run(frozenset(), RunSettings()) is None
    assert looks_of_run(frozenset({"answers"}), RunSettings()) is None


def test_runs_with_cameras_say_what_these_show() -> None:
    assert looks_of_run(frozenset({"camera"}), RunSettings()) == "own"
    assert looks_of_run(frozenset(), RunSettings(signs="ocr")) == "own"


def test_looks_that_are_not_there_are_refused_before_the_run(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("MEMORYMAZE_LOOKS", "sweethome3d")
    with pytest.raises(SettingsError, match="memorymaze sites models"):
        looks_of_run(frozenset({"camera"}), RunSettings())
