"""Runs whose cameras show models of a user's own."""

from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.runs.episodes.in_words import sense_notes
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.work.ray_workers import pack_files
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder

Plan = Callable[..., RunPlan]


@pytest.fixture
def things(tmp_path: Path) -> Path:
    """The models that come with the package, as a file of one's own."""
    path = tmp_path / "my_things.glb"
    ours = files("memorymaze.world.looks") / "data" / "things.glb"
    path.write_bytes(ours.read_bytes())
    return path


def test_the_file_is_kept_by_its_content_and_told(
    things: Path, tiny_plan: Plan
) -> None:
    kept = tiny_plan("stop", signs="ocr", looks=str(things)).settings
    assert [stamp.name for stamp in kept.looks_files] == ["my_things.glb"]
    assert f"cameras show models of {things} (docs/seeing.md)" in [
        *sense_notes(kept, [])
    ]


def test_runs_without_cameras_keep_no_file(things: Path, tiny_plan: Plan) -> None:
    assert tiny_plan("stop", looks=str(things)).settings.looks_files == ()


def test_a_run_is_not_resumed_with_edited_models(
    tmp_path: Path, things: Path, record: RunRecord, tiny_plan: Plan
) -> None:
    given = {"signs": "ocr", "looks": str(things)}
    begun = replace(record, settings=tiny_plan("stop", **given).settings)
    with open_run_folder(tmp_path / "run", begun, resume=False):
        pass
    things.write_bytes(things.read_bytes() + bytes(8))
    edited = replace(record, settings=tiny_plan("stop", **given).settings)
    with (
        pytest.raises(RunFolderError, match=r"looks\.file my_things\.glb: '"),
        open_run_folder(tmp_path / "run", edited, resume=True),
    ):
        pass


def test_the_file_travels_to_other_machines(things: Path, tiny_plan: Plan) -> None:
    plan = tiny_plan("stop", signs="ocr", looks=str(things))
    assert pack_files(plan.settings) == {"looks/my_things.glb": things.read_bytes()}
