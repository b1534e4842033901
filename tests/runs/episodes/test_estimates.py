"""What is said of a run's cost before it begins."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.spending import TokenPrice
from memorymaze.runs.episodes.estimates import answers_estimate, cost_estimate
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.texts.corpus import load_corpus

TINY_INSTRUCTIONS = Path(__file__).parents[2] / "tiny_instructions.jsonl"
ASKING = AgentSettings(
    "code_generation",
    language_model=ModelSettings(
        model="m", base_url="http://localhost:9/v1", price=TokenPrice(1.0, 10.0)
    ),
)


UNPRICED = replace(ASKING.language_model, price=None)


@pytest.fixture
def plan(tiny_sites_folder: Path) -> Callable[[AgentSettings], RunPlan]:
    """Plan four episodes of an agent."""

    def four(agent: AgentSettings) -> RunPlan:
        return plan_run(
            agent,
            load_corpus([TINY_INSTRUCTIONS], sites=tiny_sites_folder),
            RunSettings(limit=4),
        )

    return four


def test_code_generation_is_estimated_by_its_own_requests(
    plan: Callable[[AgentSettings], RunPlan],
) -> None:
    said = str(cost_estimate(plan(ASKING)))
    assert "an ESTIMATE for 8 requests of the whole run, answers kept included" in said
    # 8 replies of 1000 tokens at 10 dollars a million are 0.08; the rest is read.
    assert "about 0.11 USD" in said
    assert "0.35 USD if every reply is as long as it may be" in said
    alone = str(cost_estimate(plan(replace(ASKING, options=(("parser", "false"),)))))
    assert "4 requests" in alone


def test_a_limit_is_said_and_for_agents_that_go_step_by_step_asked_for(
    plan: Callable[[AgentSettings], RunPlan],
) -> None:
    limited = replace(ASKING.language_model, max_cost=0.5)
    said = str(cost_estimate(plan(replace(ASKING, language_model=limited))))
    assert said.endswith("the run ends when 0.5 USD are spent")
    said = str(cost_estimate(plan(replace(ASKING, name="navgpt"))))
    assert "cannot be told beforehand" in said
    assert "set --max-cost" in said


def test_nothing_is_said_without_prices(
    plan: Callable[[AgentSettings], RunPlan],
) -> None:
    assert cost_estimate(plan(replace(ASKING, language_model=UNPRICED))) is None
    assert cost_estimate(plan(AgentSettings("stop"))) is None


def test_a_run_tells_how_often_it_will_ask() -> None:
    twelve = RunSettings(limit=12)
    plan = plan_run(AgentSettings("stop"), settings=twelve)
    assert answers_estimate(plan) is None

    def asked(name: str = "navid", **options: str) -> tuple[int, int]:
        agent = AgentSettings(
            name, options=tuple(options.items()), language_model=UNPRICED
        )
        line = answers_estimate(plan_run(agent, settings=twelve))
        assert line is not None
        assert "in the whole run, answers kept included" in line
        numbers = [int(word) for word in line.split() if word.isdigit()]
        return numbers[0], numbers[1]

    fewest, most = asked()
    metres = sum(
        plan
        .sites[each.instruction.site]
        .find_route(each.instruction.reference_route)
        .length
        for each in plan.episodes
    )
    assert metres / 0.75 < fewest < most
    assert asked(budget="released") == (fewest, 12 * 400)
    # No route can be walked in 50 steps, so the budget ends every walk.
    assert asked(max_steps="50") == (12 * 50, 12 * 50)
    # It may go 3 m at a time, and has two requests for each 2.25 m.
    fewest, most = asked("see_and_go")
    assert metres / 3 < fewest < most / 2
    assert asked("see_and_go", requests="9") == (12 * 9, 12 * 9)
