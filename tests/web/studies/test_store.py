import os
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.basics.errors import StudyError
from memorymaze.web.studies.answer_file import FILE
from memorymaze.web.studies.store import (
    RECORDINGS,
    Participant,
    Store,
    open_store,
)
from memorymaze.web.studies.study_file import Study, load_study

MakeStudy = Callable[..., Study]


def begin(store: Store, key: str, **ids: str) -> Participant:
    participant = store.begin(key, ids)
    assert isinstance(participant, Participant)
    return participant


def bytes_of(folder: Path) -> bytes:
    return b"".join(path.read_bytes() for path in folder.rglob("*") if path.is_file())


def test_what_was_answered_is_there_after_the_file_is_opened_again(
    make_study: MakeStudy,
) -> None:
    study = make_study()
    with open_store(study) as store:
        one = begin(store, "browser")
        assert store.add_answer(one.id, "tell.R1", "Go left.", shown="robot text")
        store.keep_draft(one.id, "retell.R1", "Go le")
        store.add_event(one.id, "tell.R1", "watched", 12.5)
    with open_store(study) as store:
        assert store.known_by("browser") == store.participant(one.id)
        answer = store.answers(one.id)["tell.R1"]
        assert (answer.text, answer.shown) == ("Go left.", "robot text")
        assert store.draft(one.id, "retell.R1") == "Go le"
        [event] = store.events(one.id, "tell.R1")
        assert (event.kind, event.value) == ("watched", 12.5)


def test_an_answer_is_final_and_its_draft_gone(make_study: MakeStudy) -> None:
    with open_store(make_study()) as store:
        one = begin(store, "browser").id
        store.keep_draft(one, "tell.R1", "Go")
        assert store.add_answer(one, "tell.R1", "Go left.")
        assert store.draft(one, "tell.R1") == ""
        assert not store.add_answer(one, "tell.R1", "Something else")
        assert not store.keep_draft(one, "tell.R1", "Something else")
        assert store.answers(one)["tell.R1"].text == "Go left."


def test_people_are_spread_over_the_orders_until_the_quota(
    make_study: MakeStudy,
) -> None:
    with open_store(make_study("online", "quota = 2")) as store:
        cells = [begin(store, f"browser {number}").cell for number in range(4)]
        assert sorted(cells) == ["R1, R2", "R1, R2", "R2, R1", "R2, R1"]
        assert store.begin("late") == "full"


def test_a_place_is_free_again_when_somebody_is_excluded_or_stays_away(
    make_study: MakeStudy,
) -> None:
    now = 1000.0
    study = make_study("online", "quota = 1", "held_minutes = 30")
    with open_store(study, clock=lambda: now) as store:
        first, _ = begin(store, "one"), begin(store, "two")
        assert store.begin("three") == "full"
        store.add_answer(first.id, "familiarity", "I know it", state="excluded")
        third = begin(store, "three")
        assert third.cell == first.cell
        now += 31 * 60
        assert begin(store, "four").cell
        assert [cell.left for cell in store.progress()] == [1, 1]


def test_an_id_of_a_platform_comes_once_and_apart(make_study: MakeStudy) -> None:
    with open_store(make_study()) as store:
        one = begin(store, "one", PROLIFIC_PID="5f00")
        assert "5f00" not in one.id
        assert store.begin("two", {"PROLIFIC_PID": "5f00"}) == "known"
        assert "5f00" not in str(store.participants())


def test_a_key_of_a_browser_is_not_in_the_file(make_study: MakeStudy) -> None:
    study = make_study()
    with open_store(study) as store:
        begin(store, "browser-key-4711")
        assert b"browser-key-4711" not in bytes_of(study.data_folder())


def test_withdrawal_leaves_nothing_in_the_bytes_of_the_files(
    make_study: MakeStudy, tmp_path: Path
) -> None:
    study = make_study()
    with open_store(study) as store:
        kept = begin(store, "other", PROLIFIC_PID="pid-kept").id
        store.add_answer(kept, "tell.R1", "SECRET-KEPT " * 20)
        gone = begin(store, "browser", PROLIFIC_PID="pid-gone").id
        for number in range(50):
            store.keep_draft(gone, "tell.R1", f"SECRET-DRAFT-{number} " * number)
        store.add_answer(gone, "tell.R1", "SECRET-ANSWER " * 500)
        store.add_event(gone, "tell.R1", "SECRET-EVENT")
        (store.folder / RECORDINGS).mkdir()
        (store.folder / RECORDINGS / f"{gone}-tell.webm").write_bytes(b"SECRET-VOICE")
        store.add_export(tmp_path / "first.jsonl", [kept, gone])
        store.add_export(tmp_path / "second.jsonl", [kept])
        assert b"SECRET-ANSWER" in bytes_of(study.data_folder())
        withdrawal = store.withdraw(gone)
        for _ in range(2):
            left = bytes_of(study.data_folder())
            for secret in ("DRAFT", "ANSWER", "EVENT", "VOICE"):
                assert f"SECRET-{secret}".encode() not in left
            assert gone.encode() not in left
            assert b"pid-gone" not in left
            assert b"SECRET-KEPT" in left
        assert withdrawal.exports == (str(tmp_path / "first.jsonl"),)
        assert store.withdrawals() == [withdrawal]
        with pytest.raises(StudyError, match="there is no participant"):
            store.withdraw(gone)
    assert b"SECRET-ANSWER" not in bytes_of(study.data_folder())


def test_a_second_server_on_the_same_file_is_refused(make_study: MakeStudy) -> None:
    study = make_study()
    with (
        open_store(study),
        pytest.raises(StudyError, match=f"by the process {os.getpid()}; end that"),
        open_store(study),
    ):
        pass
    with open_store(study):
        pass


def test_an_export_can_read_while_pages_are_served(make_study: MakeStudy) -> None:
    study = make_study()
    with (
        pytest.raises(StudyError, match="no answers yet"),
        open_store(study, alone=False),
    ):
        pass
    with open_store(study) as served:
        one = begin(served, "browser").id
        with open_store(study, alone=False) as reading:
            assert [each.id for each in reading.participants()] == [one]
            reading.add_export(Path("x.jsonl"), [one])
        assert len(served.exports()) == 1


def test_answers_survive_a_process_that_is_killed(
    make_study: MakeStudy, tmp_path: Path
) -> None:
    study = make_study()
    program = (
        "import os, signal, sys\n"
        "from memorymaze.web.studies.store import open_store\n"
        "from memorymaze.web.studies.study_file import load_study\n"
        "with open_store(load_study(sys.argv[1])) as store:\n"
        "    one = store.begin('browser').id\n"
        "    for number in range(30):\n"
        "        store.add_answer(one, f'step.{number}', 'x' * 1000)\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", program, str(study.path)])
    assert done.returncode == -9
    with open_store(study) as store:
        [one] = store.participants()
        assert len(store.answers(one.id)) == 30


def test_many_threads_write_at_once(make_study: MakeStudy) -> None:
    with open_store(make_study()) as store:
        names = [begin(store, f"browser {number}").id for number in range(8)]

        def write(name: str) -> None:
            for number in range(20):
                store.keep_draft(name, "tell.R1", f"draft {number}")
                store.add_answer(name, f"step.{number}", name)

        threads = [threading.Thread(target=write, args=[name]) for name in names]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for name in names:
            texts = [answer.text for answer in store.answers(name).values()]
            assert texts == [name] * 20


def test_texts_may_change_while_a_study_runs_but_not_its_routes(
    make_study: MakeStudy,
) -> None:
    study = make_study()
    with open_store(study) as store:
        begin(store, "browser")
    changed = study.text.replace("least_words = 10", "least_words = 5")
    study.path.write_text(changed, encoding="utf-8")
    with open_store(load_study(study.path)) as store:
        assert len(store.participants()) == 1
    without_route = changed.replace('[[routes]]\nroute = "R2"\n', "")
    later_check = changed.replace("after_route = 1", "after_route = 2")
    for other, said in (
        (without_route, "expected the orders 'R1, R2; R2, R1'"),
        (later_check, "expected the attention checks after"),
    ):
        study.path.write_text(other, encoding="utf-8")
        with (
            pytest.raises(StudyError, match=said),
            open_store(load_study(study.path)),
        ):
            pass


def test_a_damaged_file_is_named(make_study: MakeStudy) -> None:
    study = make_study()
    study.data_folder().mkdir()
    (study.data_folder() / FILE).write_bytes(b"no database" * 200)
    with pytest.raises(StudyError, match=f"{FILE}: cannot be used"), open_store(study):
        pass


def test_every_commit_waits_for_the_disk(make_study: MakeStudy) -> None:
    with open_store(make_study()) as store:
        settings = store._connection.execute
        assert settings("PRAGMA journal_mode").fetchone() == ("wal",)
        assert settings("PRAGMA synchronous").fetchone() == (2,)
        assert settings("PRAGMA secure_delete").fetchone() == (1,)
