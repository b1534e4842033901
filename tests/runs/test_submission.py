import gzip
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace import trace_path
from memorymaze.runs.submission import Submission, check_submission, remarks
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import read_run
from memorymaze.texts.corpus import load_corpus

TESTS = Path(__file__).parents[1]
CORPUS = load_corpus(TESTS / "tiny_instructions.jsonl", sites=TESTS / "tiny_sites")


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Run an agent over the tiny corpus; each run is made once."""
    made: dict[str, Path] = {}

    def run(agent: str, **changes: Any) -> Path:
        key = f"{agent} {changes}"
        if key not in made:
            made[key] = tmp_path_factory.mktemp("runs") / "run"
            plan = plan_run(
                AgentSettings(agent),
                CORPUS,
                with_choices(RunSettings(), changes),
            )
            run_plan(plan, made[key], workers=1)
        return made[key]

    return run


@pytest.fixture
def guide(finished: Callable[..., Path], tmp_path: Path) -> Path:
    """A copy of a run of `guide` by committed code, to be spoilt."""
    folder = tmp_path / "guide"
    run = finished("guide")
    for file in run.rglob("*"):
        if file.is_file():
            copy = folder / file.relative_to(run)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(file.read_bytes())
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    record["code"]["commit"] = "0123456789abcdef"
    (folder / "run.json").write_text(json.dumps(record), encoding="utf-8")
    return folder


def check(folder: Path) -> Submission:
    return check_submission(folder, CORPUS)


def edit_result(folder: Path, **changes: Any) -> str:
    """Change the first result; return its id."""
    file = folder / "episodes.jsonl"
    first, *others = file.read_text(encoding="utf-8").splitlines()
    record = json.loads(first) | changes
    file.write_text("\n".join([json.dumps(record), *others, ""]), encoding="utf-8")
    return record["episode_id"]


def test_a_whole_run_by_committed_code_is_ready(guide: Path) -> None:
    found = check(guide)
    assert found.problems == ()
    assert found.track == "default"


def test_a_prettier_result_than_the_trajectory_gives_is_found(guide: Path) -> None:
    episode = edit_result(guide, cls=0.999, spd=0.0)
    problems = check(guide).problems
    assert any(f"{episode!r}: expected spd" in each for each in problems)


def test_a_success_that_the_agent_did_not_end_is_found(guide: Path) -> None:
    edit_result(guide, success=True, stopped_by="budget")
    assert any("stopped by budget" in each for each in check(guide).problems)


def test_a_missing_or_damaged_trace_is_found(guide: Path) -> None:
    episode = edit_result(guide)
    trace_path(guide, episode).write_bytes(b"nothing")
    assert any(
        f"episode {episode!r} is damaged" in each for each in check(guide).problems
    )
    trace_path(guide, episode).unlink()
    assert any("no such file" in each for each in check(guide).problems)


def spoil_trace(folder: Path, how: str) -> str:
    """Spoil the trace of the first episode; return the episode's id."""
    episode = edit_result(folder)
    path = trace_path(folder, episode)
    content = path.read_bytes()
    entries = [json.loads(line) for line in gzip.decompress(content).splitlines()]
    walk = next(entry for entry in entries if entry["kind"] == "trajectory")
    match how:
        case "flipped byte":
            # The bits that say how the first block is packed.
            path.write_bytes(content[:10] + bytes([content[10] | 6]) + content[11:])
            return episode
        case "nested too deep":
            path.write_bytes(gzip.compress(b"[" * 100_000))
            return episode
        case "no object":
            entries.insert(0, [1, 2])
        case "no kind":
            del entries[0]["kind"]
        case "no poses":
            del walk["poses"]
        case "odd poses":
            walk["poses"] = [{"x": 1}]
        case "outside":
            walk["poses"] = [[0.0, 1e9, 1e9, 0.0], [1.0, 1e9, 1e9, 0.0]]
        case _:
            walk["poses"][-1][1] = float("nan")
    lines = "".join(f"{json.dumps(entry)}\n" for entry in entries)
    path.write_bytes(gzip.compress(lines.encode()))
    return episode


@pytest.mark.parametrize(
    "how",
    [
        "flipped byte",
        "nested too deep",
        "no object",
        "no kind",
        "no poses",
        "odd poses",
        "outside",
        "no number",
    ],
)
def test_a_bad_trace_costs_its_own_walk_alone(guide: Path, how: str) -> None:
    episode = spoil_trace(guide, how)
    [problem] = check(guide).problems
    assert episode in problem or str(trace_path(guide, episode)) in problem


def test_a_trace_with_a_call_that_needs_answers_is_found(guide: Path) -> None:
    episode = edit_result(guide)
    path = trace_path(guide, episode)
    call = {
        "kind": "call",
        "time": 1.0,
        "pose": [0.0, 0.0, 0.0],
        "call": "follow",
        "arguments": {},
        "result": {"distance": 1.0, "reason": "done"},
    }
    content = gzip.decompress(path.read_bytes()) + json.dumps(call).encode() + b"\n"
    path.write_bytes(gzip.compress(content))
    assert any("the call follow" in each for each in check(guide).problems)


def test_edited_code_and_missing_episodes_are_found(guide: Path) -> None:
    record = json.loads((guide / "run.json").read_text(encoding="utf-8"))
    record["code"]["commit"] += "+"
    (guide / "run.json").write_text(json.dumps(record), encoding="utf-8")
    file = guide / "episodes.jsonl"
    lines = file.read_text(encoding="utf-8").splitlines()
    file.write_text("\n".join([*lines[1:], ""]), encoding="utf-8")
    problems = check(guide).problems
    assert any("expected a run by committed code" in each for each in problems)
    assert any(f"episodes without a result: 1 of {len(lines)}" in e for e in problems)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"limit": 3}, "setting limit: None expected, got 3"),
        ({"success_distance": 5.0}, "setting success_distance: 3.0 expected, got 5.0"),
        ({"time_budget": 9.0}, "setting simulation.time_budget"),
    ],
)
def test_other_settings_than_the_default_are_named(
    finished: Callable[..., Path], changes: dict[str, Any], message: str
) -> None:
    problems = check(finished("stop", **changes)).problems
    assert any(each.startswith(message) for each in problems)


def test_a_sample_is_said_to_be_whole_for_what_it_was_asked(
    finished: Callable[..., Path],
) -> None:
    setting, episodes, *others = check(finished("stop", limit=3)).problems
    assert setting == "setting limit: None expected, got 3"
    assert (
        "expected all 12 of the leaderboard, got a run that was asked for 3, and is "
        in (episodes)
    )
    assert "whole for what it was asked" in episodes
    assert all(each.startswith("code: ") for each in others)


def test_an_agent_that_is_given_the_answers_is_refused(
    finished: Callable[..., Path],
) -> None:
    problems = check(finished("oracle")).problems
    assert "agent: oracle is given the answers" in problems


OWN = """
class Stander:
    name = "stander"

    def follow(self, instruction, robot, journal, rng):
        robot.wait(1.0)
"""


@pytest.mark.parametrize("isolate", [False, True])
def test_an_agent_of_ones_own_must_have_been_run_without_buildings(
    tmp_path: Path, isolate: bool
) -> None:
    (tmp_path / "mine.py").write_text(OWN, encoding="utf-8")
    agent = AgentSettings(f"{tmp_path / 'mine.py'}:Stander")
    settings = with_choices(RunSettings(), {"isolate": isolate})
    run_plan(plan_run(agent, CORPUS, settings), tmp_path / "run", workers=1)
    asked = [
        each for each in check(tmp_path / "run").problems if "isolate=true" in each
    ]
    assert len(asked) == (0 if isolate else 1)


def test_another_corpus_than_the_leaderboards_is_refused(
    guide: Path, tmp_path: Path
) -> None:
    other = tmp_path / "other.jsonl"
    text = (TESTS / "tiny_instructions.jsonl").read_text(encoding="utf-8")
    other.write_text(text.replace("left", "right", 1), encoding="utf-8")
    found = check_submission(guide, load_corpus(other, sites=TESTS / "tiny_sites"))
    assert any(each.startswith("setting instructions[0]") for each in found.problems)


def test_own_agents_and_graphs_are_remarked_on(guide: Path) -> None:
    settings = read_run(guide)[0].settings
    own = replace(settings, agent=AgentSettings("mine.py:Agent"))
    [remark] = remarks(own, [])
    assert "must be published" in remark
    [remark] = remarks(replace(settings, needs=("graph",)), [])
    assert "navigation graph" in remark
