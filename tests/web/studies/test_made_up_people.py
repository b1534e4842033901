import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.web.studies.made_up_people import let_take_part

from memorymaze.runs.work.run_folder import read_run
from memorymaze.texts.corpus import load_instructions
from memorymaze.web.studies.exporting import export_study
from memorymaze.web.studies.follow.runs import export_walks
from memorymaze.web.studies.store import open_store
from memorymaze.web.studies.study_file import Study
from memorymaze.web.studies.tellings import StudyTellings

MakeStudy = Callable[..., Study]


@pytest.mark.parametrize("kind", ["online", "memory"])
def test_participants_fill_a_study_and_all_they_tell_is_exported(
    make_study: MakeStudy, tmp_path: Path, kind: str
) -> None:
    study = make_study(kind, "quota = 2")
    ends = let_take_part(study, 7, 1)
    assert ends.total() == 7
    assert ends["finished"] >= 3
    assert ends["full"] >= 1
    with open_store(study) as store:
        states = Counter(each.state for each in store.participants())
        assert states["complete"] == ends["finished"]
        export_study(study, store, tmp_path / "made.jsonl")
    made = load_instructions([tmp_path / "made.jsonl"])
    assert {(each.source, each.study) for each in made} == {("human", kind)}
    assert len(made) == 4 * ends["finished"]
    assert len({each.text for each in made}) > len(made) / 2


@pytest.mark.proof
def test_walks_are_exported_as_a_run_of_people(
    make_study: MakeStudy, tiny_instructions: Path, tmp_path: Path
) -> None:
    texts = f"instructions = [{json.dumps(str(tiny_instructions))}]"
    study = make_study("follow", "quota = 2", texts)
    ends = let_take_part(study, 2, 3)
    assert ends["finished"] == 2
    with open_store(study) as store:
        done = export_walks(study, store, tmp_path / "walks")
    assert done.walks == 4
    _, results = read_run(done.folders[0])
    assert {each.agent for each in results} == {"people"}
    assert all(each.path_length > 1 for each in results)


@pytest.mark.proof
def test_made_up_interviews_are_recorded_or_typed_and_labelled(
    make_study: MakeStudy, tmp_path: Path
) -> None:
    study = make_study("onsite", "quota = 3")
    ends = let_take_part(study, 4, 1)
    assert ends.total() == 4
    assert ends["finished"] >= 2
    with open_store(study) as store:
        export_study(study, store, tmp_path / "made.jsonl")
        told = StudyTellings(store)
        voices = [told.path_of(each).read_bytes() for each in told.recordings()]
    made = load_instructions([tmp_path / "made.jsonl"])
    assert {(each.source, each.study) for each in made} == {("human", "onsite")}
    assert len(made) == 4 * ends["finished"]
    assert 0 < len(voices) < len(made)
    assert all(each.startswith(b"RIFF of: ") for each in voices)
    assert any(each.failures for each in made)
