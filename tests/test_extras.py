import re
import sys
import tomllib
from pathlib import Path

import pytest

from memorymaze.errors import SettingsError
from memorymaze.extras import require_extra

NAMED = re.compile(
    r"""(?:memorymaze\[|require_extra\(\s*"|how_to_install\(')([a-z-]+)"""
)
PROJECT = Path(__file__).parents[1]


def test_what_is_installed_is_not_asked_for() -> None:
    require_extra("video", "json", "numpy", purpose="videos")


def test_what_is_missing_is_named_with_what_to_type(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(SettingsError) as caught:
        require_extra("video", "json", "av", purpose="videos", otherwise="do without")
    assert str(caught.value) == (
        "videos: the package av is not installed; type: "
        "pip install 'memorymaze[video]', or do without"
    )


def test_every_extra_that_the_code_names_is_one_of_the_project() -> None:
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))
    known = set(project["project"]["optional-dependencies"])
    named = {
        match
        for file in (PROJECT / "src").rglob("*.py")
        for match in NAMED.findall(file.read_text(encoding="utf-8"))
    }
    assert named
    assert named <= known
