from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


@pytest.fixture
def walk(tiny_sites_folder: Path, tmp_path: Path) -> list[str | Path]:
    """Arguments of a walk on the T."""
    plan = tiny_sites_folder / "t_junction.geojson"
    return ["navigate", plan, "R1", "Go to the T and turn left.", "--out", tmp_path]


def test_without_a_terminal_the_calls_are_told_as_lines(
    memorymaze: Memorymaze, walk: list[str | Path], tmp_path: Path
) -> None:
    said = memorymaze(*walk, "--watch")
    assert said.code == 0, said.err
    assert "turn(left) → turned" in said.err
    assert said.out.splitlines()[0] == "arrived; stopped by agent"
    assert "turn(left)" not in said.out
    assert (tmp_path / "trace.jsonl").exists()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        pytest.param(["--pace", "1"], "with --watch", id="pace alone"),
        pytest.param(["--watch", "--pace", "0"], "--pace: expected", id="no pace"),
        pytest.param(["--watch", "--pace", "x"], "--pace", id="no number"),
        pytest.param(["--watch", "window"], "terminal", id="view"),
    ],
)
def test_wrong_usage_runs_nothing(
    memorymaze: Memorymaze,
    walk: list[str | Path],
    tmp_path: Path,
    options: list[str],
    said: str,
) -> None:
    done = memorymaze(*walk, *options)
    assert (done.code, done.out) == (2, "")
    assert said in done.err
    assert not any(tmp_path.iterdir())
