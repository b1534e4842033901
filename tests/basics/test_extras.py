import re
import shlex
import sys
import tomllib
from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.extras import command_here, how_to_install, require_extra

NAMED = re.compile(
    r"""(?:memorymaze\[|require_extra\(\s*"|how_to_install\(')([a-z,-]+)"""
)
PROJECT = Path(__file__).parents[2]


def test_what_is_installed_is_not_asked_for() -> None:
    require_extra("ray", "json", "numpy", purpose="--ray")


def test_what_is_missing_is_named_with_what_to_type(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(SettingsError) as caught:
        require_extra("ray", "json", "ray", purpose="--ray", otherwise="do without")
    said = str(caught.value)
    assert said.startswith("--ray: the package ray is not installed; type: ")
    assert said.endswith(", or do without")


def test_what_to_type_installs_into_this_environment_from_this_checkout() -> None:
    typed = shlex.split(how_to_install("ray"))
    assert typed[:4] == [sys.executable, "-m", "pip", "install"]
    assert typed[-1] == f"{PROJECT}[ray]"
    assert Path(typed[typed.index("--constraint") + 1]).is_file()


def test_a_command_in_a_hint_is_found_without_activating_the_environment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    assert command_here() == "memorymaze"  # not installed as a command: python -m
    installed = tmp_path / "memorymaze"
    installed.touch(mode=0o755)
    monkeypatch.setenv("PATH", "/nowhere")
    assert command_here() == str(installed)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert command_here() == "memorymaze"


def test_every_extra_that_the_code_names_is_one_of_the_project() -> None:
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))
    known = set(project["project"]["optional-dependencies"])
    named = {
        extra
        for file in (PROJECT / "src").rglob("*.py")
        for match in NAMED.findall(file.read_text(encoding="utf-8"))
        for extra in match.split(",")
    }
    assert named
    assert named <= known
