from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.frames import episode_frame
from memorymaze.evaluation.results import EpisodeResult

Make = Callable[..., EpisodeResult]
Write = Callable[..., Path]


def test_runs_stand_below_each_other_with_typed_columns(
    write: Write, result: Make
) -> None:
    folders = [
        write("first", [result("a-1"), result("b-1", success=False)]),
        write("second", [result("a-1", spd=7.5)]),
    ]
    frame = episode_frame(folders)
    assert frame["run"].tolist() == ["first", "first", "second"]
    assert frame.groupby("run")["success"].mean().to_dict() == {
        "first": 0.5,
        "second": 1.0,
    }
    assert frame["spd"].dtype.kind == "f"
    assert frame["success"].dtype.kind == "b"
    assert frame["model_calls"].dtype.kind == "i"


def test_a_folder_that_is_no_run_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RunFolderError, match="expected a run folder"):
        episode_frame([tmp_path])
