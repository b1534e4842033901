import gzip
import math
from pathlib import Path

import numpy as np
import pytest

from memorymaze.errors import RunFolderError
from memorymaze.evaluation import trace
from memorymaze.evaluation.trace import (
    keep_trace,
    read_trace,
    trace_content,
    trace_path,
)
from memorymaze.geometry.pose import Pose
from memorymaze.robot.api import Detection


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "traces").mkdir()
    return tmp_path


def test_entries_come_back_as_json_knows_them(folder: Path) -> None:
    seen = Detection("door", (0, 0, 1, 1), 0.5, 2.0, -3.0, 1)
    entry = {
        "pose": Pose(1.0, 2.0, 0.5),
        "seen": [seen],
        "array": np.array([[1, 2]]),
        "number": np.float64(0.5),
        "nan": math.nan,
        "names": {"b", "a"},
        "odd": {3: b"x", "type": int},
        "text": "左\ud800",
    }
    keep_trace(folder, "a-1", trace_content([entry, {"kind": "end"}]))
    first, second = read_trace(folder, "a-1")
    assert second == {"kind": "end"}
    assert first["pose"] == [1.0, 2.0, 0.5]
    assert first["seen"][0]["label"] == "door"
    assert (first["array"], first["number"]) == ([[1, 2]], 0.5)
    assert (first["nan"], first["names"]) == ("nan", ["a", "b"])
    assert first["odd"] == {"3": "b'x'", "type": "<class 'int'>"}
    assert first["text"] == "左\ud800"


class Undescribed:
    def __repr__(self) -> str:
        raise RuntimeError("no words")


def test_circles_depths_and_things_without_words_are_written_as_far_as_they_go(
    folder: Path,
) -> None:
    circle: dict[str, object] = {}
    circle["again"] = circle
    deep: list[object] = []
    for _ in range(3000):
        deep = [deep]
    keep_trace(
        folder,
        "a",
        trace_content([{"circle": circle}, {"deep": deep}, {"x": Undescribed()}]),
    )
    first, second, third = read_trace(folder, "a")
    assert "dict nested too deep" in str(first)
    assert "list nested too deep" in str(second)
    assert third == {"x": "<Undescribed without a description: RuntimeError>"}


def test_equal_entries_give_equal_bytes(folder: Path) -> None:
    keep_trace(folder, "a", trace_content([{"x": 1}]))
    keep_trace(folder, "b", trace_content([{"x": 1}]))
    assert trace_path(folder, "a").read_bytes() == trace_path(folder, "b").read_bytes()


@pytest.mark.parametrize("name", ["../../etc/x", "a/b", ".", "é" * 300, "a" * 400])
def test_any_episode_id_makes_a_file_inside_the_folder(folder: Path, name: str) -> None:
    keep_trace(folder, name, trace_content([{"id": name}]))
    assert [entry["id"] for entry in read_trace(folder, name)] == [name]
    assert trace_path(folder, name).parent == folder / "traces"


def test_long_ids_that_begin_alike_have_files_of_their_own(folder: Path) -> None:
    assert trace_path(folder, "a" * 200) != trace_path(folder, "a" * 201)


def test_a_missing_trace_is_named(folder: Path) -> None:
    with pytest.raises(RunFolderError, match="trace of episode 'none'"):
        list(read_trace(folder, "none"))


def packed(text: bytes) -> bytes:
    return gzip.compress(text, mtime=0)


@pytest.mark.parametrize(
    "content",
    [
        pytest.param(packed(b'{"x": 1}')[:-9], id="cut off"),
        pytest.param(packed(b'{"x": 1}')[:12] + b"\xff" * 20, id="flipped bytes"),
        pytest.param(packed(b"[" * 99_999), id="nested too deep"),
        pytest.param(packed(b"\xff\n"), id="no text"),
        pytest.param(packed(b'{"x": 1\n'), id="no json"),
        pytest.param(b"x", id="no gzip"),
    ],
)
def test_a_damaged_trace_is_named_with_its_episode(
    folder: Path, content: bytes
) -> None:
    trace_path(folder, "a").write_bytes(content)
    with pytest.raises(RunFolderError, match="episode 'a' is damaged") as caught:
        list(read_trace(folder, "a"))
    assert str(trace_path(folder, "a")) in str(caught.value)


def test_a_trace_that_unpacks_to_far_too_much_is_named_and_not_read(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trace, "LARGEST_TRACE", 2**20)
    keep_trace(folder, "a", trace_content([{"x": " " * (2**20 - 20)}]))
    assert len(list(read_trace(folder, "a"))) == 1
    keep_trace(folder, "a", trace_content([{"x": 1}, {"x": " " * 2**20}]))
    with pytest.raises(
        RunFolderError, match=r"damaged \(unpacked it has more than 1 M"
    ):
        next(read_trace(folder, "a"))


@pytest.mark.parametrize("place", range(10, 40))
def test_no_flipped_byte_ends_in_another_error(folder: Path, place: int) -> None:
    keep_trace(
        folder, "a", trace_content([{"x": [1, 2, 3], "text": "left at the door"}])
    )
    content = bytearray(trace_path(folder, "a").read_bytes())
    content[place] ^= 0xFF
    trace_path(folder, "a").write_bytes(bytes(content))
    with pytest.raises(RunFolderError):
        list(read_trace(folder, "a"))
