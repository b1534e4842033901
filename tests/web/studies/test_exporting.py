import csv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError, StudyError
from memorymaze.texts.corpus import load_instructions
from memorymaze.web.studies.exporting import export_study
from memorymaze.web.studies.schedule import StudyStep
from memorymaze.web.studies.store import Participant, open_store
from memorymaze.web.studies.study_file import Study, load_study

MakeStudy = Callable[..., Study]
ServeStudy = Callable[[Study], Any]
WAY = "=Go straight on to the end of the corridor, then turn left at the junction."


def take_part(visitor: Any, attention: str = "1") -> None:
    visitor.reach_first_way(f"?PROLIFIC_PID=5f00aa7{attention}")
    for telling in range(4):
        visitor.send(text=f"{WAY} ({telling})")
        if "A short question" in visitor.page:
            visitor.send(answer_0=attention)


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def test_descriptions_of_who_finished_become_an_instruction_file(
    make_study: MakeStudy, serve_study: ServeStudy, tmp_path: Path
) -> None:
    study = make_study()
    with serve_study(study) as served:
        one, other = served.browse(), served.browse()
        take_part(one)
        other.reach_first_way()
        other.send(text=f"{WAY} Unfinished.")
        done = export_study(study, served.store, tmp_path / "mine.jsonl")
        [who] = [e for e in served.store.participants() if e.state == "complete"]
        exports = [Path(each.path).name for each in served.store.exports()]
    assert (done.instructions, done.participants) == (4, 1)
    assert exports == ["mine.jsonl", "mine.csv"]
    told = load_instructions([tmp_path / "mine.jsonl"])
    first, second = who.order
    assert [(each.route, each.iteration) for each in told] == [
        (first, 1),
        (first, 2),
        (second, 1),
        (second, 2),
    ]
    assert {(e.site, e.study, e.source, e.participant) for e in told} == {
        ("t_junction", "online", "human", who.id)
    }
    assert [each.text for each in told] == [f"{WAY} ({n})" for n in range(4)]
    for path in tmp_path.glob("mine.*"):
        assert b"5f00aa71" not in path.read_bytes(), "an id of a platform"


def test_the_table_has_what_was_measured_and_the_treatment(
    make_study: MakeStudy, serve_study: ServeStudy, tmp_path: Path
) -> None:
    study = make_study("memory", "delay_minutes = 0")
    with serve_study(study) as served:
        one = served.browse()
        one.reach_first_way()
        [who] = served.store.participants()
        first_page = ""
        for route in who.order:
            for kind in ("play", "ended", "again", "play", "ended"):
                one.post(f"/event/watch.{route}", kind=kind, value="0")
            one.send()
            first_page = first_page or one.page
            one.send(text=WAY)
            one.send(text=WAY)
            if "A short question" in one.page:
                one.send(answer_0="0")
        assert "Thank you!" in one.page
        export_study(study, served.store, tmp_path / "mine.jsonl")
    first, again, *_ = rows_of(tmp_path / "mine.csv")
    assert (first["video_plays"], first["video_watched_again"]) == ("2", "1")
    assert float(first["seconds"]) >= 0
    assert first["attention_checks_failed"] == "1"
    assert first["comprehension_attempts"] == "1"
    assert first["familiarity"] == "I have never been there"
    assert f"<p>{first['told_before']}</p>" in first_page, (
        "what was shown, to the letter"
    )
    assert again["told_before"] == study.design.robot
    # A spreadsheet shows a text that begins as a formula does, and runs nothing.
    assert first["text"] == f"'{WAY}"


def test_a_description_takes_no_longer_for_the_video_that_was_watched_before(
    make_study: MakeStudy, tmp_path: Path
) -> None:
    now = 1000.0
    study = make_study("memory")
    with open_store(study, clock=lambda: now) as store:
        who = store.begin("browser")
        assert isinstance(who, Participant)
        for route in who.order:
            for kind, seconds in (("watch", 15.0), ("tell", 2.0), ("retell", 3.0)):
                step = StudyStep.of(kind, route)
                store.add_event(who.id, step, "opened")
                now += seconds
                store.add_answer(who.id, step, WAY, state="complete")
        export_study(study, store, tmp_path / "mine.jsonl")
    taken = [row["seconds"] for row in rows_of(tmp_path / "mine.csv")]
    assert taken == ["2.0", "3.0"] * 2


def test_attention_is_judged_by_the_answer_that_was_right_when_it_was_asked(
    make_study: MakeStudy, serve_study: ServeStudy, tmp_path: Path
) -> None:
    study = make_study()
    with serve_study(study) as served:
        for choice in ("1", "0"):
            take_part(served.browse(), choice)
    study.path.write_text(study.text.replace('"A cat"', '"A cat."'), encoding="utf-8")
    later = load_study(study.path)
    with open_store(later) as store:
        export_study(later, store, tmp_path / "mine.jsonl")
    rows = rows_of(tmp_path / "mine.csv")
    failed = {row["participant"]: row["attention_checks_failed"] for row in rows}
    assert list(failed.values()) == ["0", "1"]


def test_without_anybody_who_finished_there_is_nothing_to_export(
    make_study: MakeStudy, serve_study: ServeStudy, tmp_path: Path
) -> None:
    study = make_study()
    with serve_study(study) as served:
        with pytest.raises(StudyError, match="expected participants who have finished"):
            export_study(study, served.store, tmp_path / "mine.jsonl")
        with pytest.raises(SettingsError, match=r"expected a file named \*.jsonl"):
            export_study(study, served.store, tmp_path / "mine.txt")
