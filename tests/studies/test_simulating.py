import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.errors import StudyError
from memorymaze.evaluation.run_folder import read_run
from memorymaze.instructions import load_instructions
from memorymaze.studies.exporting import export_study
from memorymaze.studies.follow.runs import export_walks
from memorymaze.studies.simulating import simulate_study
from memorymaze.studies.store import open_store
from memorymaze.studies.study_file import Study
from memorymaze.studies.tellings import Tellings

MakeStudy = Callable[..., Study]


@pytest.mark.parametrize("kind", ["online", "memory"])
def test_made_up_participants_fill_a_study_and_are_labelled(
    make_study: MakeStudy, tmp_path: Path, kind: str
) -> None:
    study = make_study(kind, "quota = 2")
    told: list[tuple[int, int]] = []
    ends = simulate_study(study, 7, 1, lambda *at: told.append(at))
    assert told[-1] == (7, 7)
    assert ends.total() == 7
    assert ends["finished"] >= 3
    assert ends["full"] >= 1
    with open_store(study, simulated=True) as store:
        states = Counter(each.state for each in store.participants())
        assert states["complete"] == ends["finished"]
        export_study(study, store, tmp_path / "made.jsonl")
    made = load_instructions([tmp_path / "made.jsonl"])
    assert {(each.source, each.study) for each in made} == {("synthetic", kind)}
    assert len(made) == 4 * ends["finished"]
    assert len({each.text for each in made}) > len(made) / 2
    assert not study.data_folder().exists()


def test_a_simulation_takes_the_place_of_the_one_before(make_study: MakeStudy) -> None:
    study = make_study()
    for _ in range(2):
        simulate_study(study, 2, 0, lambda *_: None)
    with open_store(study, simulated=True) as store:
        assert len(store.participants()) == 2
        with pytest.raises(StudyError, match="being written already"):
            simulate_study(study, 2, 0, lambda *_: None)


def test_made_up_walks_do_not_pass_for_those_of_people(
    make_study: MakeStudy, tiny_instructions: Path, tmp_path: Path
) -> None:
    texts = f"instructions = [{json.dumps(str(tiny_instructions))}]"
    study = make_study("follow", "quota = 2", texts)
    ends = simulate_study(study, 2, 3, lambda *at: None)
    assert ends["finished"] == 2
    with open_store(study, simulated=True) as store:
        done = export_walks(study, store, tmp_path / "walks")
    assert done.walks == 4
    _, results = read_run(done.folders[0])
    assert {each.agent for each in results} == {"made-up people"}
    assert all(each.path_length > 1 for each in results)


@pytest.mark.parametrize("speaks", [True, False], ids=["spoken", "typed"])
def test_made_up_interviews_are_spoken_where_a_speaker_is_installed(
    make_study: MakeStudy,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    speaks: bool,
) -> None:
    speaker = tmp_path / "bin" / "espeak-ng"
    speaker.parent.mkdir()
    monkeypatch.setenv("PATH", f"{speaker.parent}:/usr/bin:/bin" if speaks else "")
    if speaks:
        speaker.write_text("#!/bin/sh\nprintf 'RIFF of: '; cat\n", encoding="utf-8")
        speaker.chmod(0o755)
    study = make_study("onsite", "quota = 3")
    ends = simulate_study(study, 4, 1, lambda *_: None)
    assert ends.total() == 4
    assert ends["finished"] >= 1
    with open_store(study, simulated=True) as store:
        export_study(study, store, tmp_path / "made.jsonl")
        told = Tellings(store)
        voices = {each.step: told.path_of(each) for each in told.recordings()}
        if speaks:
            assert voices["tell.R1"].read_bytes().startswith(b"RIFF of: ")
        else:
            assert not voices
    made = load_instructions([tmp_path / "made.jsonl"])
    assert {(each.source, each.study) for each in made} == {("synthetic", "onsite")}
    assert len(made) == 4 * ends["finished"]
    assert any(each.failures for each in made)
