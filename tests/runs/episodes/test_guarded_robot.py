from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import memorymaze as mm
from memorymaze.runs.episodes.agent_catalogue import choose_agent
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.episode import EpisodeRun, run_episode
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.episodes.trace_entries import CallEntry, NoteEntry

AGENT = """
class Mine:
    name = "mine"

    def follow(self, instruction, robot, journal, rng):
        {line}
"""

Run = Callable[[str], EpisodeRun]


@pytest.fixture
def own_agent(tmp_path: Path, tiny_plan: Callable[..., RunPlan]) -> Run:
    """Run the first episode with an agent of a user's own, whose code is one line."""

    def first_episode(line: str) -> EpisodeRun:
        path = tmp_path / "own.py"
        path.write_text(AGENT.format(line=line), encoding="utf-8")
        plan = tiny_plan("stop")
        settings = replace(plan.settings, agent=AgentSettings(f"{path}:Mine"))
        agent = choose_agent(settings.agent).make().agent
        arena = Arena(plan.sites["corridor"])
        return run_episode(agent, plan.episodes[0], arena, settings)

    return first_episode


@pytest.mark.parametrize(
    "name",
    ["scene", "pose", "trajectory", "settings", "follow", "camera_view", "_driver"],
)
def test_an_own_agent_gets_nothing_behind_the_robot(own_agent: Run, name: str) -> None:
    result = own_agent(f"robot.{name}").result
    assert result.stopped_by == "crash"
    assert result.error is not None
    assert (
        f"has no '{name}': agents get what is in memorymaze.robot.api.control"
        in result.error
    )
    assert result.error.endswith("(own.py, line 6)")


def test_nothing_can_be_put_on_the_robot(own_agent: Run) -> None:
    assert own_agent("robot.stop = None").result.stopped_by == "crash"


@pytest.mark.parametrize(
    ("line", "call"),
    [
        ("robot.move_forward(1.0)", "move_forward"),
        ("robot.detect_turning_point()", "detect_turning_point"),
        ("robot.turning_point_id()", "turning_point_id"),
        ("robot.turn('around')", "turn"),
        ("robot.turn_by(-30)", "turn_by"),
        ("robot.detect_from_RGB_image('door')", "detect_from_RGB_image"),
        ("robot.read_signs()", "read_signs"),
        ("robot.say('hello')", "say"),
        ("robot.distance_travelled()", "distance_travelled"),
        ("robot.stop()", "stop"),
        ("robot.step_forward(0.5)", "step_forward"),
        ("robot.rotate(0.5)", "rotate"),
        ("robot.camera_picture(32, 24)", "camera_picture"),
    ],
)
def test_all_that_the_control_api_has_reaches_the_robot(
    own_agent: Run, line: str, call: str
) -> None:
    run = own_agent(line)
    assert run.result.stopped_by == "agent"
    calls = (each.call for each in run.trace if isinstance(each, CallEntry))
    assert next(calls) == call


@pytest.mark.parametrize("isolate", [False, True])
@pytest.mark.parametrize(
    ("needs", "line", "said"),
    [
        ({"steps"}, "robot.camera_picture(32, 24)", "declare 'camera'"),
        ({"camera"}, "robot.rotate(0.5)", "needs = {'camera'}; add 'steps'"),
        ({"camera"}, "robot.step_forward(1.0)", "robot.step_forward is for agents"),
        (
            {"camera", "steps"},
            "robot.rotate(robot.camera_picture(9, 9).rgb.ndim)",
            None,
        ),
        ({"steps"}, "robot.lidar_scan()", None),
        (set(), "robot.rotate(robot.camera_picture(9, 9).rgb.ndim)", None),
    ],
)
def test_an_agent_gets_the_pictures_and_steps_that_it_declares(
    tmp_path: Path,
    corridor_site: mm.Site,
    needs: set[str],
    line: str,
    said: str | None,
    isolate: bool,
) -> None:
    path = tmp_path / "own.py"
    path.write_text(AGENT.format(line=line) + f"    needs = {needs!r}\n")
    walk = mm.follow("Go.", f"{path}:Mine", site=corridor_site, isolate=isolate)
    assert walk.stopped_by == ("agent" if said is None else "crash")
    assert said is None or said in str(walk.result.error)


def seen_in(run: EpisodeRun) -> list[Mapping[str, Any]]:
    notes = (each for each in run.trace if isinstance(each, NoteEntry))
    return [each.details for each in notes if each.about == "seen"]


def test_an_own_agent_has_the_lidar(own_agent: Run) -> None:
    run = own_agent("journal.note('seen', rays=len(robot.lidar_scan().ranges))")
    assert seen_in(run) == [{"rays": 360}]


def test_an_own_agent_sees_that_it_can_go_by_steps(own_agent: Run) -> None:
    line = (
        "import memorymaze.robot.api.steps as s; "
        "journal.note('seen', steps=isinstance(robot, s.SteppingRobot))"
    )
    assert seen_in(own_agent(line)) == [{"steps": True}]
