from collections.abc import Callable
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


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
