import json
import re
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).parents[1]
NOTEBOOK = PROJECT / "examples" / "first_steps.ipynb"


def _run(program: str, folder: Path) -> str:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        capture_output=True,
        text=True,
        cwd=folder,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_python_blocks_of_the_page_on_python_run(tmp_path: Path) -> None:
    page = (PROJECT / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    said = _run("\n".join(blocks), tmp_path)
    assert "right_hand, 6 episodes" in said
    assert "B - A" in said


def test_the_notebook_scores_an_agent_of_ones_own_in_under_25_lines(
    tmp_path: Path,
) -> None:
    cells = json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]
    programs = ["".join(c["source"]) for c in cells if c["cell_type"] == "code"]
    lines = [line for each in programs for line in each.splitlines() if line.strip()]
    assert len(lines) < 25
    said = _run("\n".join([*programs, "print(run)"]), tmp_path)
    assert "right_hand, 6 episodes" in said
