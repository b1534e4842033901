import gzip
from pathlib import Path

import pytest

from memorymaze.basics import input_files
from memorymaze.basics.errors import CaseFileError
from memorymaze.basics.input_files import parse_json, read_file, read_text


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        pytest.param("none", "No such file", id="missing"),
        pytest.param("", "Is a directory", id="folder"),
        pytest.param("a\0b", "null", id="no name"),
    ],
)
def test_what_cannot_be_read_is_refused_with_the_reason(
    name: str, reason: str, tmp_path: Path
) -> None:
    with pytest.raises(CaseFileError, match=f"cannot be read.*{reason}"):
        read_file(f"{tmp_path}/{name}", CaseFileError)


def test_an_endless_device_is_not_read_to_its_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(input_files, "LARGEST_FILE", 2**20)
    with pytest.raises(
        CaseFileError, match="/dev/zero: expected a file of at most 1 MiB"
    ):
        read_file("/dev/zero", CaseFileError)


def test_a_packed_file_is_unpacked_but_not_without_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "text.gz"
    path.write_bytes(gzip.compress(b"left"))
    assert read_file(path, CaseFileError) == b"left"
    path.write_bytes(gzip.compress(bytes(2**21)))
    monkeypatch.setattr(input_files, "LARGEST_FILE", 2**20)
    with pytest.raises(CaseFileError, match="at most 1 MiB"):
        read_file(path, CaseFileError)
    path.write_bytes(b"not packed")
    with pytest.raises(CaseFileError, match="cannot be read"):
        read_file(path, CaseFileError)


def test_text_is_utf_8_with_or_without_a_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "text"
    path.write_text("left", encoding="utf-8-sig")
    assert read_text(path, CaseFileError) == "left"
    path.write_bytes(b"caf\xe9")
    with pytest.raises(CaseFileError, match="byte 0xe9 at offset 3; save the file"):
        read_text(path, CaseFileError)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        pytest.param('{"a": 1,}', "mistake in column", id="comma"),
        pytest.param('{"a": 1,\n2}', "mistake in line 2, column 1", id="second line"),
        pytest.param('[{"a": 1, "a": 1}]', "field 'a': expected it once", id="twice"),
        pytest.param("[" * 99_999, "nested too deep", id="deep"),
        pytest.param("1" * 5000, "digits", id="digits"),
    ],
)
def test_what_is_wrong_with_json_is_said_in_a_line(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=said) as caught:
        parse_json(text)
    assert "\n" not in str(caught.value)
