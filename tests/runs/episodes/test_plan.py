from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.basics.errors import MemoryMazeError, SettingsError
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.budgets import time_budget_for
from memorymaze.runs.episodes.plan import RunPlan, plan_run, settings_for
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.texts.corpus import Corpus, load_corpus

Plan = Callable[..., RunPlan]


def test_a_plan_has_the_sites_of_its_instructions_and_no_others(
    tiny_plan: Plan,
) -> None:
    plan = tiny_plan("stop")
    assert len(plan.episodes) == plan.settings.episodes == 12
    assert set(plan.sites) == {"corridor", "loop", "t_junction"}
    assert [stamp.name for stamp in plan.settings.sites] == list(plan.sites)


def test_the_time_budget_is_that_of_these_sites_unless_it_is_given(
    tiny_plan: Plan,
) -> None:
    plan = tiny_plan("stop")
    routes = [route for site in plan.sites.values() for route in site.routes]
    budget = time_budget_for(frozenset(), routes, SimulationSettings())
    assert plan.settings.simulation.time_budget == budget
    assert tiny_plan("stop", time_budget=7.5).settings.simulation.time_budget == 7.5


def test_a_time_budget_and_what_it_is_worked_out_from_are_not_given_both(
    tiny_corpus: Corpus, tiny_plan: Plan
) -> None:
    with pytest.raises(SettingsError, match=r"got longest and time_budget 7\.5; leave"):
        tiny_plan("stop", time_budget=7.5, budget_by="longest")
    # As `memorymaze settings --of RUN` writes them.
    tiny_plan("stop", time_budget="7.5", budget_by="way")
    # That of the texts nobody gave.
    of_texts = replace(tiny_corpus, time_budget=7.5)
    plan_run("stop", of_texts, replace(settings_for(of_texts), budget_by="longest"))


def test_nothing_is_planned_for_an_agent_that_does_not_exist(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="expected one of"):
        plan_run(AgentSettings("nobody"), settings=RunSettings(limit=1))


def test_looks_that_are_no_file_are_refused_though_the_agent_takes_no_pictures(
    tiny_plan: Plan,
) -> None:
    with pytest.raises(SettingsError, match=r"nowhere\.glb.*no file here"):
        tiny_plan("stop", looks="nowhere.glb")


def test_the_shipped_instructions_need_the_shipped_sites(
    tiny_sites_folder: Path,
) -> None:
    with pytest.raises(
        MemoryMazeError, match="name the instructions of your buildings"
    ):
        plan_run(AgentSettings("stop"), load_corpus(sites=tiny_sites_folder))
