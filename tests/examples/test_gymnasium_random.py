"""The example of a Gymnasium environment."""

import runpy
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "gymnasium_random.py"


@pytest.mark.proof
def test_the_example_walks_and_tells_how_it_went(
    capsys: pytest.CaptureFixture[str],
) -> None:
    runpy.run_path(str(EXAMPLE), run_name="__main__")
    said = capsys.readouterr().out
    assert "(source: llm)" in said
    assert "m from the goal" in said
