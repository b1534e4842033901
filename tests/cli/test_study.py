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


def test_a_study_without_pages_is_refused_before_anything_is_made(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    memorymaze("study", "new", path, "--site", "museum_5f", "--kind", "onsite")
    said = memorymaze("study", "serve", path)
    assert said.code == 1
    assert "expected the kind online or memory" in said.err
    assert not list(tmp_path.glob("mine.films"))
