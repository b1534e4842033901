"""The track with people one can ask, from settings to results."""

import json
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path

import pytest

import memorymaze as mm
from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.spending import TokenPrice
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.runs.episodes.estimates import cost_estimate, said_beforehand
from memorymaze.runs.episodes.in_words import result_lines
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.results import EpisodeResult, result_from_line
from memorymaze.runs.episodes.settings import AgentSettings, RunDefinition, RunSettings
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import OpeningEntry
from memorymaze.runs.story.events import events_of
from memorymaze.runs.tables import load_runs, run_tables
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder, read_run
from memorymaze.texts.corpus import Corpus

Make = Callable[..., EpisodeResult]
Plan = Callable[..., RunPlan]

CROWD = ObstacleSettings(things_per_100m=0, people=20)
AGENT = """
from memorymaze.robot.api.asking import Question, is_this, way_to

class Asker:
    name = "asker"

    def follow(self, instruction, robot, journal, rng):
        journal.note("told", destination=robot.destination())
        for _ in range(20):
            answer = robot.ask(way_to(robot.destination()))
            if answer is not None:
                {line}
                break
            robot.turn_by(90)
        robot.stop()
"""


@pytest.fixture
def asked(tmp_path: Path, crossing_site: mm.Site) -> Callable[..., mm.Walk]:
    """Let an agent ask the first person it meets, and do something more."""

    def walk(line: str = "pass", **choices: object) -> mm.Walk:
        path = tmp_path / "asker.py"
        path.write_text(AGENT.format(line=line), encoding="utf-8")
        given = {"ask": 1, "obstacles": CROWD, **choices}
        return mm.follow("Go left.", f"{path}:Asker", site=crossing_site, **given)

    return walk


def test_people_are_there_where_nobody_says_how_many() -> None:
    assert RunSettings(ask=0).obstacles == ObstacleSettings()
    assert RunSettings(ask=0).track == "people"
    assert RunSettings().track == "default"


@pytest.mark.parametrize(
    ("choices", "said"),
    [
        ({"ask": -1}, "ask: expected"),
        ({"ask": 1, "obstacles": ObstacleSettings(people=0)}, "none to ask"),
        ({"ask": 1, "passers_by": "rude"}, "passers_by"),
        ({"passers_by": "wrong"}, "add ask"),
    ],
)
def test_settings_without_meaning_are_refused(
    choices: dict[str, object], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        RunSettings(**choices)  # type: ignore[arg-type]


def test_an_answer_is_counted_with_what_it_cost(
    asked: Callable[..., mm.Walk],
) -> None:
    walk = asked()
    result = walk.result
    assert result.stopped_by == "agent"
    assert result.questions == 1
    assert result.strangers_s > 2
    assert result.standing_s == 0
    [left] = result.answers_left_m
    assert left == pytest.approx(19.1, abs=0.2)
    assert walk.trace[0]["destination"] == "the kitchen"
    [entry] = [each for each in walk.trace if each["kind"] == "passer_by"]
    assert entry["truth"] in ("right", "wrong", "unknown")
    said = [each for each in walk.trace if each.get("call") == "ask"][-1]
    assert said["arguments"] == {"question": "Excuse me, how do I get to the kitchen?"}
    assert result_from_line(json.dumps(asdict(result)), "a line") == result


def test_an_isolated_agent_hears_the_same_words(
    asked: Callable[..., mm.Walk],
) -> None:
    line = "journal.note('heard', words=answer)"
    here, apart = asked(line), asked(line, isolate=True)
    assert any(each.get("about") == "heard" for each in here.trace)
    assert apart.trace == here.trace


@pytest.mark.parametrize("isolate", [False, True])
def test_nothing_but_words_reaches_the_agent(
    asked: Callable[..., mm.Walk], isolate: bool
) -> None:
    names = ["surroundings", "encounters", "_encounters"]
    line = f"assert not [each for each in {names} if hasattr(robot, each)]; robot.crowd"
    walk = asked(line, isolate=isolate)
    assert walk.stopped_by == "crash"
    assert "has no 'crowd'" in str(walk.result.error)


def test_what_is_no_question_is_refused_in_words(
    asked: Callable[..., mm.Walk],
) -> None:
    walk = asked("robot.ask('where am I?')", ask=2)
    assert "ask: expected way_to" in str(walk.result.error)


@pytest.mark.parametrize("isolate", [False, True])
def test_in_other_tracks_nobody_can_be_asked(
    asked: Callable[..., mm.Walk], isolate: bool
) -> None:
    walk = asked(ask=None, isolate=isolate)
    assert walk.stopped_by == "crash"
    assert "destination" in str(walk.result.error)
    assert "destination" not in walk.trace[0]


def test_questions_are_no_calls_of_the_robot(asked: Callable[..., mm.Walk]) -> None:
    assert "has no 'way_to'" in str(asked("robot.way_to('x')").result.error)


def test_without_questions_the_destination_is_told_and_nobody_answers(
    asked: Callable[..., mm.Walk],
) -> None:
    walk = asked(ask=0)
    assert walk.stopped_by == "agent"
    assert walk.result.questions == 0
    assert walk.trace[0]["destination"] == "the kitchen"


def test_wrong_people_answer_wrongly_and_the_table_knows(
    asked: Callable[..., mm.Walk],
) -> None:
    assert asked(passers_by="wrong").result.wrong_answers == 1
    empty = asked(passers_by="empty")
    assert empty.result.questions == 1
    assert empty.result.wrong_answers == 0


@pytest.fixture
def played(tmp_path: Path, crossing_site: mm.Site) -> Callable[..., mm.Walk]:
    """Let an agent ask somebody whom a model plays, with recorded replies."""

    def walk(reply: dict[str, object], **choices: object) -> mm.Walk:
        path = tmp_path / "asker.py"
        path.write_text(AGENT.format(line="pass"), encoding="utf-8")
        answers = tmp_path / "answers.jsonl"
        answers.write_text(json.dumps(reply) + "\n", encoding="utf-8")
        agent = AgentSettings(
            f"{path}:Asker", language_model=ModelSettings(replay=str(answers))
        )
        given = {"ask": 1, "obstacles": CROWD, "passers_by": "model", **choices}
        return mm.follow("Go left.", agent, site=crossing_site, **given)

    return walk


SPOKEN = {
    "instruction_id": "crossing-route_r1_reference",
    "model": "canned",
    "stage": "passer_by",
    "reply": "Straight on and left, mind the wet floor.",
    "prompt_tokens": 200,
    "completion_tokens": 12,
    "cost_usd": 0.01,
}


def test_a_model_plays_people_and_its_cost_is_not_the_agents(
    played: Callable[..., mm.Walk],
) -> None:
    walk = played(SPOKEN)
    result = walk.result
    assert result.stopped_by == "agent", result.error
    assert (result.strangers_tokens, result.strangers_cost_usd) == (212, 0.01)
    assert (result.tokens, result.model_calls, result.cost_usd) == (0, 0, 0)
    [entry] = [each for each in walk.trace if each["kind"] == "passer_by"]
    assert entry["model"] == "canned"
    call = next(each for each in walk.trace if each.get("result") == SPOKEN["reply"])
    assert call["call"] == "ask"
    told = [each.text for each in events_of(walk.run.trace)]
    assert any("words of a language model, canned" in text for text in told)


def test_a_model_that_does_not_answer_ends_the_walk_as_its_error(
    played: Callable[..., mm.Walk],
) -> None:
    walk = played({**SPOKEN, "stage": "step"})
    assert walk.stopped_by == "model_error"
    assert "passer_by of 'crossing-route_r1_reference'" in str(walk.result.error)


def test_a_model_that_plays_people_has_to_be_named(tiny_plan: Plan) -> None:
    with pytest.raises(SettingsError, match="name a language model"):
        tiny_plan("stop", limit=1, ask=1, obstacles=CROWD, passers_by="model")


def test_a_model_that_nobody_asks_is_refused(played: Callable[..., mm.Walk]) -> None:
    with pytest.raises(SettingsError, match="asks no language model"):
        played(SPOKEN, passers_by="memory")


def test_a_run_with_a_model_in_role_tells_what_its_words_cost(
    tiny_sites_folder: Path, tiny_corpus: Corpus, tmp_path: Path
) -> None:
    agent = tmp_path / "asker.py"
    agent.write_text(AGENT.format(line="pass"), encoding="utf-8")
    answers = tmp_path / "answers.jsonl"
    ids = {each.instruction.id for each in tiny_corpus.episodes}
    answers.write_text(
        "".join(json.dumps({**SPOKEN, "instruction_id": each}) + "\n" for each in ids),
        encoding="utf-8",
    )
    model = ModelSettings(replay=str(answers))
    asker = AgentSettings(f"{agent}:Asker", language_model=model)
    settings = RunSettings(ask=1, obstacles=CROWD, passers_by="model", limit=2)
    plan = plan_run(asker, tiny_corpus, settings)
    results = run_plan(plan, tmp_path / "run", workers=1)
    asked = sum(each.questions for each in results)
    assert asked > 0
    assert sum(each.strangers_tokens for each in results) == 212 * asked
    lines = "\n".join(result_lines(plan.settings, results))
    assert "passers-by's words by a language model" in lines
    assert any("A LANGUAGE MODEL" in line for line in said_beforehand(plan))


def test_what_people_in_role_will_cost_cannot_be_told_beforehand(
    tiny_corpus: Corpus,
) -> None:
    model = ModelSettings(model="any", base_url="http://127.0.0.1:1/v1")
    priced = replace(model, price=TokenPrice(1.0, 2.0))
    settings = RunSettings(ask=1, passers_by="model", limit=2)
    plan = plan_run(
        AgentSettings("guide", language_model=priced), tiny_corpus, settings
    )
    assert "how many people will be asked" in str(cost_estimate(plan))


def test_a_run_with_people_is_kept_and_not_taken_up_with_others(
    tiny_plan: Plan, tmp_path: Path
) -> None:
    plan = tiny_plan("stop", limit=1, ask=3, obstacles=CROWD)
    assert any("3 questions" in line for line in said_beforehand(plan))
    [result] = run_plan(plan, tmp_path, workers=1)
    assert read_run(tmp_path)[0].settings.ask == 3
    [first, *_] = read_trace(tmp_path, result.episode_id)
    assert isinstance(first, OpeningEntry)
    assert first.destination
    other = tiny_plan("stop", limit=1, ask=3, obstacles=CROWD, passers_by="wrong")
    with pytest.raises(RunFolderError, match="passers_by"):
        run_plan(other, tmp_path, workers=1, resume=True)


def test_tables_and_summaries_tell_the_track(
    record: RunRecord, settings: RunDefinition, result: Make, tmp_path: Path
) -> None:
    chosen = replace(settings, ask=1, obstacles=CROWD, passers_by="wrong")
    results = [result("a-1", questions=1, wrong_answers=1, strangers_s=8.0)]
    with open_run_folder(
        tmp_path / "asked", replace(record, settings=chosen), resume=False
    ) as run:
        run.add(results[0])
    [loaded] = load_runs([tmp_path / "asked"])
    assert loaded.label == "guide, up to 1 question (wrong answers)"
    text = " ".join(run_tables([loaded])[0].text().split())
    assert "TRACK WITH PEOPLE ONE CAN ASK" in text
    assert "ALL OF WHOM ANSWER WRONGLY" in text
    lines = "\n".join(result_lines(chosen, results))
    assert "1 question answered, 1 of them wrongly" in lines
    assert "strangers stand 8.0 s" in lines
