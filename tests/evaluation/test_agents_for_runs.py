from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.agents import AGENTS
from memorymaze.errors import SettingsError
from memorymaze.evaluation.agents_for_runs import agent_names, build_agent
from memorymaze.evaluation.oracle import OracleAgent
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.settings import AgentSettings

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
"""


@pytest.fixture
def own_agents(tmp_path: Path) -> Path:
    """A file with agents of a user's own."""
    path = tmp_path / "own_agents.py"
    path.write_text(OWN_AGENT, encoding="utf-8")
    return path


def test_all_names_are_known_and_the_oracle_is_one_of_them() -> None:
    assert set(agent_names()) == {*AGENTS, "code_generation", "oracle"}


def test_the_oracle_is_made_for_its_episode(tiny_plan: Callable[..., RunPlan]) -> None:
    episode = tiny_plan("stop").episodes[0]
    assert isinstance(build_agent(AgentSettings("oracle"))(episode), OracleAgent)


def test_an_agent_of_ones_own_is_made_from_its_file(
    own_agents: Path, tiny_plan: Callable[..., RunPlan]
) -> None:
    episode = tiny_plan("stop").episodes[0]
    agent_for = build_agent(AgentSettings(f"{own_agents}:Mine"))
    assert agent_for(episode).name == "mine"
    assert agent_for(episode) is agent_for(episode)


def test_an_agent_of_ones_own_is_made_from_its_module(
    tiny_plan: Callable[..., RunPlan],
) -> None:
    agent_for = build_agent(AgentSettings("memorymaze.agents.stop:StopAgent"))
    assert agent_for(tiny_plan("stop").episodes[0]).name == "stop"


@pytest.mark.parametrize(
    ("name", "said"),
    [
        pytest.param("stops", "did you mean 'stop'", id="misspelt"),
        pytest.param("no_such_module:X", "ModuleNotFoundError", id="module"),
        pytest.param("none.py:X", "no such file: none.py", id="file"),
        pytest.param("{file}:Theirs", "nothing of this name", id="class"),
        pytest.param("{file}:Empty", "with `name` and `follow", id="no agent"),
        pytest.param("{file}:Demanding", "without arguments", id="arguments"),
    ],
)
def test_an_agent_that_cannot_be_made_is_explained(
    own_agents: Path, name: str, said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        build_agent(AgentSettings(name.format(file=own_agents)))


@pytest.mark.parametrize("option", ["model", "base_url", "record", "replay"])
def test_a_language_model_for_an_agent_without_one_is_refused(option: str) -> None:
    with pytest.raises(SettingsError, match="asks no language model"):
        build_agent(AgentSettings("stop", **{option: "x"}))


def test_a_parser_for_an_agent_without_one_is_refused() -> None:
    with pytest.raises(SettingsError, match="no parser to leave out"):
        build_agent(AgentSettings("stop", parser=False))
