import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_a_walk_leaves_trajectory_trace_and_picture(
    memorymaze: Memorymaze, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    plan = tiny_sites_folder / "loop.geojson"
    said = memorymaze(
        "navigate",
        plan,
        "route_r1_alternative",
        "Take the long way round.",
        "--agent",
        "oracle",
        "--out",
        tmp_path,
    )
    assert said.code == 0
    assert said.out.startswith("arrived; stopped by agent\nSPD 0.0")
    walk = json.loads((tmp_path / "trajectory.json").read_text(encoding="utf-8"))
    assert walk["columns"] == ["time", "x", "y", "heading"]
    assert len(walk["poses"]) > 100
    assert walk["instruction"] == "Take the long way round."
    assert walk["result"]["success"] is True
    lines = (tmp_path / "trace.jsonl").read_text(encoding="utf-8").splitlines()
    assert [json.loads(line)["kind"] for line in lines][-1] == "end"
    assert (tmp_path / "picture.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        pytest.param(["nowhere", "R1", "Go."], 1, "university", id="site"),
        pytest.param(["none.geojson", "R1", "Go."], 1, "none.geojson", id="file"),
        pytest.param(["university", "R9", "Go."], 2, "R1 (route_r1_", id="route"),
        pytest.param(
            ["university", "R1", " "], 2, "expected an instruction", id="text"
        ),
        pytest.param(["university", "R1"], 2, "TEXT", id="no text"),
    ],
)
def test_wrong_input_gives_one_message_and_nothing_else(
    memorymaze: Memorymaze,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    code: int,
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    done = memorymaze("navigate", *arguments, "--agent", "stop")
    assert (done.code, done.out) == (code, "")
    assert said in done.err
    assert "Traceback" not in done.err
    assert not any(tmp_path.iterdir())
