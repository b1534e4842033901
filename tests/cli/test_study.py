from collections.abc import Callable
from pathlib import Path
from typing import Any

Memorymaze = Callable[..., Any]


def test_a_new_study_says_what_to_type_next(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    said = memorymaze("study", "new", path, "--site", "museum_5f", "--kind", "memory")
    assert said.code == 0
    assert f"memorymaze study serve {path}" in said.out
    assert 'kind = "memory"' in path.read_text(encoding="utf-8")
    again = memorymaze("study", "new", path, "--site", "museum_5f")
    assert again.code == 2
    assert "exists already" in again.err
