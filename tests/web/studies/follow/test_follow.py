"""People who follow texts with the robot: driven, broken off, scored beside agents."""

import json
import shutil
from collections.abc import Callable, Generator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError, StudyError
from memorymaze.front.cli.main import run_command_line
from memorymaze.runs.story import load_episode
from memorymaze.runs.work.run_folder import read_instructions, read_run
from memorymaze.web.serving.live_process import ProcessLost
from memorymaze.web.studies.follow.drives import (
    STILL_THERE,
    Drives,
    NoRobotNow,
    WalkElsewhere,
    commands_of,
)
from memorymaze.web.studies.follow.runs import export_walks
from memorymaze.web.studies.follow.texts import texts_to_follow
from memorymaze.web.studies.follow.walk import Said, SeenOnWalk
from memorymaze.web.studies.schedule import StudyStep
from memorymaze.web.studies.store import Participant, Store, open_store
from memorymaze.web.studies.study_file import Study

MakeStudy = Callable[..., Study]

LEFT_AT_THE_T = ["forward"] * 20 + ["left"] * 3 + ["forward"] * 18
"""To the goal of R1."""
STEP = StudyStep.of("follow", "R1")
SURE = Said(arrived=True, confidence=0.75)


EXAMPLE = Path(__file__).parents[4] / "examples" / "own_robot.py"


@pytest.fixture
def study(make_study: MakeStudy, tiny_instructions: Path) -> Study:
    return make_study(
        "follow", f"instructions = [{json.dumps(str(tiny_instructions))}]"
    )


@pytest.fixture
def store(study: Study) -> Generator[Store]:
    with open_store(study) as store:
        yield store


@pytest.fixture
def drives(study: Study, store: Store) -> Generator[Drives]:
    with Drives(store, texts_to_follow(study), draws=False) as drives:
        yield drives


def somebody(store: Store, name: str = "one") -> Participant:
    who = store.begin(name, {})
    assert isinstance(who, Participant)
    return who


def drive_to_the_goal(drives: Drives, who: Participant) -> None:
    for number, command in enumerate(LEFT_AT_THE_T):
        drives.drive(who, STEP, number, command)


def finish(store: Store, drives: Drives, who: Participant, said: Said) -> None:
    """End a walk as the page does."""
    taken = drives.ending(who, STEP, said)
    store.add_answer(who.id, STEP, taken.text, taken.shown)


def test_somebody_arrives_and_is_scored_in_a_run_that_tables_read(
    study: Study,
    store: Store,
    drives: Drives,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    who = somebody(store)
    drive_to_the_goal(drives, who)
    finish(store, drives, who, SURE)
    out = tmp_path / "people"
    done = export_walks(study, store, out)
    assert (done.walks, done.participants) == (1, 1)
    record, [result] = read_run(out)
    assert record.settings.agent.name == "people"
    assert (result.agent, result.stopped_by, result.success) == (
        "people",
        "agent",
        True,
    )
    assert result.confidence == 0.75
    assert result.api_calls == len(LEFT_AT_THE_T)
    [told] = read_instructions(out)
    assert told.text == drives.text_for(who, STEP).instruction.text
    assert load_episode(out, result.episode_id).story.walk.length > 10
    again = tmp_path / "again"
    for verb in ("table", "compare"):
        folders = [out] if verb == "table" else [out, shutil.copytree(out, again)]
        assert run_command_line([verb, *map(str, folders)]) == 0
        assert "people" in capsys.readouterr().out
    assert [each.path for each in store.exports()] == [str(out)]
    with pytest.raises(SettingsError, match="not there yet"):
        export_walks(study, store, out)


def test_people_can_drive_a_body_of_ones_own(
    make_study: MakeStudy, tiny_instructions: Path, tmp_path: Path
) -> None:
    texts = f"instructions = [{json.dumps(str(tiny_instructions))}]"
    study = make_study("follow", f'{texts}\nrobot = "{EXAMPLE}:in_site"')
    with (
        open_store(study) as store,
        Drives(store, texts_to_follow(study), draws=False) as drives,
    ):
        who = somebody(store)
        drive_to_the_goal(drives, who)
        finish(store, drives, who, SURE)
        export_walks(study, store, tmp_path / "walks")
    record, [result] = read_run(tmp_path / "walks")
    assert str(record.settings.robot) == f"{EXAMPLE}:in_site"
    assert result.success


def test_a_walk_goes_on_in_another_process_where_it_was_broken_off(
    study: Study, store: Store, tmp_path: Path
) -> None:
    texts = texts_to_follow(study)
    who = somebody(store)
    for commands in (LEFT_AT_THE_T[:10], LEFT_AT_THE_T[10:]):
        # The second server finds the walk as the first one left it.
        with Drives(store, texts, draws=False) as drives:
            before = drives.see(who, STEP)["done"]
            for number, command in enumerate(commands, start=before):
                told = drives.drive(who, STEP, number, command)
            assert told["done"] == before + len(commands)
            drives.see(who, STEP)
    finish(store, drives, who, SURE)
    export_walks(study, store, tmp_path / "people")
    _, [result] = read_run(tmp_path / "people")
    assert result.success


def test_a_command_sent_twice_counts_once(store: Store, drives: Drives) -> None:
    who = somebody(store)
    for _ in range(3):
        told = drives.drive(who, STEP, 0, "forward")
        assert told["done"] == 1
    assert commands_of(store, who.id, STEP) == ["forward"]
    with pytest.raises(WalkElsewhere):
        drives.drive(who, STEP, 5, "forward")
    with pytest.raises(StudyError, match="expected one of forward"):
        drives.drive(who, STEP, 1, "teleport")


def test_a_wall_is_told_and_a_robot_that_is_stuck_ends_the_walk(
    study: Study, store: Store, drives: Drives, tmp_path: Path
) -> None:
    who = somebody(store)
    last = StudyStep.of("follow", who.order[-1])
    told: dict[str, Any] = {"over": False}
    number, answers = 0, set[str]()
    while not told["over"]:
        told = drives.drive(who, last, number, "forward")
        answers.add(told.get("answer", ""))
        number += 1
    assert any("does not go on" in answer for answer in answers)
    assert last in store.answers(who.id), "kept without another word"
    ended = store.participant(who.id)
    assert ended is not None
    assert ended.state == "complete", "it was the last of all"
    assert drives.see(who, last) == {"over": True}
    assert drives.drive(who, last, number, "left") == {"over": True}
    export_walks(study, store, tmp_path / "people")
    _, [result] = read_run(tmp_path / "people")
    assert result.stopped_by in {"stuck", "budget"}
    assert not result.success


def test_texts_that_fewest_have_followed_come_first_and_second_walks_are_apart(
    study: Study, store: Store, drives: Drives, tmp_path: Path
) -> None:
    texts = texts_to_follow(study).of_route("R1")
    people = [somebody(store, str(number)) for number in range(len(texts) + 1)]
    told = [drives.text_for(who, STEP).id for who in people]
    assert sorted(told[:-1]) == sorted(each.id for each in texts)
    assert told[-1] == told[0]
    assert drives.text_for(people[0], STEP).id == told[0], "stays the same"
    for who in people:
        finish(store, drives, who, Said(arrived=False, confidence=0.0))
    done = export_walks(study, store, tmp_path / "people")
    assert [folder.name for folder in done.folders] == ["people", "people-2"]
    assert done.never_followed == len(texts_to_follow(study).of_route("R2"))
    _, first = read_run(done.folders[0])
    _, second = read_run(done.folders[1])
    assert (len(first), [each.episode_id for each in second]) == (len(texts), told[-1:])
    assert all(each.gave_up for each in first)


def test_walks_that_nobody_ended_are_not_exported_and_withdrawal_removes_them(
    study: Study, store: Store, drives: Drives, tmp_path: Path
) -> None:
    who, other = somebody(store), somebody(store, "other")
    drives.drive(who, STEP, 0, "forward")
    with pytest.raises(StudyError, match="expected walks that were ended"):
        export_walks(study, store, tmp_path / "people")
    finish(store, drives, other, SURE)
    assert export_walks(study, store, tmp_path / "people").walks == 1
    store.withdraw(other.id)
    with pytest.raises(StudyError, match="expected walks that were ended"):
        export_walks(study, store, tmp_path / "again")


class StandsStill:
    """A process whose robot is told what to do and never does it."""

    def __init__(self, work: object, hear: Callable[[object], None]) -> None:
        self._hear = hear
        hear(SeenOnWalk(0, (), 0.0, (0.0, 0.0), ""))

    def tell(self, message: object) -> None:
        pass

    def end(self) -> None:
        self._hear(ProcessLost("The robot was put away."))


def test_a_study_ends_without_a_complaint_while_somebody_waits_for_a_robot(
    study: Study,
    serve_study: Callable[[Study], Any],
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    monkeypatch.setattr("memorymaze.web.studies.follow.drives.LiveProcess", StandsStill)
    with ThreadPoolExecutor() as elsewhere:
        with ExitStack() as after, serve_study(study) as served:
            visitor = served.browse()
            after.enter_context(served.visits.pop_all())  # still there when it ends
            visitor.consent()
            answer = elsewhere.submit(
                visitor.post, f"/robot/{STEP}", number="0", command="forward"
            )
            [who] = served.store.participants()
            while not commands_of(served.store, who.id, STEP):
                assert not answer.done()
        assert answer.result().status_code == 503
    assert not caplog.records


def test_a_study_without_texts_of_a_route_is_refused(
    make_study: MakeStudy, tmp_path: Path, tiny_instructions: Path
) -> None:
    lines = tiny_instructions.read_text(encoding="utf-8").splitlines()
    kept = [line for line in lines if json.loads(line)["site"] != "t_junction"]
    (tmp_path / "others.jsonl").write_text("\n".join(kept), encoding="utf-8")
    study = make_study("follow", 'instructions = ["others.jsonl"]')
    with pytest.raises(StudyError, match="expected texts of R1 of t_junction"):
        texts_to_follow(study)


def test_texts_that_changed_since_they_were_followed_are_refused(
    make_study: MakeStudy, tmp_path: Path, tiny_instructions: Path
) -> None:
    texts = tmp_path / "texts.jsonl"
    told = tiny_instructions.read_text(encoding="utf-8")
    texts.write_text(told, encoding="utf-8")
    study = make_study("follow", 'instructions = ["texts.jsonl"]')
    with open_store(study) as store:
        who = somebody(store)
        with Drives(store, texts_to_follow(study), draws=False) as drives:
            drives.see(who, STEP)
            finish(store, drives, who, SURE)
        followed = drives.text_for(who, STEP)
        words = followed.instruction.text
        texts.write_text(told.replace(words, "Go elsewhere."), encoding="utf-8")
        with pytest.raises(StudyError, match="got other words"):
            export_walks(study, store, tmp_path / "people")
        texts.write_text(told.replace(f'"{followed.id}"', '"new"'), encoding="utf-8")
        with (
            pytest.raises(StudyError, match="got it no more"),
            Drives(store, texts_to_follow(study)),
        ):
            pass


def test_a_walk_that_ends_while_the_robot_is_on_its_way_is_exported(
    study: Study, store: Store, drives: Drives, tmp_path: Path
) -> None:
    who = somebody(store)
    drives.drive(who, STEP, 0, "forward")
    for number in (1, 2):
        # Kept before the robot moves, and told by nobody yet.
        store.add_event(who.id, STEP, "drive.forward", number)
    finish(store, drives, who, SURE)
    export_walks(study, store, tmp_path / "people")
    _, [result] = read_run(tmp_path / "people")
    assert result.api_calls == 3


def test_a_walk_that_would_end_elsewhere_now_is_left_out_and_named(
    study: Study,
    store: Store,
    drives: Drives,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    who = somebody(store)
    drives.drive(who, STEP, 0, "forward")
    taken = drives.ending(who, STEP, SURE)
    driven = json.loads(taken.text) | {"place": [5.0, 5.0]}
    store.add_answer(who.id, STEP, json.dumps(driven), taken.shown)
    with pytest.raises(StudyError, match="where their drivers saw them end"):
        export_walks(study, store, tmp_path / "people")
    other = somebody(store, "other")
    drives.drive(other, STEP, 0, "forward")
    finish(store, drives, other, SURE)
    out = tmp_path / "people"
    assert (
        run_command_line(["study", "export", str(study.path), "--out", str(out)]) == 0
    )
    told = capsys.readouterr().out
    assert "1 walk of 1 participant\n1 walk left out" in told
    assert f"saw: {who.id} on {driven['text']} (" in told
    _, [result] = read_run(out)
    assert result.episode_id == drives.text_for(other, STEP).id


def test_who_comes_when_all_robots_are_driven_waits_until_one_rests(
    study: Study, store: Store
) -> None:
    now = [0.0]
    texts = texts_to_follow(study)
    first, second = somebody(store), somebody(store, "second")
    with Drives(store, texts, most=1, draws=False, clock=lambda: now[0]) as drives:
        drives.drive(first, STEP, 0, "forward")
        with pytest.raises(NoRobotNow, match="Please wait"):
            drives.see(second, STEP)
        now[0] += STILL_THERE + 1
        assert drives.see(second, STEP)["done"] == 0
        now[0] += STILL_THERE + 1
        assert drives.see(first, STEP)["done"] == 1, "goes on where it was"
