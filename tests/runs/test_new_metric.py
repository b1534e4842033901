"""Adds the metric of docs/metrics.md to a copy of the package, and looks for it."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import memorymaze

PROJECT = Path(__file__).parents[2]
SCRIPT = """
import json
import shutil
import memorymaze as mm
from memorymaze.basics.errors import RunFolderError
from memorymaze.runs.report import read_sources, write_report

class Ahead:
    name = "ahead"

    def follow(self, instruction, robot, journal, rng):
        robot.move_forward(3.0)

corpus = mm.load_corpus({instructions!r}, sites={sites!r})
run = mm.evaluate(Ahead(), corpus, limit=2, out="new", workers=1)
shutil.copytree("new", "again")
pair = mm.compare(run, "again").table()
write_report(read_sources(["new"]), "report")
try:
    mm.load_run("older")
    refused = ""
except RunFolderError as error:
    refused = str(error)
print(json.dumps({{
    "results": [each.goal_progress for each in run.results],
    "driven": [each.path_length for each in run.results],
    "table": run.table().records(),
    "pair": [row for row in pair.records() if row["measure"] == "goal_progress"],
    "refused": refused,
}}))
"""


def add_the_metric(package: Path) -> None:
    """Write the two snippets of the page into the two files that it names."""
    page = (PROJECT / "docs" / "metrics.md").read_text(encoding="utf-8")
    section = page.split("## A new metric")[1].split("\n## ")[0]
    [function] = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    [added] = re.findall(r"```diff\n(.*?)```", section, re.DOTALL)
    field = re.sub(r"^\+", "", added, flags=re.MULTILINE)
    formula = package / "runs" / "metrics" / "efficiency.py"
    formula.write_text(formula.read_text(encoding="utf-8") + function, encoding="utf-8")
    results = package / "runs" / "episodes" / "results.py"
    imports, field = field.split("\n\n", 1)
    before, after = results.read_text(encoding="utf-8").split("\n\n_RESULT =")
    before = before.replace("\nfrom ", f"\n{imports}\nfrom ", 1)
    results.write_text(f"{before}{field}\n\n_RESULT ={after}", encoding="utf-8")


def test_a_new_metric_takes_two_files_and_is_then_shown_everywhere(
    tmp_path: Path, tiny_instructions: Path, tiny_sites_folder: Path, tiny_run: Path
) -> None:
    shutil.copytree(tiny_run, tmp_path / "older")
    package = tmp_path / "source" / "memorymaze"
    shutil.copytree(Path(memorymaze.__file__).parent, package)
    add_the_metric(package)
    script = SCRIPT.format(
        instructions=str(tiny_instructions), sites=str(tiny_sites_folder)
    )
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=os.environ | {"PYTHONPATH": str(package.parent)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout.splitlines()[-1])
    gained = told["results"]
    # Who drives straight towards the goal gains what they drive.
    assert gained == pytest.approx(told["driven"], abs=0.2)
    assert min(gained) > 2.5
    summary = json.loads((tmp_path / "new" / "summary.json").read_text("utf-8"))
    assert summary["mean"]["goal_progress"] == pytest.approx(sum(gained) / 2)
    assert told["table"][-1]["goal_progress"] == pytest.approx(sum(gained) / 2)
    assert "goal_progress_low" in told["table"][-1]
    assert [row["difference"] for row in told["pair"]] == [0.0] * len(told["pair"])
    assert "without goal_progress, made by another version" in told["refused"]
    pages = tmp_path / "report"
    for name in ("tables", "distributions"):
        assert "GP" in (pages / f"{name}.html").read_text(encoding="utf-8")
    for page in (pages / "episodes").iterdir():
        assert "GP (m)</th>" in page.read_text(encoding="utf-8")
