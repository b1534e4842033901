import inspect
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.input_files import FileStamp
from memorymaze.basics.own_code import own_files, own_fingerprint
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.settings import RunDefinition, differences
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder


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
    assert list(own_files(agent)) == names


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
    assert list(own_files(agent)) == names


def test_modules_are_found_where_python_finds_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    write(tmp_path, {"lost_guides/one": "import lost_paths", "lost_paths": ""})
    found = own_files("lost_guides.one:Guide")
    assert list(found) == ["lost_guides/one.py", "lost_paths.py"]


def test_installed_agents_and_those_that_come_along_have_no_files_beside_them() -> None:
    assert list(own_files("numpy.linalg:norm")) == ["__init__.py"]
    assert own_files("guide") == {}
    assert own_files("memorymaze.agents.guide.agent:GuideAgent") == {}


def test_a_file_that_is_no_python_is_an_agents_own_all_the_same(tmp_path: Path) -> None:
    agent = write(tmp_path, {"guide": "import broken", "broken": "def ("})
    assert list(own_files(agent)) == ["guide.py", "broken.py"]


def test_an_edit_beside_an_agent_changes_its_fingerprint(tmp_path: Path) -> None:
    agent = write(tmp_path, {"guide": "import maps", "maps": "x = 1", "unrelated": ""})
    before = own_fingerprint(agent)
    write(tmp_path, {"unrelated": "x = 2"})
    assert own_fingerprint(agent) == before
    write(tmp_path, {"maps": "x = 2"})
    changed = set(before) - set(own_fingerprint(agent))
    assert [stamp.name for stamp in changed] == ["maps.py"]


AGENT = """
from dataclasses import dataclass
from fingerprinted_maps import Map

class Guide:
    name = "guide"

    @dataclass(frozen=True)
    class Options:
        stride: float = 2.0
        \"\"\"Metres.\"\"\"

    def __init__(self, options):
        pass

    def follow(self, instruction, robot, journal, rng):
        pass
"""


def test_a_run_is_not_resumed_with_an_edited_agent(
    tmp_path: Path,
    record: RunRecord,
    tiny_plan: Callable[..., RunPlan],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    agent = write(tmp_path, {"guide": AGENT, "fingerprinted_maps": "class Map: pass"})
    begun = replace(record, settings=tiny_plan(agent).settings)
    assert begun.settings.option_values == (("stride", "2.0"),)
    with open_run_folder(tmp_path / "run", begun, resume=False):
        pass
    write(tmp_path, {"fingerprinted_maps": "class Map: scale = 2"})
    edited = replace(record, settings=tiny_plan(agent).settings)
    with (
        pytest.raises(RunFolderError, match=r"agent\.file fingerprinted_maps\.py: '"),
        open_run_folder(tmp_path / "run", edited, resume=True),
    ):
        pass


def test_an_agent_that_is_handed_over_is_known_by_the_file_of_its_class() -> None:
    class Handed:
        pass

    names = [stamp.name for stamp in own_fingerprint("some:Handed", Handed())]
    assert names[0] == Path(__file__).name


def test_an_agent_from_a_notebook_is_known_by_its_source(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    class Noted:
        pass

    monkeypatch.setattr(Noted, "__module__", "a_notebook")
    monkeypatch.setattr(inspect, "getsource", lambda kind: "class Noted: pass")
    [stamp] = own_fingerprint("a_notebook:Noted", Noted())
    assert stamp.name.startswith("class ")


def test_two_versions_of_an_agent_differ_by_its_files_and_options(
    settings: RunDefinition,
) -> None:
    def with_version(sha: str, stride: str) -> RunDefinition:
        return replace(
            settings,
            agent_files=(FileStamp("guide.py", sha),),
            option_values=(("stride", stride),),
        )

    found = differences(with_version("12", "2"), with_version("34", "3"))
    assert [*map(str, found)] == [
        "agent.file guide.py: '12' there, '34' here",
        "agent.options.stride: '2' there, '3' here",
    ]
