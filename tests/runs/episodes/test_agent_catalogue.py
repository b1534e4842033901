import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from memorymaze.agents.agent import Agent
from memorymaze.agents.stop import StopAgent
from memorymaze.basics.errors import SettingsError
from memorymaze.basics.options import options_of
from memorymaze.front.cli.agents import agent_listing
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.agent_catalogue import AGENTS, agent_names, choose_agent
from memorymaze.runs.episodes.settings import AgentSettings

OWN_AGENT = """
from dataclasses import dataclass

@dataclass
class Mine:
    name: str = "mine"

    def follow(self, instruction, robot, journal, rng):
        robot.stop()

class Empty:
    pass

class Demanding:
    def __init__(self, wish):
        pass

class Plain:
    name = "plain"

    def follow(self, instruction, robot, journal, rng):
        robot.stop()

class Numbered(Plain):
    name = 5

class TwoLined(Plain):
    name = "one\\ntwo"

class Faceless(Plain):
    @property
    def name(self):
        raise RuntimeError("no name")

class Deaf(Plain):
    def follow(self, instruction, robot):
        pass

@dataclass
class Strides:
    stride: float = 0.5
    "Metres per step."

class Optional(Plain):
    Options = Strides

    def __init__(self, options):
        self.name = f"strides of {options.stride}"

class Wrong(Plain):
    Options = 3

class Asker(Plain):
    needs = {"language_model"}

    def __init__(self, model):
        self.name = f"asks {model.name}"

class Modelless(Plain):
    needs = {"language_model"}

@dataclass
class Ways:
    ask: bool = False
    "Whether it asks."

    @property
    def needs(self):
        return {"language_model"} if self.ask else set()

class Sometimes(Plain):
    Options = Ways

    def __init__(self, options, model=None):
        self.name = "asks" if model else "asks nobody"

class Leaving:
    def __init__(self):
        raise SystemExit("not today")
"""


@pytest.fixture
def own_agents(tmp_path: Path) -> Path:
    """A file with agents of a user's own."""
    path = tmp_path / "own_agents.py"
    path.write_text(OWN_AGENT, encoding="utf-8")
    return path


def made(name: str, *options: tuple[str, str]) -> Agent:
    return choose_agent(AgentSettings(name, options=options)).make().agent


def test_all_names_are_known_and_the_oracle_is_one_of_them() -> None:
    assert {"guide", "explorer", "code_generation", "oracle"} <= set(agent_names())


@pytest.mark.parametrize("name", agent_names())
def test_every_agent_says_what_it_is_and_what_its_options_mean(name: str) -> None:
    listing = agent_listing([name])
    options = choose_agent(name).recipe.options
    assert listing.startswith(f"{name}: {AGENTS[name].summary}")
    assert listing.count("--set ") == (len(options_of(options)) if options else 0)


def test_a_misspelt_agent_has_no_listing() -> None:
    with pytest.raises(SettingsError, match="did you mean 'stop'"):
        agent_listing(["stopp"])


def test_an_agent_of_ones_own_is_made_from_its_file(own_agents: Path) -> None:
    assert made(f"{own_agents}:Mine").name == "mine"


def test_an_agent_of_ones_own_is_made_from_its_module() -> None:
    assert made("memorymaze.agents.stop:StopAgent").name == "stop"


@pytest.mark.parametrize(
    ("name", "said"),
    [
        pytest.param("stops", "did you mean 'stop'", id="misspelt"),
        pytest.param("no_such_module:X", "ModuleNotFoundError", id="module"),
        pytest.param("none.py:X", "no such file: none.py", id="file"),
        pytest.param("{file}:Theirs", "nothing of this name", id="class"),
        pytest.param("{file}:Empty", "with `name` and `follow", id="no agent"),
        pytest.param("{file}:Demanding", "without arguments", id="arguments"),
        pytest.param("{file}:Numbered", "one line of text, got 5", id="number"),
        pytest.param("{file}:TwoLined", "one line of text", id="two lines"),
        pytest.param("{file}:Faceless", "no name", id="no name"),
        pytest.param("{file}:Deaf", r"got follow\(instruction, robot\)", id="deaf"),
        pytest.param("{file}:Leaving", "SystemExit: not today", id="leaves"),
    ],
)
def test_an_agent_that_cannot_be_made_is_explained(
    own_agents: Path, name: str, said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        made(name.format(file=own_agents))


@pytest.mark.parametrize(
    ("content", "said"),
    [
        pytest.param("import sys\nsys.exit('bye')", "SystemExit: bye", id="exit"),
        pytest.param("\n1 / 0", r"zero \(broken\.py, line 2\)", id="failure"),
        pytest.param("class A", r"\(broken\.py, line 1\)", id="syntax"),
    ],
)
def test_a_file_that_fails_is_explained_by_its_line(
    tmp_path: Path, content: str, said: str
) -> None:
    path = tmp_path / "broken.py"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(SettingsError, match=said):
        made(f"{path}:A")


def test_a_file_hides_no_library_and_sees_what_lies_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    (tmp_path / "beside_it.py").write_text("NAME = 'with friends'\n", encoding="utf-8")
    (tmp_path / "json.py").write_text(
        "import beside_it\n"
        "from memorymaze.agents.stop import StopAgent\n"
        "class Mine(StopAgent):\n"
        "    name = beside_it.NAME\n",
        encoding="utf-8",
    )
    assert made(f"{tmp_path / 'json.py'}:Mine").name == "with friends"
    assert "JSONDecoder" in dir(sys.modules["json"])


def test_a_module_is_found_in_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [*sys.path])
    monkeypatch.chdir(tmp_path)
    (tmp_path / "found_here.py").write_text(OWN_AGENT, encoding="utf-8")
    assert made("found_here:Mine").name == "mine"


@pytest.mark.parametrize("option", ["model", "base_url", "record", "replay"])
def test_a_language_model_for_an_agent_without_one_is_refused(option: str) -> None:
    model = ModelSettings(**{option: "x"})
    with pytest.raises(SettingsError, match="asks no language model"):
        choose_agent("stop", model).refuse_unused_model()


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        pytest.param("stop", [("at", "once")], "'stop' has no options", id="none"),
        pytest.param("code_generation", [("sed", "1")], "'seed'", id="misspelt"),
        pytest.param("{file}:Mine", [("at", "once")], "`Options`", id="own without"),
        pytest.param("{file}:Optional", [("stride", "x")], "a number", id="own value"),
        pytest.param("{file}:Wrong", [], "to be a dataclass, got 3", id="own wrong"),
    ],
)
def test_options_that_an_agent_does_not_have_are_refused(
    own_agents: Path, name: str, options: list[tuple[str, str]], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        made(name.format(file=own_agents), *options)


def test_an_agent_of_ones_own_is_made_from_its_options(own_agents: Path) -> None:
    name = f"{own_agents}:Optional"
    assert made(name).name == "strides of 0.5"
    assert made(name, ("stride", "2")).name == "strides of 2.0"
    assert "--set stride=0.5\n        Metres per step." in agent_listing([name])


class Picky:
    name = "picky"

    def __init__(self, model: object) -> None:
        self.model = model


def test_a_class_that_cannot_be_made_is_refused_with_what_to_do() -> None:
    with pytest.raises(
        SettingsError, match="Picky': cannot be made without argum"
    ) as e:
        choose_agent(Picky).make()  # pyright: ignore[reportArgumentType]
    assert str(e.value).endswith("hand over an object instead")


class Sleeper:
    name = "sleeper"

    async def follow(self, *_: object) -> None:
        raise AssertionError("is never run")


class Yielder:
    name = "yielder"

    def follow(self, *_: object) -> Iterator[None]:
        yield None


@pytest.mark.parametrize("agent", [Sleeper(), Yielder()])
def test_a_follow_of_which_nothing_would_run_is_refused(agent: Any) -> None:
    with pytest.raises(SettingsError, match="async or yield"):
        choose_agent(agent).make()


def test_the_name_of_a_model_is_no_settings_of_one() -> None:
    with pytest.raises(SettingsError, match=r"expected ModelSettings\(model=…\), got"):
        choose_agent("navgpt", "gpt-4o-mini")  # pyright: ignore[reportArgumentType]


MODEL = ModelSettings(model="m", base_url="http://127.0.0.1:9/v1")


def test_an_agent_of_ones_own_that_needs_a_language_model_is_made_with_it(
    own_agents: Path,
) -> None:
    asker = choose_agent(f"{own_agents}:Asker", MODEL)
    asker.refuse_unused_model()
    assert asker.make().agent.name == "asks m"
    with pytest.raises(SettingsError, match="name a language model with --model"):
        choose_agent(f"{own_agents}:Asker").make()
    with pytest.raises(SettingsError, match="model=, as it needs a language model"):
        choose_agent(f"{own_agents}:Modelless", MODEL).make()


def test_options_of_ones_own_can_add_to_what_an_agent_needs(own_agents: Path) -> None:
    settings = AgentSettings(f"{own_agents}:Sometimes", options=(("ask", "true"),))
    assert choose_agent(settings, MODEL).make().agent.name == "asks"
    never = choose_agent(f"{own_agents}:Sometimes", MODEL)
    assert never.make().agent.name == "asks nobody"
    with pytest.raises(SettingsError, match="asks no language model of the run"):
        never.refuse_unused_model()


def test_an_agent_that_is_an_object_has_its_model_and_no_other() -> None:
    class Asking(StopAgent):
        needs = frozenset({"language_model"})

    assert choose_agent(Asking()).make().model is None
    with pytest.raises(SettingsError, match="an object; hand over its class"):
        choose_agent(Asking(), MODEL).refuse_unused_model()


def test_a_language_model_is_named_once() -> None:
    settings = AgentSettings("code_generation", language_model=MODEL)
    with pytest.raises(SettingsError, match="name one too; leave one out"):
        choose_agent(settings, MODEL)
