from pathlib import Path

import pytest

from memorymaze.evaluation.agent_files import agent_files, agent_fingerprint


def write(folder: Path, files: dict[str, str]) -> str:
    """Write modules; return the name of the agent in `guide.py`."""
    for name, text in files.items():
        path = folder / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return f"{folder}/guide.py:Guide"


def test_what_an_agent_imports_from_beside_it_belongs_to_it(tmp_path: Path) -> None:
    agent = write(
        tmp_path,
        {
            "guide": "import json, maps\ndef f(): import parts.legs",
            "maps": "from paper import FOLDS\nimport guide",
            "paper": "FOLDS = 3",
            "parts/legs": "from . import feet\nfrom ..maps import Map",
            "parts/feet": "",
            "parts/arms": "",
            "unrelated": "",
        },
    )
    names = ["guide.py", "maps.py", "parts/legs.py", "paper.py", "parts/feet.py"]
    assert list(agent_files(agent)) == names


def test_packages_are_followed_from_their_own_modules(tmp_path: Path) -> None:
    agent = write(
        tmp_path,
        {
            "guide": "import maps",
            "maps/__init__": "from .ink import x",
            "maps/ink": "x = 1",
        },
    )
    names = ["guide.py", "maps/__init__.py", "maps/ink.py"]
    assert list(agent_files(agent)) == names


def test_modules_are_found_where_python_finds_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    write(tmp_path, {"lost_guides/one": "import lost_paths", "lost_paths": ""})
    found = agent_files("lost_guides.one:Guide")
    assert list(found) == ["lost_guides/one.py", "lost_paths.py"]


def test_installed_agents_and_those_that_come_along_have_no_files_beside_them() -> None:
    assert list(agent_files("numpy.linalg:norm")) == ["__init__.py"]
    assert agent_files("rules") == {}


def test_a_file_that_is_no_python_is_an_agents_own_all_the_same(tmp_path: Path) -> None:
    agent = write(tmp_path, {"guide": "import broken", "broken": "def ("})
    assert list(agent_files(agent)) == ["guide.py", "broken.py"]


def test_an_edit_beside_an_agent_changes_its_fingerprint(tmp_path: Path) -> None:
    agent = write(tmp_path, {"guide": "import maps", "maps": "x = 1", "unrelated": ""})
    before = agent_fingerprint(agent)
    write(tmp_path, {"unrelated": "x = 2"})
    assert agent_fingerprint(agent) == before
    write(tmp_path, {"maps": "x = 2"})
    after = agent_fingerprint(agent)
    assert [each for each in after if after[each] != before[each]] == ["maps.py"]
