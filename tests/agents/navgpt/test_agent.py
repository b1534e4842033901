from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from memorymaze.agents.agent import FairLimits, Journal
from memorymaze.agents.navgpt import LoopLimits, NavGPTAgent, NavGPTOptions
from memorymaze.agents.navgpt.agent import loop_limits
from memorymaze.basics.errors import EpisodeOver, LanguageModelError, SettingsError
from memorymaze.basics.options import read_options
from memorymaze.language.models.scripted_model import ScriptedLanguageModel

Make = Callable[..., Any]
Go = Callable[[str], str]
FAIR = FairLimits(requests=20, steps={})
ARRIVED = "Thought: There.\nFinal Answer: arrived"


def follow(
    replies: Any, robot: Any, **options: Any
) -> tuple[Journal, ScriptedLanguageModel]:
    model = ScriptedLanguageModel(replies)
    journal = Journal(limits=FAIR)
    chosen = NavGPTOptions(**{"scratchpad": 7000, **options})
    rng = np.random.default_rng(0)
    NavGPTAgent(chosen, model).follow("Go to the end.", robot, journal, rng)
    return journal, model


def ends(
    model: ScriptedLanguageModel, robot: Any, options: NavGPTOptions
) -> tuple[EpisodeOver, Journal]:
    journal = Journal(limits=FAIR)
    agent = NavGPTAgent(options, model)
    with pytest.raises(EpisodeOver) as over:
        agent.follow("", robot, journal, np.random.default_rng(0))
    return over.value, journal


def notes(journal: Journal, kind: str) -> list[dict[str, Any]]:
    return [dict(note.details) for note in journal.notes if note.about == kind]


def shown(model: ScriptedLanguageModel, number: int) -> str:
    return model.requests[number].messages[-1].content


def test_it_goes_where_the_model_says_and_stops_when_it_says_so(
    corridor: Make, go: Go
) -> None:
    robot = corridor()
    journal, _ = follow([*map(go, robot.ids[1:]), ARRIVED], robot)
    assert robot.place == 4
    assert journal.model_calls == 5
    assert [note["end"][0] for note in notes(journal, "move")] == ["1", "2", "3", "4"]
    [counts] = notes(journal, "navgpt")
    assert (counts["requests"], counts["moves"]) == (5, 4)
    assert notes(journal, "thought")[0]["text"] == "I go on."


def test_the_model_sees_where_it_is_in_full_and_where_it_was_in_short(
    corridor: Make, go: Go
) -> None:
    robot = corridor()
    _, model = follow([*map(go, robot.ids[1:3]), ARRIVED], robot)
    assert "Go to the end." in shown(model, 0)
    assert "View 0." in shown(model, 0)
    assert "(none yet)" in shown(model, 0)
    last = shown(model, 2)
    assert last.count("View 0.") == 1, "only here is told in full"
    assert "This is place 0." in last
    assert f"and went from viewpoint {robot.ids[0]} to {robot.ids[1]}" in last
    assert f"You are at viewpoint {robot.ids[2]}" in last


def test_a_teleport_is_refused_told_and_counted(corridor: Make, go: Go) -> None:
    robot = corridor()
    journal, model = follow([go(robot.ids[3]), ARRIVED], robot)
    assert robot.place == 0
    [refused] = notes(journal, "refused_move")
    assert (refused["viewpoint"], refused["why"]) == (robot.ids[3], "not_adjacent")
    told = shown(model, 1)
    assert "You did not move" in told
    assert f"From here you can go to: {robot.ids[1]} (right 0.00, 2.00 m)." in told
    assert notes(journal, "navgpt")[0]["refused_not_adjacent"] == 1


def test_an_unknown_viewpoint_is_refused_told_and_counted(
    corridor: Make, go: Go
) -> None:
    journal, model = follow([go("f" * 32), ARRIVED], corridor())
    assert "There is no such viewpoint." in shown(model, 1)
    assert notes(journal, "navgpt")[0]["refused_unknown"] == 1


def test_a_blocked_way_is_told(corridor: Make, go: Go) -> None:
    robot = corridor(blocked=["1" * 32])
    journal, model = follow([go("1" * 32), ARRIVED], robot)
    assert f"The way to {'1' * 32} is blocked (obstacle). You are back." in shown(
        model, 1
    )
    assert notes(journal, "blocked_move")[0]["distance"] == 2.4
    [counts] = notes(journal, "navgpt")
    assert (counts["moves"], counts["blocked_moves"]) == (0, 1)


def test_nonsense_is_told_back_counted_and_survived(corridor: Make, go: Go) -> None:
    robot = corridor()
    replies = ["Hello!", "Action: fly", "", go(robot.ids[1]), ARRIVED]
    journal, model = follow(replies, robot)
    assert robot.place == 1
    assert "Your reply has no action." in shown(model, 1)
    assert "There is no action 'fly'." in shown(model, 2)
    [counts] = notes(journal, "navgpt")
    assert counts["parse_failures"] == {"no_action": 2, "unknown_action": 1}
    assert counts["requests"] == 5


def test_it_is_stuck_after_too_many_failures_in_a_row(corridor: Make, go: Go) -> None:
    robot = corridor()
    replies = ["?", "?", go(robot.ids[1]), "?", go("f" * 32), "?", ARRIVED]
    options = NavGPTOptions(failures=3)
    over, journal = ends(ScriptedLanguageModel(replies), robot, options)
    assert over.stopped_by == "stuck"
    assert journal.model_calls == 6
    assert notes(journal, "navgpt")[0]["moves"] == 1


def test_the_budget_ends_it(corridor: Make, go: Go) -> None:
    robot = corridor()
    back_and_forth = [go(robot.ids[1 - k % 2]) for k in range(30)]
    over, journal = ends(ScriptedLanguageModel(back_and_forth), robot, RELEASED)
    assert over.stopped_by == "budget"
    assert journal.model_calls == 10
    assert notes(journal, "navgpt")[0]["iterations"] == 10


def test_the_scratchpad_is_cut(corridor: Make, go: Go) -> None:
    robot = corridor()
    replies = [*(go(robot.ids[1 - k % 2]) for k in range(15)), ARRIVED]
    _, model = follow(replies, robot, scratchpad=2000)
    steps = shown(model, 15).partition("Your steps so far:\n")[2]
    assert len(steps) < 2100
    assert "View 0." in steps
    assert shown(model, 1).count("I go on.") == 1


def test_counts_are_noted_though_the_model_fails(corridor: Make, go: Go) -> None:
    robot = corridor()
    model, journal = ScriptedLanguageModel([go(robot.ids[1])]), Journal(limits=FAIR)
    agent = NavGPTAgent(NavGPTOptions(), model)
    with pytest.raises(LanguageModelError):
        agent.follow("", robot, journal, np.random.default_rng(0))
    assert notes(journal, "navgpt")[0]["moves"] == 1


def test_local_models_are_held_to_the_viewpoints_listed(corridor: Make) -> None:
    robot = corridor()
    _, model = follow([ARRIVED], robot)
    assert f'id ::= "{robot.ids[1]}"' in (model.requests[0].grammar or "")
    _, free = follow([ARRIVED], robot, grammar=False)
    assert free.requests[0].grammar is None


RELEASED = NavGPTOptions(budget="released")


def test_the_released_budget_is_that_of_the_released_code() -> None:
    assert loop_limits(RELEASED, FairLimits(144, {})) == LoopLimits(10, 7000, None)
    assert loop_limits(RELEASED, None) == LoopLimits(10, 7000, None)


def test_the_fair_budget_is_that_of_the_run_and_its_scratchpad_grows_with_it() -> None:
    options = NavGPTOptions()
    assert loop_limits(options, FairLimits(144, {})) == LoopLimits(144, 100_800, 10)
    with pytest.raises(SettingsError, match="expected a run's journal"):
        loop_limits(options, None)


def test_what_is_set_counts_before_the_budget() -> None:
    options = NavGPTOptions(iterations=5, scratchpad=900, failures=2)
    assert loop_limits(options, FairLimits(144, {})) == LoopLimits(5, 900, 2)


def test_the_name_tells_model_budget_and_what_differs() -> None:
    model = ScriptedLanguageModel([], name="m")
    assert NavGPTAgent(NavGPTOptions(), model).name == "navgpt[m]+fair"
    other = NavGPTOptions(
        budget="released", faithful=True, captions="vision", iterations=30
    )
    name = NavGPTAgent(other, model).name
    assert name == "navgpt[m]+released+faithful+vision+iterations=30"


@pytest.mark.parametrize(
    ("pairs", "message"),
    [
        ([("budget", "big")], "--set budget: expected fair or released, got 'big'"),
        ([("iteration", "3")], "did you mean 'iterations'"),
        (
            [("iterations", "0")],
            "--set iterations: expected a whole number of at least 1",
        ),
        ([("caption_model", "x")], "add --set captions=vision"),
    ],
)
def test_wrong_settings_are_refused(pairs: list[tuple[str, str]], message: str) -> None:
    with pytest.raises(SettingsError, match=message):
        read_options(NavGPTOptions, pairs, agent="navgpt")
