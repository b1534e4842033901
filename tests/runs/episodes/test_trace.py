import gzip
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from memorymaze.agents.notes import LeftOutNote
from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.control import Detection
from memorymaze.runs.episodes import trace
from memorymaze.runs.episodes.trace import (
    keep_trace,
    read_trace,
    trace_content,
    trace_lines,
    trace_path,
)
from memorymaze.runs.episodes.trace_entries import CallEntry, EndEntry, NoteEntry

END = EndEntry(2.0, "agent", None)


def noted(**told: Any) -> NoteEntry:
    return NoteEntry(1.0, "thought", told)


def read(folder: Path, name: str = "a") -> list[Mapping[str, Any]]:
    """Return what the notes of a trace tell."""
    entries = list(read_trace(folder, name))
    return [each.details for each in entries if isinstance(each, NoteEntry)]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "traces").mkdir()
    return tmp_path


def test_entries_come_back_as_json_knows_them(folder: Path) -> None:
    seen = Detection("door", (0, 0, 1, 1), 0.5, 2.0, -3.0, 1)
    entry: dict[str, Any] = {
        "pose": Pose(1.0, 2.0, 0.5),
        "seen": [seen],
        "array": np.array([[1, 2]]),
        "number": np.float64(0.5),
        "nan": math.nan,
        "names": {"b", "a"},
        "odd": {3: b"x", "type": int},
        "text": "左\ud800",
    }
    keep_trace(folder, "a-1", trace_content([noted(**entry), END]))
    note, end = read_trace(folder, "a-1")
    assert end == END
    assert isinstance(note, NoteEntry)
    first = note.details
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
    for _ in range(100_000):  # deeper than any Python can write
        deep = [deep]
    keep_trace(
        folder,
        "a",
        trace_content([noted(circle=circle), noted(deep=deep), noted(x=Undescribed())]),
    )
    first, second, third = read(folder)
    assert "dict nested too deep" in str(first)
    assert "list nested too deep" in str(second)
    assert third == {"x": "<Undescribed without a description: RuntimeError>"}


def test_equal_entries_give_equal_bytes(folder: Path) -> None:
    keep_trace(folder, "a", trace_content([noted(x=1)]))
    keep_trace(folder, "b", trace_content([noted(x=1)]))
    assert trace_path(folder, "a").read_bytes() == trace_path(folder, "b").read_bytes()


@pytest.mark.parametrize("name", ["../../etc/x", "a/b", ".", "é" * 300, "a" * 400])
def test_any_episode_id_makes_a_file_inside_the_folder(folder: Path, name: str) -> None:
    keep_trace(folder, name, trace_content([noted(id=name)]))
    assert [told["id"] for told in read(folder, name)] == [name]
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
    line = trace_lines([noted(x=" " * (2**19 - 60))])
    monkeypatch.setattr(trace, "LARGEST_TRACE", 2**20)
    keep_trace(folder, "a", packed(2 * line))
    assert len(list(read_trace(folder, "a"))) == 2
    keep_trace(folder, "a", packed(3 * line))
    with pytest.raises(
        RunFolderError, match=r"'a' is too long: expected at most 1 MiB unpacked"
    ):
        next(read_trace(folder, "a"))


def called(**arguments: Any) -> CallEntry:
    return CallEntry(2.0, (0.0, 0.0, 0.0), "say", arguments, None)


def test_of_a_note_or_call_that_is_too_long_stands_its_size(folder: Path) -> None:
    picture = [[0.5, 1.5, 2.5]] * 100_000
    long = [noted(picture=picture), called(text="é" * 2**19), noted(x=1)]
    keep_trace(folder, "a", trace_content([*long, END]))
    left_out, call, short, end = read_trace(folder, "a")
    assert isinstance(left_out, NoteEntry)
    assert isinstance(left_out.note, LeftOutNote)
    assert (left_out.note.what, left_out.note.entries) == ("note thought", 1)
    assert left_out.note.bytes > 1_200_000
    assert isinstance(call, CallEntry)
    assert (call.call, call.pose, call.arguments) == ("say", (0.0, 0.0, 0.0), {})
    assert call.result == {
        "left_out": f"{len(trace_lines([called(text='')])) + 2**20} bytes"
    }
    assert (short, end) == (long[2], END)


def test_what_is_written_of_very_many_notes_and_calls_can_be_read_again(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trace, "LARGEST_TRACE", 2**15)
    monkeypatch.setattr(trace, "LARGEST_ENTRY", 2**10)
    made = [noted(x=" " * 500), called(text="." * 400)] * 40
    keep_trace(folder, "a", trace_content([*made, END]))
    *read, end = read_trace(folder, "a")
    calls = [each for each in read if isinstance(each, CallEntry)]
    notes = [each for each in read if isinstance(each, NoteEntry)]
    whole = len(notes) - 1
    assert end == END
    assert 20 < whole < 40
    assert read[: 2 * whole - 1] == made[: 2 * whole - 1]
    assert notes[-1].details["entries"] == 40 - whole
    assert len(calls) == 40
    assert calls[-1].arguments == {}


@pytest.mark.parametrize("place", range(10, 40))
def test_no_flipped_byte_ends_in_another_error(folder: Path, place: int) -> None:
    keep_trace(
        folder, "a", trace_content([noted(x=[1, 2, 3], text="left at the door")])
    )
    content = bytearray(trace_path(folder, "a").read_bytes())
    content[place] ^= 0xFF
    trace_path(folder, "a").write_bytes(bytes(content))
    with pytest.raises(RunFolderError):
        list(read_trace(folder, "a"))


def walk(*poses: tuple[float, ...]) -> dict[str, Any]:
    columns = ["time", "x", "y", "heading"]
    return {"kind": "trajectory", "columns": columns, "poses": poses}


def look(distance: float, **more: Any) -> dict[str, Any]:
    seen = {"label": "door", "box": [0, 0, 9, 9], "score": 1.0, "track_id": 1}
    return {
        "kind": "call",
        "time": 1.0,
        "pose": [0.0, 0.0, 0.0],
        "call": "detect_from_RGB_image",
        "arguments": {"object": "door"},
        "result": [seen | {"distance": distance, "bearing_deg": 0.0} | more],
    }


@pytest.mark.parametrize(
    "entry",
    [
        pytest.param([1, 2], id="no object"),
        pytest.param({"no": "kind"}, id="no kind"),
        pytest.param({"kind": "party"}, id="another kind"),
        pytest.param(walk((0, 0, 0)), id="short pose"),
        pytest.param({"kind": "call"}, id="call without a name"),
        pytest.param(walk((0, math.nan, 0, 0)), id="not a number"),
        pytest.param(walk((0, 1e308, 0, 0)), id="beyond any drawing"),
        pytest.param(walk((0, 10**400, 0, 0)), id="beyond any number"),
        pytest.param(walk((1, 0, 0, 0), (0, 0, 0, 0)), id="back in time"),
        pytest.param(walk(), id="no pose"),
        pytest.param(
            {"kind": "people", "columns": [], "walks": {"p": [[]]}}, id="person nowhere"
        ),
        pytest.param(look(1e300), id="door at no distance"),
        pytest.param(look(1.0, box=[0]), id="door in no box"),
        pytest.param({"kind": "note", "time": "noon", "about": "x"}, id="at no time"),
    ],
)
def test_a_line_that_no_episode_leaves_is_named_and_refused(
    folder: Path, entry: Any
) -> None:
    good = b'{"kind":"note","time":1,"about":"x"}\n'
    trace_path(folder, "a").write_bytes(packed(good + json.dumps(entry).encode()))
    with pytest.raises(RunFolderError, match=r"a\.jsonl\.gz:2: expected an entry as"):
        list(read_trace(folder, "a"))


def test_a_note_that_has_names_of_the_entry_itself_leaves_these_as_they_are(
    folder: Path,
) -> None:
    own = NoteEntry(1.0, "seen", {"time": "noon", "kind": 3, "turning_point": 4})
    keep_trace(folder, "a", trace_content([own]))
    [entry] = read_trace(folder, "a")
    assert isinstance(entry, NoteEntry)
    assert (entry.time, entry.about) == (1.0, "seen")
    assert entry.details == {"time_": "noon", "kind_": 3, "turning_point": 4}
