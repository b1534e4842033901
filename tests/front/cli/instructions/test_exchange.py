from collections.abc import Callable
from pathlib import Path
from typing import Any

Memorymaze = Callable[..., Any]


def test_a_folder_for_hubs_is_of_the_shipped_texts_alone(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    command = ("instructions", "export", "--format", "hub", "--out", tmp_path / "hub")
    said = memorymaze(*command)
    assert said.code == 0
    assert f"{tmp_path / 'hub' / 'README.md'}\n" in said.out
    said = memorymaze(*command, tmp_path / "mine.jsonl")
    assert said.code == 2
    assert "write yours with --format parquet" in said.err
