"""What a model once said can be had again without the model."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.basics.errors import (
    AnswerFileError,
    LanguageModelError,
    RecordedAnswersWarning,
    SettingsError,
)
from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.language.models.answers import (
    AboutInstruction,
    RecordingModel,
    ReplayingModel,
)
from memorymaze.language.models.kept_answers import request_key
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    Message,
    ModelQuestion,
    Picture,
    Usage,
)
from memorymaze.language.models.scripted_model import ScriptedLanguageModel

PNG = Picture(b"\x89PNG\r\n\x1a\n one", "image/png")
OTHER_PNG = Picture(b"\x89PNG\r\n\x1a\n two", "image/png")
REQUEST = CompletionRequest((Message("system", "Be brief."), Message("user", "Go.")))


@pytest.fixture
def store(tmp_path: Path) -> Path:
    return tmp_path / "replies #1.jsonl"


def test_a_recorded_run_replays_without_a_model(store: Path):
    asked = [REQUEST, replace(REQUEST, temperature=0.7), replace(REQUEST, seed=3)]
    recording = RecordingModel(ScriptedLanguageModel(["one", "zwei ü", "three"]), store)
    said = [recording.complete(request) for request in asked]

    replaying = ReplayingModel(store, name="scripted")

    assert [completion.text for completion in said] == ["one", "zwei ü", "three"]
    assert [replaying.complete(request) for request in reversed(asked)] == said[::-1]
    assert replaying.name == recording.name == ReplayingModel(store).name == "scripted"
    with pytest.raises(LanguageModelError, match="no reply of scripted is recorded"):
        replaying.complete(replace(REQUEST, max_tokens=5))


def test_what_is_kept_by_whatever_process_is_not_asked_again(store: Path):
    model = ScriptedLanguageModel(["once"])
    one, other = RecordingModel(model, store), RecordingModel(model, store)

    assert one.complete(REQUEST) == one.complete(REQUEST) == other.complete(REQUEST)
    assert RecordingModel(model, store).complete(REQUEST).text == "once"
    assert len(model.requests) == 1


@pytest.mark.parametrize(
    "other",
    [
        replace(REQUEST, messages=REQUEST.messages[::-1]),
        replace(REQUEST, messages=(*REQUEST.messages, Message("assistant", ""))),
        replace(REQUEST, temperature=0.1),
        replace(REQUEST, max_tokens=1),
        replace(REQUEST, seed=0),
        replace(
            REQUEST, messages=(REQUEST.messages[0], Message("user", "Go.", (PNG,)))
        ),
    ],
    ids=["order", "one more", "temperature", "length", "seed", "picture"],
)
def test_all_of_a_request_is_in_its_key(other: CompletionRequest):
    assert request_key("m", other) != request_key("m", REQUEST)
    assert request_key("n", REQUEST) != request_key("m", REQUEST)
    assert request_key("m", REQUEST) == request_key("m", replace(REQUEST))


def test_a_request_of_text_keeps_the_key_it_always_had():
    assert request_key("m", REQUEST) == (
        "1b66a359a68cad78c1d5b4cc01e4a8c8f25a3cb317234839ca904669662f6db0"
    )


@pytest.mark.parametrize("held", [True, False])
def test_replies_held_to_a_grammar_and_free_ones_are_both_replayed(
    store: Path, held: bool
):
    model = ScriptedLanguageModel(["left"])
    request = replace(REQUEST, grammar="root ::= [a-z]+")
    asked, again = (request, REQUEST) if held else (REQUEST, request)
    said = RecordingModel(model, store).complete(asked)

    assert model.requests[0].grammar == asked.grammar
    assert ReplayingModel(store).complete(again) == said


def test_pictures_are_told_apart_and_replies_to_them_replayed(store: Path):
    asked = [
        CompletionRequest((Message("user", "What is this?", pictures),))
        for pictures in ((PNG,), (OTHER_PNG,), (PNG, OTHER_PNG), (OTHER_PNG, PNG))
    ]
    recording = RecordingModel(ScriptedLanguageModel(["1", "2", "3", "4"]), store)
    said = [recording.complete(request) for request in asked]

    replaying = ReplayingModel(store)
    assert [replaying.complete(request) for request in asked] == said
    assert [completion.text for completion in said] == ["1", "2", "3", "4"]


def test_failures_are_not_recorded(store: Path):
    recording = RecordingModel(ScriptedLanguageModel([]), store)

    with pytest.raises(LanguageModelError, match="was asked 1 times"):
        recording.complete(REQUEST)
    with pytest.raises(SettingsError, match="got replies of none"):
        ReplayingModel(store)


def test_replaying_names_the_models_there_are(store: Path):
    for name in ("m-1", "m-2"):
        model = ScriptedLanguageModel([name], name=name)
        RecordingModel(model, store).complete(REQUEST)

    with pytest.raises(SettingsError, match="replies of m-3, got replies of m-1, m-2"):
        ReplayingModel(store, name="m-3")
    with pytest.raises(SettingsError, match="of a single model, got replies of m-1"):
        ReplayingModel(store)
    assert ReplayingModel(store, name="m-2").complete(REQUEST).text == "m-2"


def test_a_missing_file_is_said_and_not_made(store: Path):
    with pytest.raises(SettingsError, match="there are no recorded replies here"):
        ReplayingModel(store, name="scripted")

    assert not store.exists()


@pytest.mark.parametrize("text", ["my diary", "a diary\nof two days\n"])
def test_another_file_is_said_and_left_alone(store: Path, text: str):
    store.write_text(text, encoding="utf-8")

    with pytest.raises(AnswerFileError, match=":1: expected JSON"):
        ReplayingModel(store, name="scripted")
    with pytest.raises(AnswerFileError, match=":1: expected JSON"):
        RecordingModel(ScriptedLanguageModel(["x"]), store)

    assert store.read_text(encoding="utf-8") == text


def test_a_folder_that_is_not_there_is_said(tmp_path: Path):
    with pytest.raises(SettingsError, match="expected a place for a file"):
        RecordingModel(ScriptedLanguageModel(["x"]), tmp_path / "no" / "r.jsonl")


def test_a_damaged_line_is_told_with_its_place(store: Path):
    RecordingModel(ScriptedLanguageModel(["x"]), store).complete(REQUEST)
    with store.open("a", encoding="utf-8") as file:
        file.write('{"key": "a", "reply": 1}\n')

    with pytest.raises(AnswerFileError, match=":2: field 'reply': expected"):
        ReplayingModel(store, name="scripted")


def test_a_file_that_may_only_be_read_replays(store: Path):
    RecordingModel(ScriptedLanguageModel(["x"]), store).complete(REQUEST)
    store.chmod(0o444)

    assert ReplayingModel(store, name="scripted").complete(REQUEST).text == "x"
    assert [path.name for path in store.parent.iterdir()] == [store.name]


def test_several_processes_record_into_one_file(store: Path):
    script = """
import sys
from memorymaze.language.models.model import CompletionRequest, Message
from memorymaze.language.models.answers import RecordingModel
from memorymaze.language.models.scripted_model import ScriptedLanguageModel

me, path = sys.argv[1:]
recording = RecordingModel(ScriptedLanguageModel(lambda request: me), path)
for number in range(25):
    request = CompletionRequest((Message("user", f"question {number}"),))
    print(recording.complete(request).text)
"""
    running = [
        subprocess.Popen(
            [sys.executable, "-c", script, name, str(store)],
            stdout=subprocess.PIPE,
            text=True,
        )
        for name in "abc"
    ]
    said = [process.communicate(timeout=60)[0].split() for process in running]

    assert [process.returncode for process in running] == [0, 0, 0]
    assert len(said[0]) == 25
    assert said[0] == said[1] == said[2]


def shown(data: bytes, name: str | None) -> CompletionRequest:
    picture = Picture(b"\xff\xd8\xff" + data, "image/jpeg", name)
    return CompletionRequest((Message("user", "Where to?", (picture,)),))


def test_pictures_drawn_otherwise_are_found_by_their_names_and_that_is_said(
    store: Path,
):
    recording = RecordingModel(ScriptedLanguageModel(["left", "right"]), store)
    recording.complete(shown(b"here", "step 1"))
    recording.complete(shown(b"there", "step 2"))
    replaying = ReplayingModel(store)

    with pytest.warns(RecordedAnswersWarning, match="differ from those"):
        assert replaying.complete(shown(b"h3re", "step 1")).text == "left"
    assert replaying.complete(shown(b"th3re", "step 2")).text == "right"  # said once


def test_other_pictures_of_one_name_are_recorded_anew_and_not_guessed_at(store: Path):
    recording = RecordingModel(ScriptedLanguageModel(["left", "right"]), store)
    assert recording.complete(shown(b"empty hall", "step 1")).text == "left"
    assert recording.complete(shown(b"full hall", "step 1")).text == "right"
    replaying = ReplayingModel(store)

    assert replaying.complete(shown(b"full hall", "step 1")).text == "right"
    for name in ("step 1", "step 2", None):
        with pytest.raises(LanguageModelError, match="no reply"):
            replaying.complete(shown(b"dark hall", name))


def asked(text: str, prompt: str, number: int = 1) -> CompletionRequest:
    question = ModelQuestion("step", prompt, number)
    return CompletionRequest((Message("user", text),), question=question)


def test_a_mended_prompt_finds_the_answers_to_the_one_before(store: Path):
    recording = RecordingModel(ScriptedLanguageModel(["left", "right"]), store)
    about = AboutInstruction(recording, "p1-1")
    about.complete(asked("You are here.", "v1", 1))
    about.complete(asked("You are there.", "v1", 2))
    replaying = AboutInstruction(ReplayingModel(store), "p1-1")

    assert replaying.complete(asked("You stand here.", "v2", 1)).text == "left"
    assert replaying.complete(asked("You stand there.", "v2", 2)).text == "right"
    with pytest.raises(LanguageModelError, match="step number 3 of 'p1-1'"):
        replaying.complete(asked("You stand there.", "v2", 3))
    with pytest.raises(LanguageModelError, match="step of 'p2-1'"):
        AboutInstruction(ReplayingModel(store), "p2-1").complete(asked("x", "v2"))
    assert ReplayingModel(store).versions() == {("p1-1", "step"): {"v1"}}


def test_of_several_answers_to_an_older_prompt_none_is_guessed_at(store: Path):
    recording = RecordingModel(ScriptedLanguageModel(["left", "right"]), store)
    about = AboutInstruction(recording, "p1-1")
    about.complete(asked("Facing north.", "v1"))
    about.complete(asked("Facing south.", "v1"))
    replaying = AboutInstruction(ReplayingModel(store), "p1-1")

    assert replaying.complete(asked("Facing south.", "v1")).text == "right"
    # Nor to another request of the same prompt.
    for told, prompt in (("You face south.", "v2"), ("You are elsewhere.", "v1")):
        with pytest.raises(LanguageModelError, match="differs from what was asked"):
            replaying.complete(asked(told, prompt))


def test_requests_kept_for_somebody_else_are_answered_once(store: Path):
    answers = AnswerFile(store, make=True)
    request = asked("You are here.", "v1")
    identifier = answers.ask("m", request)
    said = Completion("left", "m-2026", Usage(10, 1), 0.0)
    with pytest.raises(LanguageModelError, match="no reply of m"):
        ReplayingModel(store).complete(request)

    answers.answer(identifier, said)
    answers.answer(identifier, said)

    assert ReplayingModel(store).complete(request) == said
    with pytest.raises(ValueError, match="has another answer"):
        answers.answer(identifier, replace(said, text="right"))
    with pytest.raises(ValueError, match="has not asked 'step/p1-1/abc'"):
        answers.answer("step/p1-1/abc", said)


def test_of_a_crash_in_the_middle_of_a_line_the_other_answers_stay(store: Path):
    model = ScriptedLanguageModel(["one", "two", "two again"])
    other = replace(REQUEST, seed=3)
    recording = RecordingModel(model, store)
    recording.complete(REQUEST)
    whole = store.stat().st_size
    recording.complete(other)
    content = store.read_bytes()

    for end in range(whole + 1, len(content) - 1):
        store.write_bytes(content[:end])
        with pytest.warns(RecordedAnswersWarning, match=":2: .* broken off"):
            replaying = ReplayingModel(store)
        assert replaying.complete(REQUEST).text == "one"
        with pytest.raises(LanguageModelError, match="no reply"):
            replaying.complete(other)
    with pytest.warns(RecordedAnswersWarning, match="broken off"):
        again = RecordingModel(model, store)
    assert again.complete(other).text == "two again"
    lines = store.read_text(encoding="utf-8").splitlines()
    assert [json.loads(line)["reply"] for line in lines] == ["one", "two again"]


def test_answers_are_added_to_a_file_by_hand_without_a_last_line_end(store: Path):
    by_hand = {"instruction_id": "p1-1", "stage": "step", "reply": "left"}
    store.write_text(json.dumps(by_hand), encoding="utf-8")

    RecordingModel(ScriptedLanguageModel(["go"]), store).complete(REQUEST)

    replaying = ReplayingModel(store)
    assert replaying.complete(REQUEST).text == "go"
    question = AboutInstruction(replaying, "p1-1").complete(asked("x", "v1"))
    assert (question.text, question.inferred) == ("left", False)


def test_files_of_several_machines_are_one_after_another_one(
    store: Path, tmp_path: Path
):
    for machine in ("one", "other"):
        model = ScriptedLanguageModel(lambda _, machine=machine: machine, name="m")
        recording = RecordingModel(model, tmp_path / machine)
        recording.complete(REQUEST)
        recording.complete(asked(machine, "v1"))
        AboutInstruction(recording, "p1-1").complete(asked("Here.", "v1"))
    parts = [(tmp_path / machine).read_bytes() for machine in ("one", "other")]
    store.write_bytes(b"".join(parts))

    replaying = ReplayingModel(store)
    assert replaying.complete(REQUEST).text == "one"
    assert replaying.complete(asked("other", "v1")).text == "other"
    # The first counts under another version of the prompt too.
    about = AboutInstruction(replaying, "p1-1")
    for told, prompt in (("Here.", "v1"), ("You are here.", "v2")):
        assert about.complete(asked(told, prompt)).text == "one"
