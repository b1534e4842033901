import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Memorymaze = Callable[..., Any]
TINY_SITES = Path(__file__).parents[2] / "tiny_sites"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        pytest.param(["--robots", "0"], "--robots: expected 1 or more", id="no robots"),
        pytest.param(["--site", "universty"], "did you mean", id="no such site"),
        pytest.param(["--agent", "gide"], "did you mean 'guide'", id="no such agent"),
        pytest.param(["--model", "m"], "expected with --agent", id="model alone"),
        pytest.param(["--set", "a=1"], "expected with --agent", id="option alone"),
        pytest.param(
            ["--agent", "code_generation"], "name a language model", id="no model"
        ),
        pytest.param(
            ["--with", "isolate=true"],
            "isolate: is for agents of your own",
            id="isolate",
        ),
        pytest.param(
            ["--ask", "1", "--with", "passers_by=model"], "on this page", id="people"
        ),
        pytest.param(
            ["--with", "looks=nowhere.glb"], "which is no file here", id="no such looks"
        ),
        pytest.param(
            ["--with", "detector=nowhere:Detector"],
            "cannot be imported",
            id="no detector",
        ),
        pytest.param(["--host", "192.0.2.1"], "cannot be served", id="not our address"),
    ],
)
def test_what_cannot_be_shown_is_refused_before_anybody_comes(
    memorymaze: Memorymaze, options: list[str], said: str
) -> None:
    done = memorymaze("try", *options)
    assert (done.code, done.out) == (2, "")
    assert said in done.err


def test_two_plans_of_one_name_are_refused(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    one = TINY_SITES / "corridor.geojson"
    other = shutil.copy(one, tmp_path)
    done = memorymaze("try", "--site", one, "--site", other)
    assert (done.code, done.out) == (1, "")
    assert f"{other}: -: name: expected a name of its own for every plan" in done.err
    assert f"got 'corridor' as in {one}" in done.err


def test_a_plan_without_a_way_to_tell_is_refused(
    memorymaze: Memorymaze, tmp_path: Path
) -> None:
    plan = json.loads((TINY_SITES / "corridor.geojson").read_text(encoding="utf-8"))
    kept = [each for each in plan["features"] if each["properties"]["kind"] != "route"]
    path = tmp_path / "corridor.geojson"
    path.write_text(json.dumps(plan | {"features": kept}), encoding="utf-8")
    done = memorymaze("try", "--site", path)
    assert (done.code, done.out) == (2, "")
    assert f"expected a plan with a reference route, got none in {path}" in done.err
